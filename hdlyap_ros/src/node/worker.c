/** One thread that steps the run. It has two locks: `lock` protects requests and state, and is
 * never held during work; `publishing` is held around messages, so that none follows the last one.
 * Whatever drops `lock` may miss a request: after it the thread looks at all requests again before
 * it sleeps. */
#include "worker.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "changes.h"
#include "clock.h"
#include "hdlyap/blas.h"
#include "table.h"

/** Time between two looks for subscribers [s]. */
static const double look_seconds = 0.01;
/** Wall times after this never come, and may not fit a time_t. */
static const double end_of_time = 1e15;
/** Largest part of the time that is spent on examining particles. */
static const double examination_share = 0.01;

/** A change that a service asks for, and the worker's answer. */
typedef struct set_request {
    bool waits, taken, made; /**< waits: the change is asked for; taken: the worker is making it,
                                and its caller waits for the answer; made: it has been made */
    const char *assignment;  /**< the caller's text; NULL: the averaging is to end */
    char *message;
    size_t size;
} set_request;

struct worker {
    hd_run *run;
    report *rep;
    settings *set;
    changes *changes;
    pthread_t thread;
    bool begun;
    /** Wall time before which `pace` allows no further step; only the thread uses it. */
    double due;
    double examinable; /**< wall time before which the particles are not examined again; only the
                          thread uses it */
    checkpoint_writer keep; /**< the thread's own */
    table table;            /**< the thread's own */

    pthread_mutex_t asking; /**< held while a change is asked for: there is one at a time */
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool stop, pause, reset, save, examine; /**< asked for */
    set_request set_asked;
    worker_state state;

    pthread_mutex_t publishing;
    bool closed; /**< true once the last message has been published */
};

/** Waits for a change of state, at most until a wall time, if that is finite; false once it has
 * come. The lock is held. */
static bool wait_until(worker *w, double wall)
{
    if (!(wall < end_of_time)) return pthread_cond_wait(&w->changed, &w->lock) == 0;
    const double whole = floor(wall);
    const struct timespec until = {.tv_sec = (time_t)whole,
                                   .tv_nsec = (long)(1e9 * (wall - whole))};
    return pthread_cond_timedwait(&w->changed, &w->lock, &until) != ETIMEDOUT;
}

/** Lock held. */
static void enter(worker *w, worker_stage stage)
{
    w->state.stage = stage;
    pthread_cond_broadcast(&w->changed);
}

/** Whether all awaited topics have subscribers. The lock is held, but not while the master is
 * asked. */
static bool awaited_here(worker *w)
{
    pthread_mutex_unlock(&w->lock);
    const bool here = report_awaited_here(w->rep);
    pthread_mutex_lock(&w->lock);
    return here;
}

/** Publishes run_info after changes. The lock is held, but not while it publishes. */
static void publish_changes(worker *w)
{
    pthread_mutex_unlock(&w->lock);
    pthread_mutex_lock(&w->publishing);
    if (!w->closed && report_run_info(w->rep, w->run, w->changes) != HD_OK)
        hdr_log(HDR_WARN, "run_info with the change is not published: %s",
                hd_status_text(HD_NOT_FINITE));
    pthread_mutex_unlock(&w->publishing);
    pthread_mutex_lock(&w->lock);
}

/** Makes the change that is asked for. The lock is held, but not during the change, which may take
 * long: all ranks have to know. */
static void answer_set(worker *w)
{
    set_request *r = &w->set_asked;
    r->taken = true;
    pthread_mutex_unlock(&w->lock);
    const bool made = r->assignment ? changes_ask(w->changes, w->set, w->run, r->assignment,
                                                  r->message, r->size)
                                    : changes_end(w->changes, w->set, w->run, r->message, r->size);
    if (made) hdr_log(HDR_INFO, "set: %s", r->message);
    pthread_mutex_lock(&w->lock);
    r->made = made;
    if (made && !r->assignment) w->pause = false;
    r->waits = r->taken = false;
    w->due = 0.0; /* pace may have changed */
    pthread_cond_broadcast(&w->changed);
    if (made) publish_changes(w);
}

