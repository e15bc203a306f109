/** Scene -> events, the slow way: the reference that the trajectory is held against, bit for bit.
 */
#ifndef HD_TWIN_H
#define HD_TWIN_H

#include "interval.h"
#include "testing.h"

typedef struct twin twin;

/** From the state q[2N], p[2N] at time 0; NULL when out of memory. */
twin *twin_create(const hd_scene_def *def, const double *q, const double *p);
void twin_free(twin *t);

/** The next event before simulated time t_end, its t counted from t_begin; false if there is none.
 * Cost O(N^2). */
bool twin_next(twin *t, hd_event *event, double t_begin, double t_end);

/** Fails the test unless the next `events` events of a trajectory at time 0 are those of its twin,
 * bit for bit; frees the trajectory. */
void twin_compare(hd_trajectory *fast, const hd_scene_def *def, size_t events);

#endif
