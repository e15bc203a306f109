/** The block that couples the two halves of the triangle R of all 4N vectors, if only half of the
 * vectors are carried [T18]. */
#ifndef HD_COUPLING_H
#define HD_COUPLING_H

#include "dynamics/dynamics.h"
#include "tangent/frame.h"

typedef struct hd_coupling hd_coupling;

/** A coupling takes as many bytes as a frame of half as many vectors as rows, and 8 for each pair
 * of vectors. Creating one fails with HD_NO_MEMORY. */
double hd_coupling_bytes(const hd_dynamics *of, int rows, int threads);
HD_MUST_CHECK hd_status hd_coupling_create(hd_coupling **out, const hd_scene_def *scene,
                                           int threads);
void hd_coupling_free(hd_coupling *coupling);

/** Measures the interval of the record from t_begin to t_end. The frame has been replayed through
 * it and orthonormalised with this R [2N * 2N], row-major; it was orthonormal to rounding at both
 * ends. Fails with HD_NO_MEMORY. Costs a replay and 8/3 (2N)^3 flops. */
HD_MUST_CHECK hd_status hd_coupling_measure(hd_coupling *coupling, const hd_frame *frame,
                                            const double *factor, const hd_record *record,
                                            double t_begin, double t_end);

/** Y = R^-1 X of the last measured interval, [2N * 2N], symmetric; S J Q = Q' X + J Q' R^-T. */
const double *hd_coupling_read(const hd_coupling *coupling);

#endif