/** Waits for the awaited subscribers; false if asked to stop. */
static bool wait_for_subscribers(worker *w)
{
    pthread_mutex_lock(&w->lock);
    while (!w->stop && !awaited_here(w)) {
        if (w->set_asked.waits)
            answer_set(w);
        else if (!w->stop)
            wait_until(w, clock_seconds() + look_seconds);
    }
    const bool go_on = !w->stop;
    enter(w, go_on ? WORKER_RUNNING : WORKER_ENDED);
    pthread_mutex_unlock(&w->lock);
    return go_on;
}

/** True if pace does not allow the next step yet. */
static bool too_early(const worker *w) { return w->due > 0.0 && clock_seconds() < w->due; }

/** Writes the checkpoint. The lock is held, but not while it writes. */
static void save(worker *w)
{
    w->state.saving = true;
    pthread_mutex_unlock(&w->lock);
    checkpoint_writer_save(&w->keep, w->run);
    pthread_mutex_lock(&w->lock);
    w->save = w->state.saving = false;
    w->state.checkpoint = w->keep.state;
    pthread_cond_broadcast(&w->changed);
}

/** Publishes the present state, and pauses then. The lock is held, but not while it publishes. A
 * failure here is no fault of the run. */
static void rest(worker *w)
{
    pthread_mutex_unlock(&w->lock);
    pthread_mutex_lock(&w->publishing);
    const hd_status status = w->closed ? HD_OK : report_slow(w->rep, w->run, true);
    if (status != HD_OK)
        hdr_log(HDR_WARN, "slow_vectors of this pause are not published: %s",
                hd_status_text(status));
    pthread_mutex_unlock(&w->publishing);
    pthread_mutex_lock(&w->lock);
    enter(w, WORKER_PAUSED);
}

/** Does the first thing that is asked for, or else sleeps if the next step has to wait. Returns
 * false if nothing was there to do. The lock is held, but not while something is done. */
static bool obey_one(worker *w)
{
    const bool waits = w->pause || too_early(w);
    if (w->save || (waits && checkpoint_writer_due(&w->keep))) {
        save(w);
    } else if (w->set_asked.waits) {
        answer_set(w);
    } else if (w->pause && w->state.stage != WORKER_PAUSED) {
        rest(w);
    } else if (waits) {
        enter(w, w->pause ? WORKER_PAUSED : WORKER_RUNNING);
        wait_until(w, fmin(w->pause ? INFINITY : w->due, w->keep.changed ? w->keep.due : INFINITY));
    } else {
        return false;
    }
    return true;
}

/** Called between two steps: writes the checkpoint if it is due, pauses, and keeps pace. False if
 * asked to stop. */
static bool obey(worker *w)
{
    pthread_mutex_lock(&w->lock);
    if (checkpoint_writer_due(&w->keep)) save(w);
    while (!w->stop && obey_one(w)) continue;
    w->state.stage = WORKER_RUNNING;
    const bool go_on = !w->stop;
    pthread_mutex_unlock(&w->lock);
    return go_on;
}

/** Takes back a request; true if there was one. */
static bool asked(worker *w, bool *request)
{
    pthread_mutex_lock(&w->lock);
    const bool was = *request;
    *request = false;
    pthread_mutex_unlock(&w->lock);
    return was;
}

static hd_status reset_if_asked(worker *w)
{
    return asked(w, &w->reset) ? hd_run_reset_average(w->run) : HD_OK;
}

static void change_if_due(worker *w)
{
    if (!changes_take(w->changes, w->set, w->run)) return;
    w->due = 0.0;
    pthread_mutex_lock(&w->lock);
    publish_changes(w);
    pthread_mutex_unlock(&w->lock);
}

static void examine_if_asked(worker *w)
{
    const double begin = clock_seconds();
    if (!asked(w, &w->examine) || begin < w->examinable) return;
    const examination seen = examination_of(w->run);
    const double end = clock_seconds();
    w->examinable = end + (end - begin) / examination_share;
    pthread_mutex_lock(&w->lock);
    w->state.seen = seen;
    pthread_mutex_unlock(&w->lock);
}

static hd_status publish(worker *w)
{
    hd_status status = HD_OK;
    pthread_mutex_lock(&w->publishing);
    if (!w->closed && hd_run_report_due(w->run)) status = report_publish(w->rep, w->run);
    if (!w->closed && status == HD_OK) status = report_window(w->rep, w->run);
    if (!w->closed && status == HD_OK) status = report_slow(w->rep, w->run, false);
    pthread_mutex_unlock(&w->publishing);
    return status;
}

