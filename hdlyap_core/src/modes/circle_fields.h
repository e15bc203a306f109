/** Modulations of a circle: A = J_m(k r) cos(m theta), J_m(k r) sin(m theta) [T21]. */
#ifndef HD_CIRCLE_FIELDS_H
#define HD_CIRCLE_FIELDS_H

#include "hdlyap/wave.h"

/** A and its gradient at one place. */
typedef struct hd_circle_modulation {
    double a, x, y;
} hd_circle_modulation;

/** out[2]: of the cosine and of the sine, at (x, y) from the centre. */
void hd_circle_modulations(hd_circle_modulation out[2], const hd_wave *wave, double x, double y);

#endif
