/** How far vectors spread over the disks, and how their two halves lie to each other. */
#ifndef HD_LOCALIZATION_H
#define HD_LOCALIZATION_H

#include "base/archive.h"
#include "hdlyap/frame.h"

typedef struct hd_localization hd_localization;

HD_MUST_CHECK hd_status hd_localization_create(hd_localization **out, int disks, int vectors);
void hd_localization_free(hd_localization *shape);
void hd_localization_clear(hd_localization *shape);

/** Vectors of length 1, all of them. */
void hd_localization_add(hd_localization *shape, hd_columns columns);

/** Localisation width, [n], 1 / N .. 1: exp(<S>) / N with S = -sum m_i ln m_i, m_i = |dq_i|^2 +
 * |dp_i|^2 of disk i (Taniguchi and Morriss, Phys. Rev. E 68, 046203 (2003)). */
const double *hd_localization_widths(hd_localization *shape);

/** Mean |cos| of the angle between the dq and dp halves; [n]. */
const double *hd_localization_cosines(const hd_localization *shape);

void hd_localization_archive(hd_localization *shape, hd_archive *archive);

#endif
