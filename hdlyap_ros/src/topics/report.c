/** Publishes the topics of a run, by loops over the rows of the table of topics. One thread at a
 * time may call. */
#include "topics/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "node/clock.h"
#include "topics/moment.h"
#include "topics/slow_vectors.h"
#include "topics/subscriber_wait.h"

static hd_status (*const publish_topic[TOPICS])(const moment *) = {
#define TOPIC(name, ...) [TOPIC_##name] = topic_publish_##name,
#include "topics/rows.inc"
#undef TOPIC
};

struct report {
    const settings *set;
    publishers out;
    buffers room;
    kept_of_topics kept;
    subscriber_wait awaited;
    unsigned demand; /**< set of topics with a subscriber when the step under way began */
    double seconds;  /**< wall time spent in publishing, without waiting for subscribers */
    double waited;   /**< wall time of that waiting */
    hdr_time stamp;  /**< of the last report */
    bool unfinished; /**< report_finish will publish the last messages of this report */
};

/** The number of resolved steps; -1 while they are not computed. */
static int resolved_steps(const hd_run *run)
{
    const hd_modes *modes = hd_run_parts(run).modes;
    const hd_steps *steps = hd_run_parts(run).steps;
    int resolved = 0;
    if (!modes || hd_modes_samples(modes) == 0) return -1;
    for (int s = 0; s < hd_steps_count(steps); s++) resolved += hd_steps_step(steps, s)->resolved;
    return resolved;
}

/** Wall seconds to the end, from the time spent so far, or from the pace if that takes longer. */
static double remaining_at(const hd_cost *cost, double time, double pace)
{
    if (!(pace > 0 && cost->progress > 0 && cost->remaining >= 0)) return cost->remaining;
    return fmax(cost->remaining, time * (1.0 / cost->progress - 1.0) / pace);
}

/** Whether the time step splits the zero exponents. That is known once there are standard errors,
 * if the vectors reach the zero exponents. */
static split_zeros split_of(const hd_run *run, const hd_cost *cost)
{
    const hd_scene_def *scene = hd_run_scene(run);
    const hd_dynamics *of = hd_dynamics_of(scene);
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    const int first = hd_scene_counts(scene).positive;
    split_zeros split = {.are = false};
    if (!hd_scene_symplectic(scene) || !of->zero_splitting_order || !of->step || !spectrum ||
        first >= hd_run_vectors(run) || cost->std_error < 0.0)
        return split;
    const double time = hd_spectrum_time(spectrum), own = log(time) / time;
    split.exponent = hd_spectrum_exponent(spectrum, first);
    split.expected = fmax(own, scene->accuracy);
    split.step = of->step(scene);
    split.power = of->zero_splitting_order(scene);
    split.are = time > exp(1.0) && split.exponent > own + scene->accuracy;
    return split;
}

progress progress_of(const hd_run *run, double pace)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    hd_cost cost = hd_run_cost(run);
    cost.remaining = remaining_at(&cost, hd_run_time(run), pace);
    return (progress){
        .stage = hd_run_stage(run),
        .time = hd_run_time(run),
        .collides = hd_dynamics_of(hd_run_scene(run))->collides,
        .collisions = hd_trajectory_totals(hd_run_parts(run).trajectory).collisions,
        .cost = cost,
        .averaged = spectrum ? hd_spectrum_time(spectrum) : 0.0,
        .resolved_steps = resolved_steps(run),
        .caged = hd_run_is_caged(run),
        .energy = hd_trajectory_energy(hd_run_parts(run).trajectory),
        .split = split_of(run, &cost),
    };
}

/* ---- creation ------------------------------------------------------------------------------- */

static hdr_status advertise(report *rep, hdr_node *ros, const hd_run *run, unsigned set)
{
    const hd_result_counts e = extent_of(rep->set, hd_result_counts_of(&rep->set->def, run));
    double bytes[TOPICS];
    for (topic t = 0; t < TOPICS; t++) {
        const topic_size s = topic_size_of(t, &e);
        bytes[t] = (s.report + s.fields + s.window) / fmax(s.messages, 1.0);
    }
    const bool waits = strcmp(rep->set->slow_subscribers, "wait") == 0;
    return publishers_advertise(&rep->out, ros, set, bytes, waits, rep->set->seed);
}

hdr_status report_create(report **out, hdr_node *ros, const settings *set, const hd_run *run)
{
    const unsigned asked = set->observables | topics_that_are(TOPIC_ALWAYS | TOPIC_FOR_VIEWERS);
    report *rep = *out = calloc(1, sizeof *rep);
    if (!rep) return HDR_NO_MEMORY;
    rep->set = set;
    const hdr_status status = advertise(rep, ros, run, asked);
    if (status == HDR_OK) return HDR_OK;
    report_free(rep);
    *out = NULL;
    return status;
}

void report_free(report *rep)
{
    if (!rep) return;
    buffers_clear(&rep->room);
    free(rep);
}

const char *report_run_id(const report *rep) { return rep->out.run_id; }

hdr_lag report_lag(const report *rep) { return publishers_lag(&rep->out); }

/* ---- who listens ---------------------------------------------------------------------------- */

bool report_awaited_here(report *rep)
{
    return subscriber_wait_over(&rep->awaited, &rep->out, rep->set->awaited);
}

/** The message steps needs lp_phases too, for the velocity. The table in the log needs steps. */
unsigned report_demand(report *rep)
{
    rep->demand = publishers_subscribed(&rep->out);
    const unsigned steps = topic_bit(TOPIC_steps), all = steps | topic_bit(TOPIC_lp_phases);
    const bool looked_at = (rep->demand & steps) || rep->set->table > 0.0;
    return topic_stages(rep->demand | (looked_at ? all : 0));
}

