/** Means over time of the numbers that the row of a program's own dynamics tells of a state
 * (hd_dynamics.average), with standard errors [T8]. The particles are looked at at equal times,
 * four times in (N / 2) / collision_rate of the row, however intervals and samples end, and whoever
 * watches; not more often than they have time steps. Several threads may read one hd_averages at
 * once while no thread calls its run. Tags as [T8] are those of equations in THEORY.md. */
#ifndef HDLYAP_AVERAGES_H
#define HDLYAP_AVERAGES_H

#include "hdlyap/dynamics.h"

HD_API_BEGIN

/** The averages of a run; owned by the run. */
typedef struct hd_averages hd_averages;

/** The mean of one number. */
typedef struct hd_mean {
    const char *name, *unit; /**< those of the row (hd_average) */
    double mean;      /**< mean since the averaging began; NaN while the averaged time is 0 */
    double std_error; /**< its standard error [T8]; negative while it is not known */
} hd_mean;

/** Number of means, which is hd_dynamics.averages. */
int hd_averages_count(const hd_averages *averages);
/** Averaged time: a whole number of times from one look to the next [time units]. */
double hd_averages_time(const hd_averages *averages);
/** The mean of number k = 0 .. hd_averages_count - 1. O(number of blocks), which is at most 97. */
hd_mean hd_averages_read(const hd_averages *averages, int k);

HD_API_END
#endif
