/** How far vectors spread over the particles. All functions, those that read too, use one
 * workspace: one thread at a time. */
#ifndef HDLYAP_LOCALIZATION_H
#define HDLYAP_LOCALIZATION_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_localization hd_localization;

long hd_localization_samples(const hd_localization *shape); /**< number of samples in the means */

/** Localisation widths exp(S) / N of all n vectors, 1 / N .. 1. S is the mean over the samples of
 * -sum m_i ln m_i, with m_i = |dq_i|^2 + |dp_i|^2 of particle i (Taniguchi and Morriss, Phys. Rev.
 * E 68, 046203 (2003)). */
const double *hd_localization_widths(hd_localization *shape);
/** Standard error of a width [T8]; negative while it is not known. O(blocks). */
double hd_localization_width_error(const hd_localization *shape, int col);
/** Width of a vector in the last sample. */
double hd_localization_width_now(const hd_localization *shape, int col);

HD_API_END
#endif
