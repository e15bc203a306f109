/** How far vectors spread over the disks, and how their two halves lie to each other. One thread at
 * a time, to read as well: widths are made where they are kept. */
#ifndef HDLYAP_LOCALIZATION_H
#define HDLYAP_LOCALIZATION_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_localization hd_localization;

long hd_localization_samples(const hd_localization *shape);

/** Localisation width, [n], 1 / N .. 1: exp(S) / N, S the mean over the samples of -sum m_i ln m_i,
 * m_i = |dq_i|^2 + |dp_i|^2 of disk i (Taniguchi and Morriss, Phys. Rev. E 68, 046203 (2003)). */
const double *hd_localization_widths(hd_localization *shape);
/** Its standard error [T8]; negative while it cannot be known. O(blocks). */
double hd_localization_width_error(const hd_localization *shape, int col);
/** exp(S) / N as measured last. */
double hd_localization_width_now(const hd_localization *shape, int col);

HD_API_END
#endif
