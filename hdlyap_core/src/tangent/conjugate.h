/** The conjugate half of a frame: those of all 4N vectors that need not be carried [T18].
 *
 * Carried are 2N vectors Q whose span is its own complement with respect to J (dq, dp) = (dp, -dq):
 * orthonormal, and isotropic, Q^T J Q = 0. Then Gram-Schmidt of all 4N is [Q, J Q in reverse
 * order]. */
#ifndef HD_CONJUGATE_H
#define HD_CONJUGATE_H

#include <stdbool.h>

#include "tangent/frame.h"

/** Entry `row` of J v is entry hd_turned(row) of v times hd_turned_sign(row), with this number of
 * coordinates of a particle. */
static inline int hd_turned(int row, int coordinates)
{
    return row % (2 * coordinates) < coordinates ? row + coordinates : row - coordinates;
}
static inline double hd_turned_sign(int row, int coordinates)
{
    return row % (2 * coordinates) < coordinates ? 1.0 : -1.0;
}

/** Makes the 2N vectors of a frame orthonormal and isotropic: removes from each one its part along
 * the vectors before it and along their conjugates. A random frame becomes a random one (columns of
 * a random unitary matrix); a frame that is nearly isotropic changes little. All ranks call it
 * together. Fails with HD_ILL_CONDITIONED if the vectors are dependent, or HD_NO_MEMORY. Cost 8 m
 * n^2 flops. */
HD_MUST_CHECK hd_status hd_conjugate_start(hd_frame *frame);

typedef struct hd_conjugate hd_conjugate;

/** Serves frames of this many rows and half as many vectors. most: vectors that are completed at
 * once; 0: none. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_conjugate_create(hd_conjugate **out, int rows, int coordinates,
                                            int most);
void hd_conjugate_free(hd_conjugate *conjugate);

/** ln diag R of all vectors [4N] from half [2N], after an orthonormalisation: ln R_ll, then -ln
 * R_ll in reverse order. */
const double *hd_conjugate_stretch(hd_conjugate *conjugate, const double *half);

/** Fills whole [rows * 2n], row-major, with the vectors and then, in reverse order, J times them.
 */
void hd_conjugate_fill(double *whole, hd_columns half, int rows, int coordinates);

/** Vectors that can be completed at once. */
int hd_conjugate_most(const hd_conjugate *conjugate);
/** All vectors, [4N * 4N], computed once after each orthonormalisation and valid until the next
 * one. If a rank has only a part of the half, it gets this part, followed by the partners. */
hd_columns hd_conjugate_complete(hd_conjugate *conjugate, hd_columns half);
/** The partners alone, at the Lyapunov indices that they have. */
hd_columns hd_conjugate_partners(hd_conjugate *conjugate, hd_columns half);

/** Estimates the root of the sum of squares of E = Q^T J Q from x^T E y for a few pairs of vectors
 * of random signs, to about a third. Cost 8 m n flops. */
double hd_conjugate_isotropy(hd_conjugate *conjugate, const hd_frame *frame);

/** max |Q^T J Q| of this rank's vectors, m n^2 flops. For tests and verification. */
double hd_conjugate_isotropy_measured(const hd_frame *frame);

/** Completes the results [4N] of hd_frame_dq_dp, of which the first half is given. */
void hd_conjugate_dq_dp(double *cos_theta, double *dp_dq_ratio, int half);

/** most: as hd_conjugate_create. */
double hd_conjugate_bytes(double rows, double most);

#endif