/** Makes a step, and sets when the next one is due. Pace does not limit what comes before
 * averaging. */
static hd_status paced_step(worker *w)
{
    const double begin = clock_seconds(), from = hd_run_time(w->run);
    const bool paced = hd_run_stage(w->run) == HD_AVERAGING;
    const hd_status status = hd_run_advance(w->run);
    if (paced) w->due = fmax(w->due, begin) + (hd_run_time(w->run) - from) / w->set->pace;
    return status;
}

static hd_status step(worker *w)
{
    examine_if_asked(w);
    hd_run_observe(w->run, report_demand(w->rep));
    report_demand_slow(w->rep, w->run);
    hd_status status = reset_if_asked(w);
    change_if_due(w);
    checkpoint_writer_touch(&w->keep);
    if (status == HD_OK) status = w->set->pace > 0.0 ? paced_step(w) : hd_run_advance(w->run);
    if (status == HD_OK) status = report_vectors(w->rep, w->run);
    if (status != HD_OK) return status;
    status = publish(w);
    if (status == HD_OK && hd_run_report_due(w->run)) table_tell(&w->table, w->set, w->run);
    const progress now = progress_of(w->run, w->set->pace);
    pthread_mutex_lock(&w->lock);
    w->state.last = now;
    pthread_mutex_unlock(&w->lock);
    return status;
}

/** Writes the checkpoint at the end, and publishes what this has completed: the way back through a
 * window of covariant vectors. */
static hd_status finish(worker *w)
{
    hd_status status = HD_OK;
    pthread_mutex_lock(&w->lock);
    save(w);
    pthread_mutex_unlock(&w->lock);
    pthread_mutex_lock(&w->publishing);
    if (!w->closed) status = report_window(w->rep, w->run);
    pthread_mutex_unlock(&w->publishing);
    return status;
}

/** Says what ended the run. The lock is held. */
static void explain(worker *w, hd_status status)
{
    const hd_scene_def *scene = hd_run_scene(w->run);
    const hd_dynamics *of = hd_dynamics_of(scene);
    char *fault = w->state.fault;
    const size_t size = sizeof w->state.fault;
    snprintf(fault, size, "%s", hd_status_text(status));
    if (status == HD_ENERGY_LOST && of->step)
        snprintf(fault, size, "%s, %.4g", hd_status_text(status), of->step(scene));
    if (status == HD_DYNAMICS_FAULT)
        snprintf(fault, size, "%s: %s", hd_status_text(status), hd_run_fault(w->run));
}

/** What is known of the particles at the end, of a fault, too. The lock is held. */
static void look_last(worker *w, hd_status status)
{
    w->state.last.energy = hd_trajectory_energy(hd_run_parts(w->run).trajectory);
    if (w->state.seen.made && status == HD_OK) w->state.seen = examination_of(w->run);
}

static void *work(void *context)
{
    worker *w = context;
    hd_status status = HD_OK;
    if (!wait_for_subscribers(w)) return NULL;
    while (status == HD_OK && hd_run_stage(w->run) != HD_FINISHED && obey(w)) status = step(w);
    if (status == HD_OK) status = finish(w);
    pthread_mutex_lock(&w->lock);
    if (status != HD_OK) explain(w, status);
    look_last(w, status);
    if (status == HD_OK) w->save = false; /* finish has written this state */
    w->state.status = status;
    enter(w, WORKER_ENDED);
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

static void locks_create(worker *w)
{
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_cond_init(&w->changed, &monotonic);
    pthread_condattr_destroy(&monotonic);
    pthread_mutex_init(&w->asking, NULL);
    pthread_mutex_init(&w->lock, NULL);
    pthread_mutex_init(&w->publishing, NULL);
}

static void locks_free(worker *w)
{
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->asking);
    pthread_mutex_destroy(&w->lock);
    pthread_mutex_destroy(&w->publishing);
}

bool worker_create(worker **out, hd_run *run, report *rep, settings *set, changes *all,
                   const checkpoint_writer *keep)
{
    worker *w = *out = calloc(1, sizeof *w);
    if (!w) return false;
    w->run = run;
    w->rep = rep;
    w->set = set;
    w->changes = all;
    w->state.last = progress_of(run, 0.0);
    w->state.warning = set->warning;
    w->state.particles = set->particles;
    w->keep = *keep;
    w->state.checkpoint = w->keep.state;
    locks_create(w);
    return true;
}

