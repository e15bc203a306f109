/** A run <-> its checkpoint. Each part of the run knows its own arrays (archive.h); this file binds
 * them together, and checks that they fit the scene that is asked for. */
#include "hdlyap/checkpoint.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "averages/spectrum.h"
#include "dynamics/trajectory.h"
#include "tangent/frame.h"
#include "tangent/interval.h"
#include "base/check.h"
#include "base/clock.h"
#include "hdlyap/blas.h"
#include "run/checkpoint.h"
#include "run/checkpoint_file.h"
#include "run/order.h"
#include "run/run_state.h"
#include "scene/parameters.h"
#include "scene/scene.h"
#include "dynamics/dynamics.h"
#include "scene/dynamics.h"

enum { VALUE = 32 }; /* of a parameter, in words */

/* ---- a run's own numbers ------------------------------------------------------------------- */

/** Reads or writes the name of the dynamics, which the core or the reading program has to know. */
static bool dynamics_archive(hd_checkpoint *head, hd_archive *archive, hd_known known)
{
    const char *name = archive->writing ? hd_dynamics_of(&head->scene)->particles : "";
    snprintf(head->particles, sizeof head->particles, "%s", name);
    hd_archive_text(archive, "particles", head->particles, sizeof head->particles);
    return archive->writing || !hd_archive_good(archive) ||
           hd_dynamics_named(&head->scene.dynamics, head->particles, known);
}

/** Reads or writes the head; false if the dynamics is not known, so that there is no scene. */
static bool head_archive(hd_checkpoint *head, hd_archive *archive, hd_known known)
{
    hd_archive_text(archive, "label", head->label, sizeof head->label);
    if (!dynamics_archive(head, archive, known)) return false;
    hd_scene_archive(&head->scene, archive);
    hd_archive_double(archive, "time", &head->time);
    return true;
}

/** Reads or writes what the run has exchanged; its cost has what the communicator has not counted.
 */
static void traffic_archive(hd_run *run, hd_archive *archive)
{
    const hd_traffic now = hd_communicator_traffic(run->communicator);
    double *const before[] = {&run->cost.communication, &run->cost.bytes, &run->cost.calls};
    const double counted[] = {now.seconds, now.bytes, now.calls};
    hd_archive_of_doubles(archive, "cost traffic", 3);
    for (int k = 0; k < 3; k++) {
        double all = *before[k] + counted[k];
        hd_archive_next_doubles(archive, &all, 1);
        if (!archive->writing) *before[k] += all;
    }
}

static void cost_archive(hd_run *run, hd_archive *archive)
{
    hd_cost *c = &run->cost;
    double *const numbers[] = {&c->events,   &c->replay,    &c->ortho,  &c->spectrum, &c->modes,
                               &c->interval, &c->condition, &c->defect, &c->following};
    long *const counts[] = {&c->orthonormalisations, &c->second_passes, &c->slow_vector_samples,
                            &c->repairs};
    int limit = (int)c->limit;
    hd_archive_of_doubles(archive, "cost", sizeof numbers / sizeof *numbers);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        hd_archive_next_doubles(archive, numbers[k], 1);
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
        hd_archive_long(archive, "cost count", counts[k], 0, LONG_MAX / 2);
    hd_archive_int(archive, "cost limit", &limit, HD_LIMIT_SCHEDULE, HD_LIMIT_NONE);
    c->limit = (hd_limit)limit;
    traffic_archive(run, archive);
}

/** Reads or writes clocks, as the seconds for which they have run. */
static void clocks_archive(hd_run *run, hd_archive *archive)
{
    const double now = hd_clock_now();
    double wall = now - run->clocks.created,
           carried = run->clocks.frame_started != 0 ? now - run->clocks.frame_started : -1.0;
    hd_archive_double(archive, "run wall", &wall);
    hd_archive_double(archive, "run wall carried", &carried);
    if (archive->writing) return;
    run->clocks.created = now - wall;
    run->clocks.frame_started = carried >= 0 ? now - carried : 0.0;
}

/** Reads or writes the plan of the present advance: a viewer can stop a run in the middle of it. */
static void plan_archive(hd_advance_plan *plan, hd_archive *archive)
{
    hd_archive_double(archive, "run advance begin", &plan->begin);
    hd_archive_double(archive, "run advance end", &plan->end);
    hd_archive_bits(archive, "run advance events", &plan->events);
}

