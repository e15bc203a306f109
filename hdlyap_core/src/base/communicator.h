/** Exchanges among the ranks of a run; every rank must make the same calls. Without a communicator
 * (NULL) nothing is done. */
#ifndef HD_COMMUNICATOR_H
#define HD_COMMUNICATOR_H

#include "hdlyap/communicator.h"

int hd_communicator_rank(const hd_communicator *c);           /**< 0 without a communicator */
int hd_communicator_ranks(const hd_communicator *c);          /**< 1 without a communicator */
hd_traffic hd_communicator_traffic(const hd_communicator *c); /**< sum over all kinds of calls */

void hd_communicator_sum(hd_communicator *c, double *x, size_t count);
void hd_communicator_exchange(hd_communicator *c, double *x, size_t count);
void hd_communicator_broadcast(hd_communicator *c, void *x, size_t bytes);

/** Which columns of x[rows][stride] rank r has filled: the `width` columns from r * width on, up to
 * `count`; or, counted from the last column count - 1 backwards, as many. */
typedef struct hd_shared {
    size_t rows, stride, width, count;
    int from_behind;
} hd_shared;

/** Gives every rank the columns that the others have filled. Fails with HD_NO_MEMORY, on all ranks.
 */
HD_MUST_CHECK hd_status hd_communicator_share(hd_communicator *c, double *x, hd_shared shared);

/** Shares numbers of `all` vectors. The first carried.count are carried; the others, if there are
 * any, are their partners in reverse order [T18]. Fails with HD_NO_MEMORY, on all ranks. */
HD_MUST_CHECK hd_status hd_communicator_share_halves(hd_communicator *c, double *x,
                                                     hd_shared carried, size_t all);

/** The status of the first rank whose status is not HD_OK, on every rank: all go on, or none does.
 */
HD_MUST_CHECK hd_status hd_communicator_agree(hd_communicator *c, hd_status mine);

#endif
