/** The fields of a phase that messages of LP and of T steps share. */
#ifndef HDLYAP_PHASE_H
#define HDLYAP_PHASE_H

#include <math.h>

#include "common/nodes.h"
#include "hdlyap/run.h"

static inline bool phase_is_resolved(const hd_phase *phase)
{
    return phase->state != HD_PHASE_UNRESOLVED;
}

/** The Lyapunov index of the phase's vector, from 1; 0 if there is none. */
static inline uint32_t phase_index(const hd_phase *phase)
{
    return phase_is_resolved(phase) ? (uint32_t)phase->col + 1 : 0;
}

/** The phase; NaN before it has begun. */
static inline double phase_angle(const hd_phase *phase)
{
    const bool begun = phase->time > 0 || phase->state == HD_PHASE_TRACKED;
    return phase_is_resolved(phase) && begun ? phase->phase : NAN;
}

/** Whether the numbers of a phase are finite. If not, the message must not be sent, because NaN
 * would say that they are not known yet. */
static inline bool phase_is_finite(const hd_phase *phase)
{
    return !phase_is_resolved(phase) || isfinite(phase->phase + phase->omega);
}

static inline double phase_time(const hd_phase *phase)
{
    return phase_is_resolved(phase) ? phase->time : 0.0;
}

/** The fields that both messages have, filled. */
#define PHASE_FIELDS(phase_of, step_of)                                                            \
    .step = (uint32_t)phase_of->step, NODES(step_of->wave), .wave_number = step_of->wave.number,   \
    .modulation = phase_of->modulation, .index = phase_index(phase_of),                            \
    .state = (uint8_t)phase_of->state, .a = phase_of->a, .b = phase_of->b,                         \
    .phase = phase_angle(phase_of), .omega = phase_of->omega,                                      \
    .omega_error = phase_of->omega_error, .tracked_time = phase_time(phase_of)

#endif
