/** What each Lyapunov vector looks like: its weights in the fields of every wave vector [T11].
 * Several threads may read one at once while its run is not called. */
#ifndef HDLYAP_MODES_H
#define HDLYAP_MODES_H

#include "hdlyap/fields.h"

HD_API_BEGIN

typedef struct hd_modes hd_modes;

long hd_modes_samples(const hd_modes *modes); /**< snapshots in the averages */
const hd_fields *hd_modes_fields(const hd_modes *modes);

/** Which weight: of the whole subspace, or of the L or the P fields of an LP subspace alone. */
typedef enum hd_weight { HD_WEIGHT, HD_WEIGHT_L, HD_WEIGHT_P, HD_WEIGHTS } hd_weight;

/** Squared norm of the least-squares projection of each vector's dq half, normalised, onto subspace
 * s; [n], 0 .. 1. Snapshot, or running average (zero without samples). */
const double *hd_modes_snapshot(const hd_modes *modes, int s, hd_weight which);
const double *hd_modes_average(const hd_modes *modes, int s, hd_weight which);

/** Squared norms of the orthogonal projections of the whole vectors onto the exact null space [T9],
 * its parts apart: N_x, N_y, N_z (uniform dq or dp along a periodic direction), N_p (dq = p or dp =
 * p; 0 where hd_dynamics.paces is false); [n]. */
const double *hd_modes_null_snapshot(const hd_modes *modes, int null);
const double *hd_modes_null_average(const hd_modes *modes, int null);

/** Part of the squared norm of each vector's dq half that is rotation, not of places; [n], 0 .. 1,
 * and NULL of what does not turn. */
const double *hd_modes_turning_snapshot(const hd_modes *modes);
const double *hd_modes_turning_average(const hd_modes *modes);

/** Snapshot of the least-squares coefficients of the normalised dq halves on the normalised field
 * at a column of hd_fields; [n]. */
const double *hd_modes_coefficients(const hd_modes *modes, int column);

HD_API_END
#endif
