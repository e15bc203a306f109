/** What each Lyapunov vector looks like: its weights in the fields of every wave vector [T11].
 * Several threads may read one hd_modes at once while none calls its run. */
#ifndef HDLYAP_MODES_H
#define HDLYAP_MODES_H

#include "hdlyap/fields.h"

HD_API_BEGIN

typedef struct hd_modes hd_modes;

long hd_modes_samples(const hd_modes *modes); /**< number of samples in the averages */
const hd_fields *hd_modes_fields(const hd_modes *modes);

/** Fields that a weight belongs to: all of a subspace, or the L or P fields of an LP subspace. */
typedef enum hd_weight { HD_WEIGHT, HD_WEIGHT_L, HD_WEIGHT_P, HD_WEIGHTS } hd_weight;

/** Weights of all n vectors in the fields of subspace s, 0 .. 1: squared norms of the least-squares
 * projections of the normalised dq halves. The last sample, and the mean of all (0 without any). */
const double *hd_modes_snapshot(const hd_modes *modes, int s, hd_weight which);
const double *hd_modes_average(const hd_modes *modes, int s, hd_weight which);

/** Weights of all n vectors in part `null` of the exact null space [T9]: squared norms of the
 * orthogonal projections of the whole vectors. Parts HD_NULL_X, _Y, _Z are uniform in dq or dp
 * along a periodic direction; the part behind them is dq = p or dp = p, or if hd_dynamics.paces is
 * false what else hd_dynamics.null has. */
const double *hd_modes_null_snapshot(const hd_modes *modes, int null);
const double *hd_modes_null_average(const hd_modes *modes, int null);

/** Fraction of each vector's |dq|^2 that turns particles instead of displacing them, [n]; NULL if
 * particles do not turn. */
const double *hd_modes_turning_snapshot(const hd_modes *modes);
const double *hd_modes_turning_average(const hd_modes *modes);

/** Least-squares coefficients, in the last sample, of the normalised dq halves of all n vectors on
 * the normalised field in a column of hd_fields. */
const double *hd_modes_coefficients(const hd_modes *modes, int column);

HD_API_END
#endif
