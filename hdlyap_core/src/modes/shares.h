/** Vectors -> the fractions of their dq halves that are in a part of the coordinates. */
#ifndef HD_SHARES_H
#define HD_SHARES_H

#include <stdbool.h>

#include "hdlyap/frame.h"
#include "hdlyap/modes.h"

/** Number of the shares before this one that a scene has; HD_SHARES: of all. */
size_t hd_shares_before(const hd_scene_def *scene, hd_share end);
bool hd_shares_has(const hd_scene_def *scene, hd_share share);

/** Writes the fraction of each dq half's squared length that is in this part to share, which has an
 * element for each vector, as dq_norm has its length. */
void hd_shares_measure(double *share, const hd_scene_def *scene, hd_share which,
                       const double *dq_norm, hd_columns v);

#endif
