/** Cosines and sines of one coordinate, for all numbers of nodes [T10]. */
#ifndef HD_HARMONICS_H
#define HD_HARMONICS_H

#include "hdlyap/wave.h"

/** cos(k u), sin(k u) and their derivatives at one coordinate, for 0 to `nodes` nodes along one
 * direction. */
typedef struct hd_harmonics {
    double offset; /**< coordinate at which u = 0: 1/2 behind a wall */
    int nodes;
    double k;           /**< wave number with one node */
    double *value;      /**< [2 (nodes + 1)]: cosine, sine of each node */
    double *derivative; /**< same */
} hd_harmonics;

/** Fills h, which is all zero, for direction d. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_harmonics_create(hd_harmonics *h, const hd_scene_def *def, int d,
                                            int nodes);
void hd_harmonics_clear(hd_harmonics *h);

void hd_harmonics_fill(hd_harmonics *h, double coordinate);

#endif