bool worker_begin(worker *w)
{
    w->begun = pthread_create(&w->thread, NULL, work, w) == 0;
    return w->begun;
}

void worker_end(worker *w)
{
    if (!w) return;
    worker_stop(w); /* wakes services that wait */
    if (w->begun) pthread_join(w->thread, NULL);
}

void worker_free(worker *w)
{
    if (!w) return;
    locks_free(w);
    free(w);
}

worker_state worker_state_now(worker *w)
{
    pthread_mutex_lock(&w->lock);
    const worker_state state = w->state;
    pthread_mutex_unlock(&w->lock);
    return state;
}

/** Sets a request and wakes the thread. */
static void ask(worker *w, bool *request, bool value)
{
    pthread_mutex_lock(&w->lock);
    *request = value;
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
}

void worker_pause(worker *w, bool pause) { ask(w, &w->pause, pause); }

void worker_reset_average(worker *w) { ask(w, &w->reset, true); }

void worker_examine(worker *w) { ask(w, &w->examine, true); }

/** Lock held. */
static bool saved(worker *w, double until, char *message, size_t size)
{
    const kept *k = &w->state.checkpoint;
    while (w->save && !w->stop && w->state.stage != WORKER_ENDED && wait_until(w, until)) continue;
    const bool fault = w->state.stage == WORKER_ENDED && w->state.status != HD_OK;
    const bool done = !w->save && !k->failed && !fault;
    if (done)
        snprintf(message, size, "%s: simulated time %.6g", w->set->checkpoint, k->time);
    else if (fault)
        snprintf(message, size, "the run has ended: %s", hd_status_text(w->state.status));
    else if (w->save)
        snprintf(message, size, "it will be written after the step that is under way");
    else
        snprintf(message, size, "%s", k->message);
    return done;
}

bool worker_checkpoint(worker *w, double seconds, char *message, size_t size)
{
    const double until = clock_seconds() + seconds;
    if (!*w->set->checkpoint) {
        snprintf(message, size, "the parameter checkpoint names no file");
        return false;
    }
    pthread_mutex_lock(&w->lock);
    if (w->state.stage == WORKER_RUNNING || w->state.stage == WORKER_PAUSED) {
        w->save = true;
        pthread_cond_broadcast(&w->changed);
    }
    const bool done = saved(w, until, message, size);
    pthread_mutex_unlock(&w->lock);
    return done;
}

/** Waits for the answer; false if the change has not been made by then, or will not be. The lock is
 * held. */
static bool wait_for_answer(worker *w, double until)
{
    if (w->set_asked.taken) return wait_until(w, INFINITY);
    if (w->stop || w->state.stage == WORKER_ENDED) return false;
    return wait_until(w, until) || w->set_asked.taken;
}

bool worker_set(worker *w, double seconds, const char *assignment, char *message, size_t size)
{
    pthread_mutex_lock(&w->asking);
    const double until = clock_seconds() + seconds;
    pthread_mutex_lock(&w->lock);
    w->set_asked = (set_request){
        .waits = true, .assignment = assignment, .message = message, .size = size};
    pthread_cond_broadcast(&w->changed);
    while (w->set_asked.waits && wait_for_answer(w, until)) continue;
    if (w->set_asked.waits)
        snprintf(message, size, "%s",
                 w->stop || w->state.stage == WORKER_ENDED
                     ? "the run has ended"
                     : "the step under way takes too long: try again later");
    w->set_asked.waits = false;
    const bool made = w->set_asked.made;
    pthread_mutex_unlock(&w->lock);
    pthread_mutex_unlock(&w->asking);
    return made;
}

void worker_stop(worker *w) { ask(w, &w->stop, true); }

bool worker_wait(worker *w, double seconds)
{
    const double until = clock_seconds() + seconds;
    pthread_mutex_lock(&w->lock);
    while (w->state.stage != WORKER_ENDED && wait_until(w, until)) continue;
    const bool ended = w->state.stage == WORKER_ENDED;
    pthread_mutex_unlock(&w->lock);
    return ended;
}

hd_status worker_finish(worker *w)
{
    const progress last = worker_state_now(w).last;
    pthread_mutex_lock(&w->publishing);
    w->closed = true;
    const hd_status status = report_finish(w->rep, &last);
    pthread_mutex_unlock(&w->publishing);
    return status;
}
