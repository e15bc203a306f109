/** How structure factors are measured. */
#ifndef HD_STRUCTURE_H
#define HD_STRUCTURE_H

#include "base/archive.h"
#include "base/communicator.h"
#include "hdlyap/frame.h"
#include "hdlyap/structure.h"

/** Makes empty structure factors of n = vectors. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_structure_create(hd_structure **out, const hd_scene_def *def,
                                            int vectors, int threads);
void hd_structure_free(hd_structure *structure);

/** Takes a snapshot of vectors at positions q, whose dq halves have these norms [n]; vectors that
 * are not given keep theirs. Fails with HD_NOT_FINITE. Cost 16 N waves flops per vector as dgemm in
 * periodic boxes, half of it for each direction with walls. */
HD_MUST_CHECK hd_status hd_structure_measure(hd_structure *structure, hd_columns vectors,
                                             const double *q, const double *dq_norm);
/** As hd_modes_share. */
HD_MUST_CHECK hd_status hd_structure_share(hd_structure *structure, hd_communicator *communicator,
                                           int width, int carried);
/** Adds the snapshot to the means, and finds each vector's strongest wave anew. */
void hd_structure_add(hd_structure *structure);
/** Empties the means and the snapshot. */
void hd_structure_clear(hd_structure *structure);
int hd_structure_waves_of(const hd_scene_def *def); /**< hd_structure_waves of a scene */

/** The structure factors of all vectors for one wave, [n], of the snapshot or as means over
 * samples: S(k) = |sum_j e.dq_j exp(-i k.q_j)|^2 with |dq| = 1, mean over k and its mirror image
 * (k_x, -k_y). Between walls it is that of the box and its mirror image, per particle. To compare
 * with: a random vector has 1/2, one that lies in the wave's fields N / (number of their
 * modulations, 1 .. 4). In space both directions across k are added up: in periodic boxes a random
 * vector has 1/3 along k and 2/3 across. */
const double *hd_structure_snapshot(const hd_structure *structure, int wave, hd_direction e);
int hd_structure_vectors(const hd_structure *structure); /**< n */

double hd_structure_bytes(const hd_scene_def *scene, double vectors);
void hd_structure_archive(hd_structure *structure, hd_archive *archive);

#endif
