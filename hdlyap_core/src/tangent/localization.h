/** How widths of vectors are measured. */
#ifndef HD_LOCALIZATION_H
#define HD_LOCALIZATION_H

#include "base/archive.h"
#include "hdlyap/frame.h"
#include "hdlyap/localization.h"

/** Makes empty averages; `threads` threads will measure. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_localization_create(hd_localization **out, int particles,
                                               int coordinates, int vectors, int threads);
void hd_localization_free(hd_localization *shape);
void hd_localization_clear(hd_localization *shape);

/** Measures these vectors, which have length 1; the values of other vectors stay. Cost O(N) and N
 * logarithms for each vector. */
void hd_localization_measure(hd_localization *shape, hd_columns columns);
/** The values measured last, [2][n]: S, and |cos| of the angle between the halves. A caller that
 * did not measure all vectors has to complete them. */
double *hd_localization_measured(hd_localization *shape);
/** Adds the values measured last to the averages. */
void hd_localization_add(hd_localization *shape);

/** Mean |cos| of the angle between the dq and dp halves; [n]. */
const double *hd_localization_cosines(const hd_localization *shape);

void hd_localization_archive(hd_localization *shape, hd_archive *archive);
double hd_localization_bytes(double vectors);

#endif