/** Expects that the run can follow the target in force, which may differ from that asked for. */
static void target_expect(const hd_run *run, hd_archive *archive)
{
    hd_scene_def asked = run->scene;
    asked.target = run->agenda.in_force.target;
    hd_archive_expect(archive, hd_target_check(&asked, NULL, 0) == HD_OK, "run target",
                      "it cannot be reached");
}

static void numbers_archive(hd_run *run, hd_archive *archive)
{
    int observe = (int)run->observables.looked_at, whole = run->carrier.whole, known = run->known;
    hd_archive_int(archive, "run observe", &observe, 0, (int)run->scene.observe);
    if (!archive->writing)
        hd_observables_look(&run->observables, (unsigned)observe & run->scene.observe);
    hd_agenda_archive(&run->agenda, archive);
    target_expect(run, archive);
    hd_archive_int(archive, "run whole", &whole, 0, 1);
    run->carrier.whole = whole;
    hd_archive_int(archive, "run known", &known, 0, 1);
    run->known = known;
    hd_archive_double(archive, "run followed", &run->followed);
    hd_archive_double(archive, "run advance longest", &run->advance.longest);
    plan_archive(&run->advance.plan, archive);
    hd_archive_double(archive, "run frame start", &run->clocks.frame_start_time);
    hd_archive_double(archive, "run condition max", &run->carrier.rounding.condition_max);
    hd_archive_double(archive, "run rounding", &run->carrier.rounding.sum);
    clocks_archive(run, archive);
    cost_archive(run, archive);
}

static void parts_archive(hd_run *run, hd_archive *archive)
{
    hd_carrier *c = &run->carrier;
    const hd_trajectory *now = run->advance.trajectory;
    hd_trajectory_archive(run->advance.trajectory, archive);
    hd_cages_archive(&run->cages, now, archive);
    hd_interval_archive(&c->interval, archive);
    hd_observables_archive(&run->observables, archive, false, now);
    if (!c->frame || hd_communicator_agree(run->communicator, archive->status) != HD_OK) return;
    hd_record_archive(c->record, archive, &run->scene);
    const hd_status status = hd_frame_archive(c->frame, archive);
    if (status != HD_OK) hd_archive_fail(archive, status, "frame vectors", NULL);
    hd_archive_doubles(archive, "run halves", c->dq_dp, 2 * (size_t)c->vectors);
    hd_spectrum_archive(c->spectrum, archive);
    if (c->diverges) {
        hd_archive_doubles(archive, "run diverged", c->diverged, 2);
        hd_blocks_archive(&c->divergence, archive);
    }
    hd_error_trend_archive(&run->errors, archive);
    hd_observables_archive(&run->observables, archive, true, now);
}

/** The latest time for which anything may be planned; a shorter duration cuts plans. */
static double last_time(const hd_run *run)
{
    return fmax(hd_run_time(run), hd_agenda_stage_end(&run->agenda));
}

/** Time since the last orthonormalisation. */
static double pending(const hd_run *run)
{
    return run->carrier.record ? hd_record_duration(run->carrier.record) : 0.0;
}

static void plan_expect(const hd_run *run, hd_archive *archive)
{
    const hd_advance_plan *plan = &run->advance.plan;
    const double now = hd_run_time(run), planned = fmin(plan->end, last_time(run));
    const double cut = run->agenda.stage == HD_FINISHED ? now : hd_agenda_cut(&run->agenda);
    const double end = fmax(now, pending(run) > 0 ? fmin(cut, run->agenda.interval_end) : cut);
    const uint64_t events = hd_advance_events(&run->advance);
    hd_archive_expect(archive, plan->begin <= now && planned <= end, "run advance end",
                      "it does not fit the time of the checkpoint");
    hd_archive_expect(archive, plan->events <= events, "run advance events",
                      "they are more than the trajectory has had");
}

/** Expects that times fit each other, so that the run can go on. */
static void times_expect(const hd_run *run, hd_archive *archive)
{
    const double now = hd_run_time(run);
    hd_agenda_expect(&run->agenda, archive, now, pending(run), run->advance.bound);
    hd_archive_expect(archive, run->followed <= now, "run followed",
                      "it does not fit the time of the checkpoint");
    hd_archive_expect(archive, pending(run) >= 0 && pending(run) <= now, "log duration",
                      "it does not fit the time of the checkpoint");
    hd_archive_expect(archive, run->advance.longest > 0, "run advance longest",
                      "it is not positive");
}

