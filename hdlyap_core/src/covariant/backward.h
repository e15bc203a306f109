/** Covariant vectors, carried backwards in time through the triangles of Gram-Schmidt [T16]. */
#ifndef HD_BACKWARD_H
#define HD_BACKWARD_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/status.h"

/** C [n * n], column-major, upper triangular, columns of length 1: the covariant vectors are V = Q
 * C. */
typedef struct hd_backward hd_backward;

HD_MUST_CHECK hd_status hd_backward_create(hd_backward **out, int vectors);
void hd_backward_free(hd_backward *backward);

/** Makes a random, well-conditioned C: each column is at 60 degrees to the span of the columns
 * before it. A triangle of independent random entries would be exponentially ill-conditioned, and
 * its last columns only rounding. */
void hd_backward_start(hd_backward *backward, uint64_t seed, uint64_t stream);

/** Carries C from the end of an interval to its start: C <- R^-1 C D with D > 0 diagonal; `factor`
 * is the interval's R (hd_ortho_factor). growth[n]: logarithm of each vector's growth from start to
 * end. Fails with HD_ILL_CONDITIONED (C undefined) if that is not finite. Cost n^3 / 3 flops. */
HD_MUST_CHECK hd_status hd_backward_step(hd_backward *backward, double *growth,
                                         const double *factor);

double *hd_backward_data(hd_backward *backward); /**< C */
const double *hd_backward_read(const hd_backward *backward);

/** Sine of the angle between column `col` of one C and that of another, whatever their signs. */
double hd_backward_apart(const hd_backward *one, const hd_backward *other, int col);

/** Sine of the angle between two vectors of length 1, whatever their signs. */
double hd_vectors_apart(const double *x, const double *y, int count);

/** Packed triangles: n (n + 1) / 2 doubles of R, row after row from the diagonal on. */
size_t hd_triangle_size(int vectors);
void hd_triangle_pack(double *packed, const double *factor, int vectors);
void hd_triangle_unpack(double *factor, const double *packed, int vectors);

#endif
