/** Two starts of covariant vectors, carried backwards together [T16]. If half of the vectors are
 * carried forward, this takes half of the work, too [T18]. */
#ifndef HD_STARTS_H
#define HD_STARTS_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap/status.h"

typedef struct hd_backward_pair hd_backward_pair;

/** Creates two starts of n vectors; conjugate: triangles are those of half of the vectors. Fails
 * with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_backward_pair_create(hd_backward_pair **out, int vectors,
                                                bool conjugate);
void hd_backward_pair_free(hd_backward_pair *starts);

/** Makes both starts random, from two streams of random numbers: this one and the next. */
void hd_backward_pair_begin(hd_backward_pair *starts, uint64_t seed, uint64_t stream);

/** Carries the first start, or both, from the end of an interval to its start. `factor` is R
 * [row-major], `coupling` is Y [T18], or NULL if all vectors are carried. Fails with
 * HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_backward_pair_step(hd_backward_pair *starts, const double *factor,
                                              const double *coupling, bool both);

/** The first start's C [n * n] at its present time, stored as in hd_backward; valid until the next
 * step. This call completes the growth. Fails with HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_backward_pair_look(hd_backward_pair *starts, const double **c);
/** The C of both starts at their present time, as hd_backward_pair_look. */
HD_MUST_CHECK hd_status hd_backward_pair_meet(hd_backward_pair *starts, const double *c[2]);

/** Logarithm of the growth of each vector [n] of the first start, from this call to the call
 * before, which is later in time; then counts anew. */
const double *hd_backward_pair_growth(hd_backward_pair *starts);

#endif