/** Expects that so many bytes can hold a number of each particle, and the vectors. What else there
 * is knows its own size alone. */
static void length_expect(hd_archive *archive, const hd_scene_def *scene, uint64_t bytes)
{
    const double vectors = hd_frame_archived(hd_dynamics_of(scene), scene->number,
                                             hd_scene_carried(scene));
    hd_archive_expect(archive, sizeof(double) * (scene->number + vectors) <= (double)bytes, "scene",
                      "what follows is too short for its particles and vectors");
}

/* ---- writing ------------------------------------------------------------------------------- */

void hd_run_write(hd_run *run, hd_archive *archive, const char *label)
{
    hd_checkpoint head = {.scene = run->scene, .time = hd_run_time(run)};
    int threads = run->carrier.threads;
    snprintf(head.label, sizeof head.label, "%s", label);
    (void)head_archive(&head, archive, (hd_known){NULL, 0});
    hd_archive_int(archive, "run threads", &threads, 1, INT_MAX);
    const uint64_t before = archive->bytes;
    numbers_archive(run, archive);
    parts_archive(run, archive);
    length_expect(archive, &run->scene, archive->bytes - before);
    times_expect(run, archive);
    plan_expect(run, archive);
}

/** The other ranks send rank 0 what it writes. */
static hd_status tell_writer(hd_run *run)
{
    FILE *nowhere = fopen("/dev/null", "wb");
    hd_status all = hd_communicator_agree(run->communicator, nowhere ? HD_OK : HD_FILE_FAULT);
    hd_archive archive = hd_archive_writer(nowhere);
    if (all == HD_OK) {
        hd_run_write(run, &archive, "");
        all = hd_communicator_agree(run->communicator, archive.status);
    }
    if (nowhere) (void)fclose(nowhere);
    return all;
}

static hd_status write_file(hd_run *run, const char *path, const char *label, char *message,
                            size_t size)
{
    hd_checkpoint_file file;
    const hd_status begun = hd_checkpoint_file_begin(&file, path, message, size);
    hd_status all = hd_communicator_agree(run->communicator, begun);
    if (all != HD_OK && begun == HD_OK) hd_checkpoint_file_drop(&file);
    if (all != HD_OK) return all;
    hd_archive archive = hd_archive_writer(file.file);
    hd_run_write(run, &archive, label);
    all = hd_communicator_agree(run->communicator, archive.status);
    if (all != HD_OK) hd_archive_fail(&archive, all, "run", "another rank cannot write its part");
    return hd_checkpoint_file_end(&file, &archive, message, size);
}

hd_status hd_run_save(hd_run *run, const char *path, const char *label, char *message, size_t size)
{
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_SAVE});
    const hd_status settled = hd_communicator_agree(run->communicator, hd_run_settle(run));
    if (settled != HD_OK) {
        char reason[128];
        snprintf(reason, sizeof reason, "the run has failed: %s", hd_status_text(settled));
        hd_checkpoint_file_line(message, size, path, reason);
        return settled;
    }
    const bool writes = hd_communicator_rank(run->communicator) == 0;
    const hd_status status = writes ? write_file(run, path, label, message, size)
                                    : tell_writer(run);
    return hd_communicator_agree(run->communicator, status);
}

hd_status hd_checkpoint_writable(const char *path, char *message, size_t size)
{
    hd_checkpoint_file file;
    HD_TRY(hd_checkpoint_file_begin(&file, path, message, size));
    hd_checkpoint_file_drop(&file);
    return HD_OK;
}

/* ---- reading ------------------------------------------------------------------------------- */

static hd_status refuse_other(const hd_parameter *row, const hd_scene_def *asked,
                              const hd_scene_def *kept, char *message, size_t size)
{
    char value[VALUE], must[VALUE];
    return hd_refuse(message, size, "%s = %s: must be %s, as in the checkpoint",
                     row->kind == HD_PARAMETER_SET ? "observables (as a set of HD_OBSERVE_*)"
                                                   : row->name,
                     hd_parameter_say(row, asked, value, sizeof value),
                     hd_parameter_say(row, kept, must, sizeof must));
}

