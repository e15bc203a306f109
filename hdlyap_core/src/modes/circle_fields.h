/** Modulations of a circle: radial functions times cos(m theta) and sin(m theta) [T21]. */
#ifndef HD_CIRCLE_FIELDS_H
#define HD_CIRCLE_FIELDS_H

#include "hdlyap/wave.h"

/** A and its gradient at one place. */
typedef struct hd_circle_modulation {
    double a, x, y;
} hd_circle_modulation;

/** out[2]: of the cosine and of the sine, at (x, y) from the centre: J_m(k r) of the L and P
 * fields; of T fields J_m(k r) - J_m(k a) (r / a)^m, which vanishes at the wall, a = `reach`. */
void hd_circle_modulations(hd_circle_modulation out[2], const hd_wave *wave, double reach, double x,
                           double y);

#endif
