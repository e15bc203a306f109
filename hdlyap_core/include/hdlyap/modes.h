/** What each Lyapunov vector looks like: its weights in the T, L and P fields of waves
 * (hdlyap/fields.h) and in the null space [T11]. n is the number of vectors; arrays of n elements
 * are in the order of the exponents, largest first, belong to the run, and change when it goes on.
 * A _snapshot is of the last sample, an _average the mean over all samples; both are 0 before the
 * first. Several threads may read one hd_modes at once while no thread calls its run. Tags as [T11]
 * are those of equations in THEORY.md. */
#ifndef HDLYAP_MODES_H
#define HDLYAP_MODES_H

#include "hdlyap/fields.h"

HD_API_BEGIN

/** The weights of a run's vectors; owned by the run. */
typedef struct hd_modes hd_modes;

/** Number of samples in the averages. */
long hd_modes_samples(const hd_modes *modes);
/** The fields in which weights are taken. */
const hd_fields *hd_modes_fields(const hd_modes *modes);

/** Which fields of a subspace a weight is of: all of them, or only the L or only the P fields of an
 * LP subspace. */
typedef enum hd_weight { HD_WEIGHT, HD_WEIGHT_L, HD_WEIGHT_P, HD_WEIGHTS } hd_weight;

/** Weights of all n vectors in the fields of subspace s, 0 .. 1: squared lengths of the
 * least-squares projections of their dq halves, which are first scaled to length 1, onto these
 * fields. */
const double *hd_modes_snapshot(const hd_modes *modes, int s, hd_weight which);
const double *hd_modes_average(const hd_modes *modes, int s, hd_weight which);

/** Weights of all n vectors in part `null` of the exact null space [T9], 0 .. 1: squared lengths of
 * the orthogonal projections of the whole vectors, dq and dp. Parts HD_NULL_X, HD_NULL_Y and
 * HD_NULL_Z are uniform in dq or in dp along this direction, if it is periodic; walls that drag
 * damp what is uniform in dp, which counts all the same [T27]. The part behind them, number
 * hd_scene_dimension, contains dq = p and dp = p; for particles with hd_dynamics.scale_invariant
 * false it contains what else hd_dynamics.null_vectors has. */
const double *hd_modes_null_snapshot(const hd_modes *modes, int null);
const double *hd_modes_null_average(const hd_modes *modes, int null);

/** Which part of the coordinates a share is of: angles instead of positions, of particles that
 * turn; those of the particles of the second kind (hd_scene_kinds). */
typedef enum hd_share { HD_SHARE_TURNING, HD_SHARE_SECOND, HD_SHARES } hd_share;

/** Fraction of |dq|^2 of each vector, [n], 0 .. 1, that is in this part. NULL if the scene has no
 * such part. */
const double *hd_modes_share_snapshot(const hd_modes *modes, hd_share share);
const double *hd_modes_share_average(const hd_modes *modes, hd_share share);

/** Least-squares coefficients, in the last sample, of all n vectors on the field in one column of
 * the matrix of hd_fields. The dq halves of the vectors and the field are first scaled to length 1.
 */
const double *hd_modes_coefficients(const hd_modes *modes, int column);

HD_API_END
#endif
