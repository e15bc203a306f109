/** Random choices, the same bits everywhere. */
#ifndef HD_DRAW_H
#define HD_DRAW_H

#include <math.h>
#include <stdbool.h>

#include "base/random.h"

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

#endif
