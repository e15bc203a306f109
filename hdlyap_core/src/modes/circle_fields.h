/** Modulations of a circle: radial functions times cos(m theta) and sin(m theta) [T21]. */
#ifndef HD_CIRCLE_FIELDS_H
#define HD_CIRCLE_FIELDS_H

#include "hdlyap/fields.h"

/** A and its gradient at one place. */
typedef struct hd_circle_modulation {
    double a, x, y;
} hd_circle_modulation;

/** A(r) = J_m(k r) - harmonic (r / reach)^m. */
typedef struct hd_circle_wave {
    int m;
    double k, reach;
    double harmonic; /**< 0 of L and P fields; of T fields J_m(k reach): A vanishes at the wall */
} hd_circle_wave;

hd_circle_wave hd_circle_wave_of(const hd_wave *wave, double reach);

/** out[2]: of the cosine and of the sine, at (x, y) from the centre. */
void hd_circle_modulations(hd_circle_modulation out[2], const hd_circle_wave *wave, double x,
                           double y);

/** row[d][..]: component d of all columns at q, where the momentum is p; round[subspaces] are the
 * waves of the subspaces of a circle about (centre, centre). */
void hd_circle_fields_fill(double *const *row, const hd_subspace *subspace,
                           const hd_circle_wave *round, int subspaces, double centre,
                           const double *q, const double *p);

#endif