void report_demand_slow(report *rep, hd_run *run)
{
    slow_vectors_demand(&rep->kept.slow_vectors, &rep->out, rep->set, run);
}

/** The first vector of those that fields publish: of the chosen ones and of the steps. */
static int first_field(const settings *set, const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    int first = hd_run_vectors(run);
    for (int k = 0; k < set->fields.count; k++)
        if (set->fields.index[k] - 1 < first) first = set->fields.index[k] - 1;
    for (int s = 0; s < hd_steps_count(steps); s++)
        if (hd_steps_step(steps, s)->resolved && hd_steps_step(steps, s)->col < first)
            first = hd_steps_step(steps, s)->col;
    return first;
}

hd_status report_vectors(report *rep, hd_run *run)
{
    const bool fields = hd_run_fields_due(run) && rep->demand & topic_bit(TOPIC_fields);
    const int slow = slow_vectors_first(&rep->kept.slow_vectors, rep->set, run),
              field = fields ? first_field(rep->set, run) : hd_run_vectors(run);
    const int first = slow < field ? slow : field;
    return first < hd_run_vectors(run) ? hd_run_measure(run, first) : HD_OK;
}

/** The observables to publish at a report: those that have a subscriber and, if they need vectors,
 * had one when the step began, as these were not measured otherwise. */
static unsigned topics_due(const report *rep, const hd_run *run)
{
    const hd_modes *modes = hd_run_parts(run).modes;
    const unsigned measured = topics_of_stages(HD_OBSERVE_ANY) & topics_that_are(TOPIC_OF_VECTORS);
    unsigned set = publishers_subscribed(&rep->out) & topics_that_are(TOPIC_OBSERVABLE);
    set &= ~topics_that_are(TOPIC_OF_WINDOWS);
    if (!modes || hd_modes_samples(modes) == 0) set &= ~topics_that_are(TOPIC_OF_STEPS);
    return set & (rep->demand | ~measured);
}

/* ---- messages ------------------------------------------------------------------------------- */

/** What is published now, with this stamp. */
static moment moment_of(report *rep, const hd_run *run, hdr_time stamp)
{
    rep->out.stamp = stamp;
    rep->room.known = false;
    return (moment){.out = &rep->out,
                    .set = rep->set,
                    .run = run,
                    .seconds = rep->seconds,
                    .waited = rep->waited,
                    .room = &rep->room,
                    .kept = &rep->kept};
}

static hd_status publish(report *rep, moment *now, unsigned set)
{
    hd_status status = HD_OK;
    for (topic t = 0; t < TOPICS && status == HD_OK; t++) {
        if (!(set & topic_bit(t)) || !rep->out.publisher[t]) continue;
        now->topic = t;
        now->room->taken = 0;
        status = publish_topic[t](now);
    }
    return status;
}

/** Publishes cost, if anybody listens, and then status. */
static hd_status publish_progress(report *rep, const progress *last, hdr_time stamp)
{
    moment now = moment_of(rep, NULL, stamp);
    now.last = last;
    const hd_status status = publish(rep, &now,
                                     publishers_subscribed(&rep->out) & topic_bit(TOPIC_cost));
    return status == HD_OK ? publish(rep, &now, topic_bit(TOPIC_status)) : status;
}

/** When publishing began, and how long it had waited for subscribers by then. */
typedef struct spending {
    double start, waited;
} spending;

static spending spending_begin(const report *rep)
{
    return (spending){clock_seconds(), publishers_waited(&rep->out)};
}

/** Adds the time since then to that of publishing, but for what it has waited for subscribers. */
static void spending_end(report *rep, spending since)
{
    rep->waited = publishers_waited(&rep->out);
    rep->seconds += clock_seconds() - since.start - (rep->waited - since.waited);
}

/** The last cost and status of a run that has finished are left to report_finish. */
hd_status report_publish(report *rep, const hd_run *run)
{
    const spending since = spending_begin(rep);
    rep->stamp = hdr_time_now();
    rep->unfinished = hd_run_stage(run) == HD_FINISHED;
    moment now = moment_of(rep, run, rep->stamp);
    hd_status status = publish(rep, &now, topics_due(rep, run));
    if (status == HD_OK && !rep->unfinished) {
        const progress last = progress_of(run, rep->set->pace);
        status = publish_progress(rep, &last, rep->stamp);
    }
    spending_end(rep, since);
    return status;
}

hd_status report_window(report *rep, const hd_run *run)
{
    const spending since = spending_begin(rep);
    moment now = moment_of(rep, run, hdr_time_now());
    const hd_status status = publish(rep, &now, topics_that_are(TOPIC_OF_WINDOWS));
    spending_end(rep, since);
    return status;
}

hd_status report_slow(report *rep, const hd_run *run, bool at_rest)
{
    const spending since = spending_begin(rep);
    moment now = moment_of(rep, run, hdr_time_now());
    now.topic = TOPIC_slow_vectors;
    now.room->taken = 0;
    const hd_status status = at_rest ? slow_vectors_rest(&now) : topic_publish_slow_vectors(&now);
    spending_end(rep, since);
    return status;
}

hd_status report_run_info(report *rep, const hd_run *run, const changes *all)
{
    moment now = moment_of(rep, run, hdr_time_now());
    now.changes = all;
    return publish(rep, &now, topic_bit(TOPIC_run_info));
}

hd_status report_finish(report *rep, const progress *last)
{
    progress finished = *last;
    finished.stage = HD_FINISHED;
    return publish_progress(rep, &finished, rep->unfinished ? rep->stamp : hdr_time_now());
}
