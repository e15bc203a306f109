/** Covariant vectors, carried backwards in time through the triangles that Gram-Schmidt left [T16].
 */
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

/** A random C, well conditioned: each column leans out of the span of those before it by 60
 * degrees, as those of a triangle of equally random entries do not. That one is exponentially
 * ill-conditioned, its last columns are but rounding. */
void hd_backward_start(hd_backward *backward, uint64_t seed, uint64_t stream);

/** From the end of an interval to its start, C <- R^-1 C D with D > 0 diagonal; `factor` is the
 * interval's R, as hd_ortho_factor gives it. growth[n]: ln of how much each vector grows from the
 * start to the end. HD_ILL_CONDITIONED (C undefined) where that is no number. Cost n^3 / 3 flops.
 */
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
