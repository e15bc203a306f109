/** How many particles take part in each vector: localisation widths. n is the number of vectors,
 * col 0 .. n - 1, largest exponent first. The functions of one run share a workspace: only one
 * thread at a time may call them for the same run. [T8] is the tag of an equation in THEORY.md. */
#ifndef HDLYAP_LOCALIZATION_H
#define HDLYAP_LOCALIZATION_H

#include "hdlyap/status.h"

HD_API_BEGIN

/** The widths of a run's vectors; owned by the run. */
typedef struct hd_localization hd_localization;

/** Number of samples in the means. */
long hd_localization_samples(const hd_localization *shape);

/** Localisation widths exp(S) / N of all n vectors, 1 / N (one particle) .. 1 (all alike). S is the
 * mean over the samples of -sum m_i ln m_i, with m_i = |dq_i|^2 + |dp_i|^2 of particle i and sum
 * m_i = 1 (Taniguchi and Morriss, Phys. Rev. E 68, 046203 (2003)). The array is overwritten by the
 * next call; without samples its values mean nothing. */
const double *hd_localization_widths(hd_localization *shape);
/** Standard error of the width of vector col [T8]; negative while it is not known. */
double hd_localization_width_error(const hd_localization *shape, int col);
/** Width of vector col in the last sample alone. */
double hd_localization_width_now(const hd_localization *shape, int col);

HD_API_END
#endif
