/** State of the worker -> /diagnostics: what is wrong (conditions.c) or what the run does, and its
 * numbers by key. */
#include "diagnostics.h"

#include <math.h>
#include <stdio.h>

#include "clock.h"
#include "conditions.h"

static const double period = 1.0;

enum { KEYS = 20, TEXT_SIZE = 32 };

/** Keys, and memory for their values. */
typedef struct key_list {
    hdr_key_value value[KEYS];
    char text[KEYS][TEXT_SIZE];
    uint32_t count;
} key_list;

hdr_status diagnostics_advertise(diagnostics *d, hdr_node *ros, const report *rep,
                                 uint64_t collisions, const char *blas_kernel)
{
    const double now = clock_seconds();
    *d = (diagnostics){
        .node_name = hdr_node_name(ros),
        .rep = rep,
        .blas_kernel = blas_kernel,
        .next = now,
        .measured = now,
        .collisions = collisions,
    };
    return hdr_diagnostic_advertise(&d->publisher, ros, "/diagnostics", 10);
}

static void add_text(key_list *list, const char *key, const char *text)
{
    list->value[list->count++] = (hdr_key_value){key, text};
}

static void add_number(key_list *list, const char *key, double number)
{
    char *text = list->text[list->count];
    snprintf(text, TEXT_SIZE, "%.6g", number);
    add_text(list, key, text);
}

static const char *stage_name(const worker_state *state)
{
    if (state->stage == WORKER_WAITING) return "waiting for subscribers";
    if (state->stage == WORKER_PAUSED) return "paused";
    return hdr_run_status_stage_text(state->last.stage);
}

/** Collisions per second since the last call. */
static double collision_rate(diagnostics *d, const progress *last, double now)
{
    const double seconds = now - d->measured;
    const double collisions = (double)(last->collisions - d->collisions);
    d->measured = now;
    d->collisions = last->collisions;
    return seconds > 0.0 ? collisions / seconds : 0.0;
}

static void fill_keys(diagnostics *d, key_list *list, const worker_state *state, double now)
{
    const hd_cost *cost = &state->last.cost;
    add_text(list, "stage", stage_name(state));
    add_number(list, "simulated time", state->last.time);
    add_number(list, "progress", cost->progress);
    add_number(list, "remaining seconds", cost->remaining);
    add_number(list, "interval", cost->interval);
    add_text(list, "interval limited by", hdr_cost_interval_limit_text(cost->limit));
    add_number(list, "condition", cost->condition);
    add_number(list, "repairs", (double)cost->repairs);
    if (state->last.collides)
        add_number(list, "collisions per second", collision_rate(d, &state->last, now));
    add_text(list, "blas kernel", d->blas_kernel);
    if (state->checkpoint.time >= 0)
        add_number(list, "checkpoint of simulated time", state->checkpoint.time);
    if (state->last.resolved_steps >= 0)
        add_number(list, "resolved steps", state->last.resolved_steps);
}

/** Adds the numbers that conditions.c judges. */
static void fill_watched(key_list *list, const worker_state *state, const hdr_lag *slowest)
{
    const examination *seen = &state->seen;
    const double error = state->last.cost.std_error;
    const hd_energy *energy = &state->last.energy;
    const bool stepped = !isnan(energy->error);
    if (seen->made && seen->overlap_max > 0.0) add_number(list, "overlap", seen->overlap);
    if (seen->made || stepped)
        add_number(list, "energy error", stepped ? fabs(energy->error) : seen->energy_error);
    if (stepped) add_number(list, "largest energy error", energy->most);
    if (error >= 0.0) {
        add_number(list, "averaged time", state->last.averaged);
        add_number(list, "error of the smallest exponents", error);
    }
    add_number(list, "seconds that a subscriber is behind", slowest->seconds);
    if (*slowest->topic) add_text(list, "topic that it is behind in", slowest->topic);
    add_number(list, "lost messages", (double)slowest->lost);
}

bool diagnostics_publish(diagnostics *d, const worker_state *state)
{
    const double now = clock_seconds();
    const hdr_lag slowest = report_lag(d->rep);
    const conditions all = conditions_of(state, &slowest);
    key_list list = {.count = 0};
    if (hdr_publisher_subscribers(d->publisher) == 0) return false;
    fill_keys(d, &list, state, now);
    fill_watched(&list, state, &slowest);
    const hdr_diagnostic message = {
        .header = {.stamp = hdr_time_now(), .frame_id = ""},
        .level = all.level,
        .name = d->node_name,
        .message = *all.message ? all.message : stage_name(state),
        .hardware_id = report_run_id(d->rep),
        .values = {list.value, list.count},
    };
    if (hdr_diagnostic_publish(d->publisher, &message) != HDR_OK)
        hdr_log(HDR_ERROR, "diagnostics not sent: %s", hdr_error_text());
    return true;
}

bool diagnostics_update(diagnostics *d, const worker_state *state)
{
    const double now = clock_seconds();
    if (now < d->next) return false;
    d->next = fmax(d->next + period, now);
    return diagnostics_publish(d, state);
}
