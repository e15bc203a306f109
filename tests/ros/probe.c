/** Preloaded into the node: stands before some functions of the core to make what seldom happens happen,
 *  and to count what should not. All of it by environment variables, nothing without them. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hdlyap/run.h"

static atomic_long steps, states, halves;

/** The core's own function of that name, into the pointer that `function` is the address of. */
static void next(void *function, const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found) abort();
    memcpy(function, &found, sizeof found);
}

static double number(const char *variable)
{
    const char *text = getenv(variable);
    return text ? atof(text) : 0.0;
}

/** PROBE_STEP_SECONDS: a step takes so much longer. PROBE_FAULT_AFTER: steps before one fails. */
hd_status hd_run_step(hd_run *run)
{
    hd_status (*real)(hd_run *);
    const double seconds = number("PROBE_STEP_SECONDS"), fault_after = number("PROBE_FAULT_AFTER");
    struct timespec left = {(time_t)seconds, (long)(1e9 * (seconds - floor(seconds)))};
    while (nanosleep(&left, &left)) continue;
    if (fault_after > 0.0 && (double)atomic_fetch_add(&steps, 1) >= fault_after)
        return HD_ILL_CONDITIONED;
    next(&real, "hd_run_step");
    return real(run);
}

/** PROBE_NAN: the first momentum is not a number. */
void hd_trajectory_state(const hd_trajectory *trajectory, double *q, double *p)
{
    void (*real)(const hd_trajectory *, double *, double *);
    next(&real, "hd_trajectory_state");
    real(trajectory, q, p);
    atomic_fetch_add(&states, 1);
    if (p && getenv("PROBE_NAN")) p[0] = NAN;
}

void hd_frame_halves(const hd_frame *frame, double *cos_theta, double *dp_dq_ratio)
{
    void (*real)(const hd_frame *, double *, double *);
    next(&real, "hd_frame_halves");
    real(frame, cos_theta, dp_dq_ratio);
    atomic_fetch_add(&halves, 1);
}

/** PROBE_COUNTS: file for the numbers of calls. */
__attribute__((destructor)) static void write_counts(void)
{
    const char *path = getenv("PROBE_COUNTS");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    fprintf(file, "%ld %ld\n", atomic_load(&states), atomic_load(&halves));
    fclose(file);
}