/** Refuses a difference in a parameter that cannot change within a run: first in those that only
 * these particles have, as others, such as an automatic warm-up, may follow from them. */
static hd_status check_same(const hd_scene_def *asked, const hd_scene_def *kept, char *message,
                            size_t size)
{
    int common;
    (void)hd_scene_parameters(&common);
    const int all = common + hd_dynamics_of(asked)->parameters;
    for (int k = 0; k < all; k++) {
        const hd_parameter *row = hd_parameter_of(asked, (common + k) % all);
        if (!row->may_differ && !hd_parameter_same(row, asked, kept))
            return refuse_other(row, asked, kept, message, size);
    }
    return HD_OK;
}

static hd_status inconsistent(const hd_archive *archive, char *message, size_t size)
{
    if (archive->status == HD_FILE_FAULT)
        (void)hd_refuse(message, size, "is inconsistent: %s: %s", archive->name, archive->fault);
    else
        (void)hd_refuse(message, size, "%s", hd_status_text(archive->status));
    return archive->status;
}

/** Reads and checks the head: an undamaged file can hold impossible values. */
static hd_status read_head(hd_checkpoint *out, hd_archive *archive, hd_known known, char *message,
                           size_t size)
{
    *out = (hd_checkpoint){.time = 0.0};
    if (!head_archive(out, archive, known)) {
        (void)hd_refuse(message, size, "is of particles = %s, which this program does not know",
                        out->particles);
        return HD_FILE_FAULT;
    }
    if (!hd_archive_good(archive)) return inconsistent(archive, message, size);
    const hd_status status = hd_scene_check(&out->scene, message, size);
    return status == HD_REFUSED ? HD_FILE_FAULT : status; /* of another scene than was asked for */
}

/** The number of threads: as before, unless another one is asked for or the machine has fewer. */
static int threads_of(int asked, int before)
{
    if (asked > 0) return asked;
    return before <= hd_blas_query().cores ? before : 0;
}

/** Lets a finished run go on if its duration has become longer. */
static hd_status reopen(hd_run *run, char *message, size_t size)
{
    hd_agenda *agenda = &run->agenda;
    const double now = hd_run_time(run), averaged = now - agenda->start;
    if (agenda->stage == HD_FINISHED && hd_target_reached(run)) return HD_OK;
    if (agenda->stage < HD_AVERAGING || hd_agenda_reopen(agenda, now)) return HD_OK;
    return hd_refuse(message, size,
                     "duration = %.15g: must be at least %.15g, averaged before the checkpoint",
                     run->scene.duration, averaged);
}

/** Puts another duration and target in force at once, and asks for another report interval. */
static void take_up_scene(hd_run *run, const hd_scene_def *kept)
{
    const hd_parameter *row;
    for (int k = 0; (row = hd_parameter_of(&run->scene, k)); k++)
        if (row->live && !hd_parameter_same(row, &run->scene, kept))
            run->agenda.in_force.changing = true;
    if (run->scene.duration != kept->duration)
        run->agenda.length[HD_AVERAGING] = hd_agenda_averaging(run->scene.duration);
    if (strcmp(run->scene.target.line, kept->target.line) != 0)
        run->agenda.in_force.target = run->scene.target;
    if (run->scene.field_interval != kept->field_interval)
        run->agenda.in_force.field_interval = run->scene.field_interval;
}

static hd_status restore(hd_run *run, hd_archive *archive, const hd_checkpoint *kept, char *message,
                         size_t size)
{
    numbers_archive(run, archive);
    parts_archive(run, archive);
    hd_archive_expect(archive, hd_run_time(run) == kept->time, "time",
                      "it is not that of the trajectory");
    if (hd_archive_end(archive) != HD_OK) return inconsistent(archive, message, size);
    take_up_scene(run, &kept->scene);
    HD_TRY(reopen(run, message, size));
    hd_carrier_save_accuracy(&run->carrier, hd_run_stage(run) == HD_AVERAGING);
    run->agenda.interval_end = fmin(run->agenda.interval_end, last_time(run));
    run->advance.plan.end = fmin(run->advance.plan.end, last_time(run));
    times_expect(run, archive);
    plan_expect(run, archive);
    /* no file may make an advance endless */
    const double bound = run->advance.bound;
    run->advance.longest = fmin(run->advance.longest, bound);
    run->advance.plan.end = fmin(run->advance.plan.end, hd_run_time(run) + bound);
    return hd_archive_good(archive) ? HD_OK : inconsistent(archive, message, size);
}

