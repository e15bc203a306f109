/** State of the worker -> conditions. ERROR: a fault has ended the run, or its numbers or its
 * checkpoint are not right. WARN: the numbers are right, but something is not as the user would
 * want it. */
#include "conditions.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/** A subscriber that is this far behind is reported [s]. */
static const double behind_seconds = 3.0;

void split_write(char text[CONDITION_STEP], const split_zeros *split)
{
    snprintf(text, CONDITION_STEP,
             "time_step = %.4g is too long for the zero exponents: the largest is %.2g, not %.2g; "
             "it falls as time_step^%.2g",
             split->step, split->exponent, split->expected, split->power);
}

bool energy_write(char text[CONDITION_STEP], const hd_energy *energy)
{
    snprintf(text, CONDITION_STEP,
             "the energy has been off by %.2g, asked is %.2g: take a shorter time_step or a "
             "coarser accuracy",
             energy->most, energy->asked);
    return energy->most > energy->asked;
}

/** Adds a condition; errors must be added before warnings. */
__attribute__((format(printf, 3, 4))) static void add(conditions *all, uint8_t level,
                                                      const char *format, ...)
{
    const size_t length = strlen(all->message);
    char *end = all->message + length;
    const size_t room = sizeof all->message - length;
    const int separator = snprintf(end, room, "%s", length > 0 ? "; " : "");
    va_list list;
    va_start(list, format);
    if ((size_t)separator < room)
        vsnprintf(end + separator, room - (size_t)separator, format, list);
    va_end(list);
    if (level > all->level) all->level = level;
}

static void add_errors(conditions *all, const worker_state *state)
{
    const examination *seen = &state->seen;
    const uint8_t level = HDR_DIAGNOSTIC_ERROR;
    if (state->status != HD_OK) add(all, level, "%s", hd_status_text(state->status));
    if (state->checkpoint.failed) add(all, level, "%s", state->checkpoint.message);
    if (!(seen->overlap <= seen->overlap_max))
        add(all, level, "%s overlap by %.2g, rounding explains %.2g", state->particles,
            seen->overlap, seen->overlap_max);
    if (!(seen->energy_error <= seen->energy_error_max))
        add(all, level, "energy is off by %.2g, rounding explains %.2g", seen->energy_error,
            seen->energy_error_max);
}

static void add_warnings(conditions *all, const worker_state *state, const hdr_lag *slowest)
{
    const progress *last = &state->last;
    const hd_target_progress *at = &last->cost.target;
    const uint8_t level = HDR_DIAGNOSTIC_WARN;
    char step[CONDITION_STEP];
    if (*state->warning) add(all, level, "%s", state->warning);
    if (last->cost.stalled_since >= 0.0)
        add(all, level,
            "errors of the smallest exponents do not fall: %.2g after %.3g time units of "
            "averaging, %.2g after %.3g",
            last->cost.stalled_error, last->cost.stalled_since, last->cost.std_error,
            last->averaged);
    if (state->lost > 0.0)
        add(all, level, "nobody can subscribe: no ROS master has known this node for %.0f s",
            state->lost);
    if (*at->name && at->error >= 0.0 && at->open >= at->wanted)
        add(all, level,
            "the target of %s, %.2g, cannot be reached: an error of %.2g remains, however long it "
            "averages",
            at->name, at->wanted, at->open);
    if (last->caged)
        add(all, level,
            "%s keep their places: errors hold for this arrangement only, other seeds may differ",
            state->particles);
    if (energy_write(step, &last->energy)) add(all, level, "%s", step);
    if (last->split.are) {
        split_write(step, &last->split);
        add(all, level, "%s", step);
    }
    if (slowest->seconds >= behind_seconds)
        add(all, level, "a subscriber of %s is %.1f s behind", slowest->topic, slowest->seconds);
    if (slowest->lost > 0)
        add(all, level, "subscribers of %s have lost %" PRId64 " messages", slowest->topic,
            slowest->lost);
}

conditions conditions_of(const worker_state *state, const hdr_lag *slowest)
{
    conditions all = {.level = HDR_DIAGNOSTIC_OK, .message = ""};
    add_errors(&all, state);
    add_warnings(&all, state, slowest);
    return all;
}
