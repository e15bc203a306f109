/** Two starts of covariant vectors, carried backwards together [T16]; where half of the vectors are
 * carried forward, half of what that takes does [T18]. */
#ifndef HD_STARTS_H
#define HD_STARTS_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap/status.h"

typedef struct hd_starts hd_starts;

/** Of n vectors; conjugate: of half of them there are triangles. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_starts_create(hd_starts **out, int vectors, bool conjugate);
void hd_starts_free(hd_starts *starts);

/** Two random ones; of 2 streams from this one on. */
void hd_starts_begin(hd_starts *starts, uint64_t seed, uint64_t stream);

/** From the end of an interval to its start: the first one, or both. `factor` is R [row-major],
 * `coupling` Y [T18], NULL where all vectors are carried. HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_starts_step(hd_starts *starts, const double *factor,
                                       const double *coupling, bool both);

/** The first one's C [n * n] at the time that it has come to, as in hd_backward; valid until the
 * next step. Growth is complete only then. HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_starts_look(hd_starts *starts, const double **c);
/** C of both. */
HD_MUST_CHECK hd_status hd_starts_meet(hd_starts *starts, const double *c[2]);

/** ln of how much each vector of the first one grew from this look to the one before, which came
 * later: [n]; starts anew. */
const double *hd_starts_growth(hd_starts *starts);

#endif
