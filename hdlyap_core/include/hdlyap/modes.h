/** What each Lyapunov vector looks like: its weights in the fields of every wave vector [T11]. */
#ifndef HDLYAP_MODES_H
#define HDLYAP_MODES_H

#include "hdlyap/fields.h"
#include "hdlyap/frame.h"

HD_API_BEGIN

/** A dq half shorter than this counts as none: its squares are no longer known to rounding. */
#define HD_MODES_DQ_MIN 1e-145

typedef struct hd_modes hd_modes;

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

long hd_modes_samples(const hd_modes *modes); /**< snapshots in the averages */
int hd_modes_vectors(const hd_modes *modes);  /**< n */
const hd_fields *hd_modes_fields(const hd_modes *modes);

/** Which weight: of the whole subspace, or of the L or the P fields of an LP subspace alone. */
typedef enum hd_weight { HD_WEIGHT, HD_WEIGHT_L, HD_WEIGHT_P, HD_WEIGHTS } hd_weight;

/** Squared norm of the least-squares projection of each vector's dq half, normalised, onto subspace
 * s; [n], 0 .. 1. Snapshot, or running average (zero without samples). */
const double *hd_modes_snapshot(const hd_modes *modes, int s, hd_weight which);
const double *hd_modes_average(const hd_modes *modes, int s, hd_weight which);

/** Squared norms of the orthogonal projections of the whole vectors onto the exact null space [T9],
 * its parts apart: N_x, N_y, N_z (uniform dq or dp along a periodic direction), N_p (dq = p or dp =
 * p); [n]. */
const double *hd_modes_null_snapshot(const hd_modes *modes, int null);
const double *hd_modes_null_average(const hd_modes *modes, int null);

/** Norms of the dq halves in the snapshot; [n]. */
const double *hd_modes_dq_norms(const hd_modes *modes);

/** Snapshot of the least-squares coefficients of the normalised dq halves on the normalised field
 * at a column of hd_fields; [n]. */
const double *hd_modes_coefficients(const hd_modes *modes, int column);

HD_API_END
#endif
