/** Operations on whole arrays of numbers. */
#ifndef HD_ARRAYS_H
#define HD_ARRAYS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/** Adds x to the running mean of each entry; `samples` counts x, too. */
static inline void hd_mean_add(double *mean, const double *x, size_t count, long samples)
{
    for (size_t k = 0; k < count; k++) mean[k] += (x[k] - mean[k]) / (double)samples;
}

static inline bool hd_all_finite(const double *x, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; k++) sum += x[k];
    return isfinite(sum);
}

#endif
