/** Preloaded into the node: stands before some functions of the core to make what seldom happens
 * happen, and to count what should not. All of it by environment variables, nothing without them.
 */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "hdlyap/hydro.h"
#include "hdlyap/pmode.h"
#include "hdlyap/run.h"
#include "hdlyap_ros/markers.h"
#include "base/memory.h"

enum { STEPS_TO_JUMP = 10 };

static atomic_long steps, overlaps, states, halves, measures, phases, pmodes, hydros, samples,
    widths, allocations;

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
hd_status hd_run_advance(hd_run *run)
{
    hd_status (*real)(hd_run *);
    const double seconds = number("PROBE_STEP_SECONDS"), fault_after = number("PROBE_FAULT_AFTER");
    struct timespec left = {(time_t)seconds, (long)(1e9 * (seconds - floor(seconds)))};
    while (nanosleep(&left, &left)) continue;
    if ((double)atomic_fetch_add(&steps, 1) >= fault_after && fault_after > 0.0)
        return HD_ILL_CONDITIONED;
    next(&real, "hd_run_advance");
    return real(run);
}

/** PROBE_CLOCK_JUMP: seconds by which the machine's clock is set once the run goes on. */
int clock_gettime(clockid_t clock, struct timespec *now)
{
    int (*real)(clockid_t, struct timespec *);
    next(&real, "clock_gettime");
    const int status = real(clock, now);
    if (clock == CLOCK_REALTIME && atomic_load(&steps) >= STEPS_TO_JUMP)
        now->tv_sec += (time_t)number("PROBE_CLOCK_JUMP");
    return status;
}

int gettimeofday(struct timeval *restrict now, void *restrict zone)
{
    struct timespec time;
    (void)zone;
    const int status = clock_gettime(CLOCK_REALTIME, &time);
    *now = (struct timeval){time.tv_sec, time.tv_nsec / 1000};
    return status;
}

/** PROBE_FSYNC_AFTER: files that the disk has taken before it does not answer any more. */
int fsync(int file)
{
    static atomic_long files;
    int (*real)(int);
    const double after = number("PROBE_FSYNC_AFTER");
    while (after > 0.0 && (double)atomic_load(&files) >= after) sleep(1);
    atomic_fetch_add(&files, 1);
    next(&real, "fsync");
    return real(file);
}

/** PROBE_THREADS: that there may be besides the first one. */
int pthread_create(pthread_t *restrict thread, const pthread_attr_t *restrict how,
                   void *(*begin)(void *), void *restrict with)
{
    static atomic_long threads;
    int (*real)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    const bool is_over = getenv("PROBE_THREADS") &&
                         (double)atomic_fetch_add(&threads, 1) >= number("PROBE_THREADS");
    next(&real, "pthread_create");
    return is_over ? EAGAIN : real(thread, how, begin, with);
}

/** PROBE_OVERLAP: how deep disks overlap once the run has begun [sigma]. */
hd_invariants hd_trajectory_examined(const hd_trajectory *trajectory)
{
    hd_invariants (*real)(const hd_trajectory *);
    next(&real, "hd_trajectory_examined");
    hd_invariants examined = real(trajectory);
    if (atomic_load(&steps) == 0) return examined;
    atomic_fetch_add(&overlaps, 1);
    if (getenv("PROBE_OVERLAP")) examined.overlap = number("PROBE_OVERLAP");
    return examined;
}

/** PROBE_STD_ERROR: of the positive exponents nearest to zero, at all times. */
double hd_spectrum_largest_error(const hd_spectrum *spectrum, int begin, int end)
{
    double (*real)(const hd_spectrum *, int, int);
    next(&real, "hd_spectrum_largest_error");
    return getenv("PROBE_STD_ERROR") ? number("PROBE_STD_ERROR") : real(spectrum, begin, end);
}

/** PROBE_MEMORY_AFTER: blocks of the core before memory is out. */
void *hd_memory_alloc(size_t count, size_t size)
{
    void *(*real)(size_t, size_t);
    const double memory_after = number("PROBE_MEMORY_AFTER");
    const long before = atomic_fetch_add(&allocations, 1);
    if (memory_after > 0.0 && (double)before >= memory_after) return NULL;
    next(&real, "hd_memory_alloc");
    return real(count, size);
}

