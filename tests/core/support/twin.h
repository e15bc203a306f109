/** Scene -> events, the slow way: the reference that the trajectory is held against, bit for bit.
 */
#ifndef HD_TWIN_H
#define HD_TWIN_H

#include "interval.h"
#include "testing.h"

typedef struct twin twin;

/** From q[DIM N], and p[DIM N] over masses, at time 0; NULL when out of memory. */
twin *twin_create(const hd_scene_def *def, const double *q, const double *p);
void twin_free(twin *t);

/** The next event before simulated time t_end, its t counted from t_begin; false if there is none.
 * Cost O(N^2). */
bool twin_next(twin *t, hd_event *event, double t_begin, double t_end);

/** Follows a trajectory at time 0 and its twin side by side, for some pieces of time that grow, or
 * so many events; returns how many there were. Fails the test unless they are the same, bit for
 * bit.
 */
size_t twin_follow(hd_trajectory *fast, const hd_scene_def *def, size_t events, int pieces);

/** Fails the test unless the next `events` events of a trajectory at time 0 are those of its twin,
 * bit for bit; frees the trajectory. */
void twin_compare(hd_trajectory *fast, const hd_scene_def *def, size_t events);

#endif
