/** What ranks tell each other, all of them together; without a communicator (NULL) nothing is done.
 */
#ifndef HD_COMMUNICATOR_H
#define HD_COMMUNICATOR_H

#include "hdlyap/communicator.h"

int hd_communicator_rank(const hd_communicator *c);           /**< 0 without one */
int hd_communicator_ranks(const hd_communicator *c);          /**< 1 without one */
hd_traffic hd_communicator_traffic(const hd_communicator *c); /**< of all kinds together */

void hd_communicator_sum(hd_communicator *c, double *x, size_t count);
void hd_communicator_exchange(hd_communicator *c, double *x, size_t count);
void hd_communicator_broadcast(hd_communicator *c, void *x, size_t bytes);

/** Of x[rows][stride] rank r fills columns r * width ... of every row, up to `count`; or, from
 * behind, the columns that are as far from column count - 1. */
typedef struct hd_shared {
    size_t rows, stride, width, count;
    int from_behind;
} hd_shared;

/** What each has filled, to all. HD_NO_MEMORY, on all ranks. */
HD_MUST_CHECK hd_status hd_communicator_share(hd_communicator *c, double *x, hd_shared shared);

/** Shares what is known of `all` vectors, of which the first carried.count are carried and the
 * others are their partners in reverse order [T18], or there are no others. HD_NO_MEMORY, on all
 * ranks. */
HD_MUST_CHECK hd_status hd_communicator_share_halves(hd_communicator *c, double *x,
                                                     hd_shared carried, size_t all);

/** The status of the first rank that has another one than HD_OK: all then go on, or none. */
HD_MUST_CHECK hd_status hd_communicator_agree(hd_communicator *c, hd_status mine);

#endif
