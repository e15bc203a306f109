/** The conjugate half of a frame: what of all 4N vectors need not be carried [T18].
 *
 * Carried are 2N vectors Q whose span is its own complement with respect to J (dq, dp) = (dp, -dq):
 * orthonormal, and isotropic, Q^T J Q = 0. Then Gram-Schmidt of all 4N is [Q, J Q in reverse
 * order]. */
#ifndef HD_CONJUGATE_H
#define HD_CONJUGATE_H

#include <stdbool.h>

#include "tangent/frame.h"

/** Entry `row` of J v is that of v at hd_turned(row), times hd_turned_sign(row); with so many
 * coordinates of a particle. */
static inline int hd_turned(int row, int coordinates)
{
    return row % (2 * coordinates) < coordinates ? row + coordinates : row - coordinates;
}
static inline double hd_turned_sign(int row, int coordinates)
{
    return row % (2 * coordinates) < coordinates ? 1.0 : -1.0;
}

/** Turns the 2N vectors of a frame, whatever they are, into orthonormal and isotropic ones: each
 * loses its part along those before it and along their conjugates. A random frame becomes a random
 * one (columns of a random unitary matrix); one that is nearly isotropic changes as little as it
 * lacks. Of all ranks together. HD_ILL_CONDITIONED if they are dependent, HD_NO_MEMORY. Cost 8 m
 * n^2 flops. */
HD_MUST_CHECK hd_status hd_conjugate_start(hd_frame *frame);

typedef struct hd_conjugate hd_conjugate;

/** For frames of so many rows, coordinates of a particle, half as many vectors. most: of these, to
 * be completed at once; 0: none will be. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_conjugate_create(hd_conjugate **out, int rows, int coordinates,
                                            int most);
void hd_conjugate_free(hd_conjugate *conjugate);

/** After an orthonormalisation: ln diag R of all 4N [4N] from that of the half [2N]: ln R_ll and,
 * from behind, -ln R_ll. */
const double *hd_conjugate_stretch(hd_conjugate *conjugate, const double *half);

/** whole [rows * 2n], row-major: the vectors and, from behind, those turned by J. */
void hd_conjugate_fill(double *whole, hd_columns half, int rows, int coordinates);

/** All 4N vectors, [4N * 4N]: they are completed once after each orthonormalisation. Valid until
 * the next one. Of the part of the half that a rank has: these, and behind them their partners. */
hd_columns hd_conjugate_complete(hd_conjugate *conjugate, hd_columns half);
/** The partners alone, at the Lyapunov indices that they have. */
hd_columns hd_conjugate_partners(hd_conjugate *conjugate, hd_columns half);

/** About the root of the sum of squares of E = Q^T J Q: from x^T E y for a few pairs of random
 * signs, which know it to a third. Cost 8 m n flops. */
double hd_conjugate_isotropy(hd_conjugate *conjugate, const hd_frame *frame);

/** max |Q^T J Q| of this rank's vectors, m n^2 flops. For tests and verification. */
double hd_conjugate_isotropy_measured(const hd_frame *frame);

/** Completes [4N] what hd_frame_halves says of the half. */
void hd_conjugate_halves(double *cos_theta, double *dp_dq_ratio, int half);

#endif
