/** How far vectors spread over the disks, and how their two halves lie to each other. */
#ifndef HDLYAP_LOCALIZATION_H
#define HDLYAP_LOCALIZATION_H

#include "hdlyap/frame.h"

HD_API_BEGIN

typedef struct hd_localization hd_localization;

/** threads: that measure. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_localization_create(hd_localization **out, int disks, int vectors,
                                               int threads);
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

long hd_localization_samples(const hd_localization *shape);

/** Localisation width, [n], 1 / N .. 1: exp(S) / N, S the mean over the samples of -sum m_i ln m_i,
 * m_i = |dq_i|^2 + |dp_i|^2 of disk i (Taniguchi and Morriss, Phys. Rev. E 68, 046203 (2003)). */
const double *hd_localization_widths(hd_localization *shape);
/** Its standard error [T8]; negative while it cannot be known. O(blocks). */
double hd_localization_width_error(const hd_localization *shape, int col);
/** exp(S) / N as measured last. */
double hd_localization_width_now(const hd_localization *shape, int col);

/** Mean |cos| of the angle between the dq and dp halves; [n]. */
const double *hd_localization_cosines(const hd_localization *shape);

HD_API_END
#endif
