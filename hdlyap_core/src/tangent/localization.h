/** How widths of vectors are measured. */
#ifndef HD_LOCALIZATION_H
#define HD_LOCALIZATION_H

#include "hdlyap/frame.h"
#include "hdlyap/localization.h"

/** threads: that measure. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_localization_create(hd_localization **out, int disks, int coordinates,
                                               int vectors, int threads);
void hd_localization_free(hd_localization *shape);
void hd_localization_clear(hd_localization *shape);

/** Measures vectors of length 1, of all disks; others stay as they were measured. Cost O(N) for
 * each vector, a logarithm for each disk. */
void hd_localization_measure(hd_localization *shape, hd_columns columns);
/** What has been measured, [2][n]: S, |cos| of the angle between the halves. To be completed by who
 * did not measure all vectors. */
double *hd_localization_measured(hd_localization *shape);
/** The averages take up what has been measured. */
void hd_localization_add(hd_localization *shape);

/** Mean |cos| of the angle between the dq and dp halves; [n]. */
const double *hd_localization_cosines(const hd_localization *shape);

#endif
