/** What couples the two halves of a triangle of all 4N vectors, of which half are carried [T18]. */
#ifndef HD_COUPLING_H
#define HD_COUPLING_H

#include "dynamics/dynamics.h"
#include "tangent/frame.h"

typedef struct hd_coupling hd_coupling;

/** Of frames of half as many vectors as rows. HD_NO_MEMORY: they take as much room as a frame, and
 * 8 bytes for each pair of vectors. */
double hd_coupling_bytes(int rows, int threads);
HD_MUST_CHECK hd_status hd_coupling_create(hd_coupling **out, const hd_dynamics *of, int particles,
                                           int threads);
void hd_coupling_free(hd_coupling *coupling);

/** Of the interval from t_begin to t_end of the record: the frame has been replayed through it and
 * orthonormalised, with this R [2N * 2N], row-major; both its ends are orthonormal to rounding.
 * HD_NO_MEMORY. Cost of a replay and 8/3 (2N)^3 flops. */
HD_MUST_CHECK hd_status hd_coupling_measure(hd_coupling *coupling, const hd_frame *frame,
                                            const double *factor, const hd_record *record,
                                            double t_begin, double t_end);

/** Y = R^-1 X of the last one, where S J Q = Q' X + J Q' R^-T: [2N * 2N], symmetric. */
const double *hd_coupling_read(const hd_coupling *coupling);

#endif
