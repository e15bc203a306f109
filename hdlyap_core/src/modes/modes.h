/** How weights of vectors are measured. */
#ifndef HD_MODES_H
#define HD_MODES_H

#include "base/communicator.h"
#include "hdlyap/frame.h"
#include "hdlyap/modes.h"

/** A dq half shorter than this counts as none: its squares are no longer known to rounding. */
#define HD_MODES_DQ_MIN 1e-145

/** Vectors carried = n. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_modes_create(hd_modes **out, const hd_scene_def *def, int vectors,
                                        int threads);
void hd_modes_free(hd_modes *modes);

/** Measures orthonormal vectors (all of them, or some: the others keep their snapshot) at positions
 * q and momenta p: a snapshot, without averaging. HD_NOT_FINITE. Cost 4 N columns flops per vector
 * as dgemm, and one reading of the vectors. */
HD_MUST_CHECK hd_status hd_modes_measure(hd_modes *modes, hd_columns vectors, const double *q,
                                         const double *p);
/** Of vectors that several ranks have measured, `width` of the `carried` ones each, and the
 * partners of these if they are half of all: then all of them have the snapshot of all.
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_modes_share(hd_modes *modes, hd_communicator *communicator, int width,
                                       int carried);
/** Adds the snapshot to the running averages. */
void hd_modes_add(hd_modes *modes);
/** Empties the running averages. */
void hd_modes_clear(hd_modes *modes);
int hd_modes_vectors(const hd_modes *modes); /**< n */

/** Norms of the dq halves in the snapshot; [n]. */
const double *hd_modes_dq_norms(const hd_modes *modes);

#endif
