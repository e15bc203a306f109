/** How weights of vectors are measured. */
#ifndef HD_MODES_H
#define HD_MODES_H

#include "base/archive.h"
#include "base/communicator.h"
#include "hdlyap/frame.h"
#include "hdlyap/modes.h"

/** A dq half shorter than this counts as none: its squares are no longer known to rounding. */
#define HD_MODES_DQ_MIN 1e-145

/** Makes empty weights of n = vectors. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_modes_create(hd_modes **out, const hd_scene_def *def, int vectors,
                                        int threads);
void hd_modes_free(hd_modes *modes);

/** Takes a snapshot of orthonormal vectors at positions q and momenta p, without averaging; vectors
 * that are not given keep their snapshot. Fails with HD_NOT_FINITE. Cost 4 N columns flops per
 * vector as dgemm, and one reading of the vectors. */
HD_MUST_CHECK hd_status hd_modes_measure(hd_modes *modes, hd_columns vectors, const double *q,
                                         const double *p);
/** Gives all ranks the snapshot of all vectors. Each rank has measured `width` of the `carried`
 * vectors, and their partners if half of all are carried. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_modes_share(hd_modes *modes, hd_communicator *communicator, int width,
                                       int carried);
/** Adds the snapshot to the running averages. */
void hd_modes_add(hd_modes *modes);
/** Empties the running averages and the snapshot. */
void hd_modes_clear(hd_modes *modes);
int hd_modes_vectors(const hd_modes *modes); /**< n */

/** Norms of the dq halves in the snapshot; [n]. */
const double *hd_modes_dq_norms(const hd_modes *modes);

double hd_modes_bytes(const hd_scene_def *scene, double vectors);
void hd_modes_archive(hd_modes *modes, hd_archive *archive);

#endif