/** PROBE_GROWTH: bytes that a block of memory which grows may have. */
void *realloc(void *block, size_t size)
{
    void *(*real)(void *, size_t);
    const double most = number("PROBE_GROWTH");
    if (most > 0.0 && (double)size > most) return NULL;
    next(&real, "realloc");
    return real(block, size);
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

/** The same in a box, as the core looks itself. */
void hd_trajectory_places(const hd_trajectory *trajectory, double *q, double *p);
void hd_trajectory_places(const hd_trajectory *trajectory, double *q, double *p)
{
    void (*real)(const hd_trajectory *, double *, double *);
    next(&real, "hd_trajectory_places");
    real(trajectory, q, p);
    atomic_fetch_add(&states, 1);
}

/** PROBE_NAN_ANGLE: the one between covariant centre and null space is not a number. */
hd_covariant_results hd_covariant_read(const hd_covariant *covariant)
{
    hd_covariant_results (*real)(const hd_covariant *);
    next(&real, "hd_covariant_read");
    hd_covariant_results results = real(covariant);
    if (getenv("PROBE_NAN_ANGLE")) results.null = NAN;
    return results;
}

/** PROBE_NAN_PHASE: that of the followed vectors of a resolved step is not a number. */
const hd_phase *hd_phases_phase(const hd_phases *of, int index)
{
    static hd_phase said;
    const hd_phase *(*real)(const hd_phases *, int);
    next(&real, "hd_phases_phase");
    if (!getenv("PROBE_NAN_PHASE")) return real(of, index);
    said = *real(of, index);
    if (said.state != HD_PHASE_UNRESOLVED) said.phase = NAN;
    return &said;
}

/** PROBE_NAN_RATE: where a step has one, it is not a number. */
bool hd_phases_rate(const hd_phases *of, int step, double *omega, double *error)
{
    bool (*real)(const hd_phases *, int, double *, double *);
    next(&real, "hd_phases_rate");
    const bool known = real(of, step, omega, error);
    if (known && getenv("PROBE_NAN_RATE")) *omega = NAN;
    return known;
}

void hd_run_dq_dp(const hd_run *run, double *cos_theta, double *dp_dq_ratio)
{
    void (*real)(const hd_run *, double *, double *);
    next(&real, "hd_run_dq_dp");
    real(run, cos_theta, dp_dq_ratio);
    atomic_fetch_add(&halves, 1);
}

hd_status hd_modes_measure(hd_modes *modes, hd_columns v, const double *q, const double *p)
{
    hd_status (*real)(hd_modes *, hd_columns, const double *, const double *);
    next(&real, "hd_modes_measure");
    atomic_fetch_add(&measures, 1);
    return real(modes, v, q, p);
}

/** One at each measured state of the averaging. */
void hd_spectrum_sample(hd_spectrum *spectrum)
{
    void (*real)(hd_spectrum *);
    next(&real, "hd_spectrum_sample");
    atomic_fetch_add(&samples, 1);
    real(spectrum);
}

void hd_phases_add(hd_phases *followed, const hd_steps *found, double time)
{
    void (*real)(hd_phases *, const hd_steps *, double);
    next(&real, "hd_phases_add");
    atomic_fetch_add(&phases, 1);
    real(followed, found, time);
}

bool hd_pmode_reconstruct(hd_pmode *pmode, const hd_step *step, const hd_modes *modes,
                          hd_columns vectors)
{
    bool (*real)(hd_pmode *, const hd_step *, const hd_modes *, hd_columns);
    next(&real, "hd_pmode_reconstruct");
    atomic_fetch_add(&pmodes, 1);
    return real(pmode, step, modes, vectors);
}

void hd_hydro_measure(hd_hydro *hydro, const hd_steps *found, hd_columns vectors, const double *q,
                      const double *p)
{
    void (*real)(hd_hydro *, const hd_steps *, hd_columns, const double *, const double *);
    next(&real, "hd_hydro_measure");
    atomic_fetch_add(&hydros, 1);
    real(hydro, found, vectors, q, p);
}

void hd_localization_measure(hd_localization *shape, hd_columns columns)
{
    void (*real)(hd_localization *, hd_columns);
    next(&real, "hd_localization_measure");
    atomic_fetch_add(&widths, 1);
    real(shape, columns);
}

/* Messages made, of each type. */
#define COUNT_MESSAGES(type)                                                                       \
    static atomic_long of_##type;                                                                  \
    hdr_status type##_publish(hdr_publisher *publisher, const type *message)                       \
    {                                                                                              \
        hdr_status (*real)(hdr_publisher *, const type *);                                         \
        next(&real, #type "_publish");                                                             \
        atomic_fetch_add(&of_##type, 1);                                                           \
        return real(publisher, message);                                                           \
    }
#define WRITE_MESSAGES(type) fprintf(file, "%s_publish %ld\n", &#type[4], atomic_load(&of_##type));
#define TYPES(DO) HDR_MESSAGES(DO) DO(hdr_diagnostic)
TYPES(COUNT_MESSAGES)

/** PROBE_COUNTS: file for the numbers of calls, one to a line with its name. */
__attribute__((destructor)) static void write_counts(void)
{
    const struct {
        const char *name;
        long calls;
    } counts[] = {
        {"trajectory_overlap", atomic_load(&overlaps)},
        {"trajectory_state", atomic_load(&states)},
        {"frame_halves", atomic_load(&halves)},
        {"modes_measure", atomic_load(&measures)},
        {"phases_add", atomic_load(&phases)},
        {"pmode_reconstruct", atomic_load(&pmodes)},
        {"hydro_measure", atomic_load(&hydros)},
        {"memory_alloc", atomic_load(&allocations)},
        {"spectrum_sample", atomic_load(&samples)},
        {"localization_measure", atomic_load(&widths)},
    };
    const char *path = getenv("PROBE_COUNTS");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
        fprintf(file, "%s %ld\n", counts[k].name, counts[k].calls);
    TYPES(WRITE_MESSAGES)
    fclose(file);
}