/** Reads head and scene; the scene asked for may differ from the checkpoint's only where it may. */
static hd_status begin_reading(hd_checkpoint *head, hd_scene_def *asked, int *threads,
                               hd_archive *archive, const hd_scene_def *scene, char *message,
                               size_t size)
{
    const hd_known known = {scene ? &scene->dynamics : NULL, scene && scene->dynamics};
    const char *particles = scene ? hd_dynamics_of(scene)->particles : head->particles;
    const hd_status status = read_head(head, archive, known, message, size);
    if (*head->particles && strcmp(particles, head->particles) != 0)
        return hd_refuse(message, size, "particles = %s: must be %s, as in the checkpoint",
                         particles, head->particles);
    HD_TRY(status);
    *asked = scene ? *scene : head->scene;
    asked->warmup = hd_scene_warmup(asked);
    hd_scene_keep_chosen(asked, &head->scene);
    hd_archive_int(archive, "run threads", threads, 1, INT_MAX);
    HD_TRY(check_same(asked, &head->scene, message, size));
    length_expect(archive, &head->scene, archive->bytes); /* before memory is taken for it */
    return hd_archive_good(archive) ? HD_OK : inconsistent(archive, message, size);
}

hd_status hd_run_read(hd_run **out, hd_archive *archive, const hd_scene_def *scene,
                      hd_communicator *communicator, char *message, size_t size)
{
    hd_checkpoint head;
    hd_scene_def asked;
    int threads = 1;
    *out = NULL;
    HD_TRY(hd_communicator_agree(
        communicator, begin_reading(&head, &asked, &threads, archive, scene, message, size)));
    hd_scene_def def = asked;
    def.threads = threads_of(asked.threads, threads);
    hd_run *run = NULL;
    HD_TRY(hd_run_make(&run, &def, true, communicator, message, size));
    const hd_status status = hd_communicator_agree(communicator,
                                                   restore(run, archive, &head, message, size));
    run->scene.threads = asked.threads;
    if (status == HD_OK)
        *out = run;
    else
        hd_run_drop(run);
    return status;
}

/** Puts the file's name before a line about its contents. */
static hd_status named(hd_status status, const char *path, const char *line, char *message,
                       size_t size)
{
    if (status == HD_FILE_FAULT)
        hd_checkpoint_file_line(message, size, path, line);
    else if (status != HD_OK)
        (void)hd_refuse(message, size, "%s", line);
    return status;
}

hd_status hd_checkpoint_read(hd_checkpoint *out, const char *path, const hd_dynamics *const *own,
                             int count, char *message, size_t size)
{
    FILE *file;
    uint64_t bytes;
    char line[512] = "";
    HD_TRY(hd_checkpoint_file_open(&file, &bytes, path, message, size));
    hd_archive archive = hd_archive_reader(file, bytes);
    const hd_status status = read_head(out, &archive, (hd_known){own, count}, line, sizeof line);
    (void)fclose(file);
    return named(status, path, line, message, size);
}

hd_status hd_run_resume(hd_run **out, const char *path, const hd_scene_def *scene, char *message,
                        size_t size)
{
    return hd_run_resume_shared(out, path, scene, NULL, message, size);
}

hd_status hd_run_resume_shared(hd_run **out, const char *path, const hd_scene_def *scene,
                               hd_communicator *communicator, char *message, size_t size)
{
    FILE *file = NULL;
    uint64_t bytes;
    char line[512] = "";
    *out = NULL;
    hd_order_tell(communicator, (hd_order){.kind = HD_ORDER_RESUME, .scene = scene, .text = path});
    const hd_status opened = hd_checkpoint_file_open(&file, &bytes, path, message, size);
    const hd_status all = hd_communicator_agree(communicator, opened);
    if (all != HD_OK && opened == HD_OK) {
        (void)fclose(file);
        hd_checkpoint_file_line(message, size, path, "another rank cannot read this file");
    }
    if (all != HD_OK) return all;
    hd_archive archive = hd_archive_reader(file, bytes);
    const hd_status status = hd_run_read(out, &archive, scene, communicator, line, sizeof line);
    (void)fclose(file);
    return named(status, path, line, message, size);
}
