/** A circular container of radius R: its centre is (R, R); centres of particles reach R - 1/2
 * [T21]. */
#ifndef HD_CIRCLE_H
#define HD_CIRCLE_H

#include "scene/container.h"

/** R = sqrt(N / (pi rho)) [sigma]. */
double hd_circle_radius(const hd_scene_def *def);
double hd_circle_reach(const hd_scene_def *def);

/* Entries of the row: see hd_container_row. */

hd_wave_limits hd_circle_limits(const hd_scene_def *def);
void hd_circle_waves(const hd_scene_def *def, hd_wave_taker take, void *to);
int hd_circle_waves_usual(const hd_scene_def *def);
/** Cosine and sine parts of A(r) = J_m(k r) - harmonic (r / reach)^m, for one wave. */
void hd_circle_of_wave(const hd_scene_def *def, const hd_wave *wave, double *own);
void hd_circle_modulations(hd_modulation *out, const double *own, const double *q);

#endif
