/** How far vectors spread over the disks, and how their two halves lie to each other. */
#ifndef HD_SHAPE_H
#define HD_SHAPE_H

#include "hdlyap/frame.h"

typedef struct hd_shape hd_shape;

HD_MUST_CHECK hd_status hd_shape_create(hd_shape **out, int disks, int vectors);
void hd_shape_free(hd_shape *shape);
void hd_shape_clear(hd_shape *shape);

/** Vectors of length 1, all of them. */
void hd_shape_add(hd_shape *shape, hd_columns columns);

/** Localisation width, [n], 1 / N .. 1: exp(<S>) / N with S = -sum m_i ln m_i, m_i = |dq_i|^2 +
 * |dp_i|^2 of disk i (Taniguchi and Morriss, Phys. Rev. E 68, 046203 (2003)). */
const double *hd_shape_widths(hd_shape *shape);

/** Mean |cos| of the angle between the dq and dp halves; [n]. */
const double *hd_shape_cosines(const hd_shape *shape);

#endif
