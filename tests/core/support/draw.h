/** Random choices, the same bits everywhere. */
#ifndef HD_DRAW_H
#define HD_DRAW_H

#include <math.h>
#include <stdbool.h>

#include "base/random.h"
#include "scenes.h"

static inline double uniform(hd_random *random)
{
    return 0.5 * (hd_random_symmetric(random) + 1.0);
}

static inline bool chance(hd_random *random, double probability)
{
    return uniform(random) < probability;
}

static inline int one_of(hd_random *random, int count) { return (int)(uniform(random) * count); }

static inline double log_uniform(hd_random *random, double least, double most)
{
    const double x = exp(log(least) + uniform(random) * log(most / least));
    return fmin(fmax(x, least), most);
}

/** A unit vector. */
static inline void draw_direction(hd_random *random, double out[DIM])
{
    double square = 2.0;
    while (square > 1.0 || square < 0.1) {
        square = 0.0;
        for (int d = 0; d < DIM; d++) out[d] = hd_random_symmetric(random);
        for (int d = 0; d < DIM; d++) square += out[d] * out[d];
    }
    for (int d = 0; d < DIM; d++) out[d] /= sqrt(square);
}

/** A unit vector across a direction. */
static inline void draw_across(hd_random *random, double out[DIM], const double e[DIM])
{
    double square = 0.0;
    while (square < 0.01) {
        double along = 0.0;
        square = 0.0;
        draw_direction(random, out);
        for (int d = 0; d < DIM; d++) along += out[d] * e[d];
        for (int d = 0; d < DIM; d++) out[d] -= along * e[d];
        for (int d = 0; d < DIM; d++) square += out[d] * out[d];
    }
    for (int d = 0; d < DIM; d++) out[d] /= sqrt(square);
}

#endif
