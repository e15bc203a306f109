/** hdlyap_node: reads the parameters, starts the worker, and watches it until the end. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "conditions.h"
#include "diagnostics.h"
#include "given.h"
#include "hdlyap/follow.h"
#include "hdlyap/hdlyap.h"
#include "hdlyap_ros/main.h"
#include "parameters_text.h"
#include "particles.h"
#include "ranks.h"
#include "restart.h"
#include "topics/report.h"
#include "services.h"
#include "settings.h"
#include "table.h"
#include "worker.h"

enum { EXIT_REFUSED = 2, EXIT_NUMERICAL_FAULT = 3, EXIT_FILE_FAULT = 4, EXIT_LOST = 5 };

/** Seconds from a request to stop to the end of the process, whatever happens. */
static const double stop_seconds = 0.8;
/** Part of stop_seconds that the present step may take. */
static const double stop_step_seconds = 0.25;
/** The same two times if a checkpoint has to be written first; roslaunch waits longer than that
 * before it kills. */
static const double stop_keeping_seconds = 12.0, stop_step_keeping_seconds = 10.0;
/** Seconds that a finished node waits for the last messages to reach slow subscribers. */
static const double linger_seconds = 5.0;
static const double poll_seconds = 0.02;
/** A node that waits for subscribers ends after this many seconds without the master. */
static const double lost_seconds = 15.0;
/** The log announces the creation of a frame with more entries than this. */
static const double ENTRIES_MANY = 2e7;

/** Everything that the node owns, in the order of creation. */
typedef struct app {
    hd_communicator *ranks; /**< NULL: a single one */
    hdr_node *ros;
    hdr_params *params;
    hd_checkpoint kept; /**< the checkpoint that the run is resumed from */
    settings set;
    changes changes; /**< changes that wait and changes that have been made */
    hd_run *run;
    checkpoint_writer keep; /**< writes the first checkpoint; the worker uses it afterwards */
    report *rep;
    worker *work;
    services asked;
    diagnostics diag;
    bool lost; /**< true if it has ended because nobody can subscribe any more */
} app;

static int refuse(const char *message)
{
    hdr_log(HDR_FATAL, "%s", message);
    return EXIT_REFUSED;
}

static int refuse_argument(const char *argument)
{
    hdr_log(HDR_FATAL, "argument %s: must be _parameter:=value", argument);
    return EXIT_REFUSED;
}

static int fault_status(hd_status status)
{
    if (status == HD_OK) return EXIT_SUCCESS;
    if (status == HD_REFUSED) return EXIT_REFUSED;
    return status == HD_FILE_FAULT ? EXIT_FILE_FAULT : EXIT_NUMERICAL_FAULT;
}

/** Exit status for a failed call of the wrapper. */
static int failed_status(hdr_status status)
{
    if (status == HDR_OK) return EXIT_SUCCESS;
    if (status != HDR_NO_MEMORY) return refuse(hdr_error_text());
    const char *what = hdr_error_text(); /* empty if the wrapper did not fail */
    hdr_log(HDR_FATAL, "%s%s%s", hd_status_text(HD_NO_MEMORY), *what ? ": " : "", what);
    return fault_status(HD_NO_MEMORY);
}

/** Logs a fault; returns the exit status. */
static int fault_logged(hd_status status, const char *message)
{
    if (status != HD_OK) hdr_log(HDR_FATAL, "%s", *message ? message : hd_status_text(status));
    return fault_status(status);
}

static int read_settings(app *a)
{
    char message[512] = "";
    const char *resume = "";
    const hdr_status created = hdr_params_create(&a->params, a->ros);
    if (created != HDR_OK) return failed_status(created);
    if (!settings_resume(&resume, a->params, message, sizeof message)) return refuse(message);
    if (*resume) {
        int count;
        const hd_dynamics *const *brought = particles_brought(&count);
        const hd_status status = hd_checkpoint_read(&a->kept, resume, brought, count, message,
                                                    sizeof message);
        if (status != HD_OK) return fault_logged(status, message);
    }
    if (!settings_read(&a->set, a->params, *resume ? &a->kept : NULL, message, sizeof message))
        return refuse(message);
    return changes_create(&a->changes, &a->set, *resume ? a->kept.time : -1.0)
               ? EXIT_SUCCESS
               : failed_status(HDR_NO_MEMORY);
}

/** Logs that a large frame is being created: with some thousand particles it takes seconds, beside
 * other jobs a minute. Says nothing of a scene that will be refused. */
static void log_creation(const settings *set)
{
    const hd_scene_def *def = &set->def;
    if (hd_memory_check(def, hd_memory_available(), NULL, 0) != HD_OK) return;
    const int vectors = hd_scene_counts(def).carried;
    if (2.0 * hd_scene_coordinates(def) * def->number * vectors > ENTRIES_MANY)
        hdr_log(HDR_INFO, "creates %d tangent vectors of %d %s, which may take a minute", vectors,
                def->number, set->particles);
}

/** Creates the run, unless its checkpoints could not be written. */
static int create_run(app *a)
{
    char message[512] = "";
    const settings *set = &a->set;
    hd_status status = checkpoint_writer_check(set, message, sizeof message);
    if (status == HD_OK) log_creation(set);
    if (status == HD_OK && *set->resume)
        status = hd_run_resume_shared(&a->run, set->resume, &set->def, a->ranks, message,
                                      sizeof message);
    else if (status == HD_OK)
        status = hd_run_create_shared(&a->run, &set->def, a->ranks, message, sizeof message);
    if (*set->checkpoint || a->ranks) hdr_node_stop_within(stop_keeping_seconds, EXIT_SUCCESS);
    if (status == HD_OK)
        status = checkpoint_writer_begin(&a->keep, set, a->run, message, sizeof message);
    return fault_logged(status, message);
}

/** Makes the node visible to others. The run begins only once everything is registered, so that a
 * node of the same name that takes over ends this one before it has begun. */
static hdr_status advertise(app *a)
{
    const char *kernel = hd_blas_query().kernel;
    hdr_status status = report_create(&a->rep, a->ros, &a->set, a->run);
    if (status == HDR_OK)
        status = diagnostics_advertise(&a->diag, a->ros, a->rep,
                                       progress_of(a->run, a->set.pace).collisions, kernel);
    if (status == HDR_OK && report_run_info(a->rep, a->run, &a->changes) != HD_OK)
        status = HDR_NOT_FINITE;
    if (status == HDR_OK &&
        !worker_create(&a->work, a->run, a->rep, &a->set, &a->changes, &a->keep))
        status = HDR_NO_MEMORY;
    if (status == HDR_OK) status = services_advertise(&a->asked, a->ros, a->work);
    return status == HDR_OK && !worker_begin(a->work) ? HDR_NO_MEMORY : status;
}

/** Warns of threads that the user limits by environment variables. */
static void warn_of_threads(const hd_run *run)
{
    const int denied = hd_run_threads_denied(run), granted = hd_run_threads(run);
    if (denied > 0)
        hdr_log(HDR_WARN,
                "OpenMP grants %d of %d threads (OMP_THREAD_LIMIT, OMP_MAX_ACTIVE_LEVELS)", granted,
                granted + denied);
}

/** Says before the run that it will have no standard errors. */
static void tell_too_short(const hd_scene_def *def)
{
    double after;
    if (hd_estimate_errors(&after, def) == HD_OK && def->duration > 0.0 && def->duration < after)
        hdr_log(HDR_INFO,
                "there will be no standard errors: they are first stated after %.6g time units of "
                "averaging, and the duration is %.6g",
                after, def->duration);
}

static void log_start(const app *a)
{
    const hd_blas blas = hd_blas_query();
    char system[SYSTEM_SIZE];
    const int threads = hd_run_threads(a->run);
    hdr_log(HDR_INFO, "scene %s: %s, %d vectors, %d thread%s; %s, kernel %s, %d thread%s",
            a->set.scene, settings_write_system(system, &a->set), hd_run_vectors(a->run), threads,
            threads > 1 ? "s" : "", blas.library, blas.kernel, blas.threads,
            blas.threads > 1 ? "s" : "");
    given_log(&a->set, *a->set.resume);
    warn_of_threads(a->run);
    if (*a->set.warning) hdr_log(HDR_WARN, "%s", a->set.warning);
    tell_too_short(&a->set.def);
    if (*a->set.resume)
        hdr_log(HDR_INFO, "goes on from simulated time %.6g of the checkpoint %s",
                hd_run_time(a->run), a->set.resume);
    else if (strcmp(hdr_param_text(a->params, "resume"), RESUME_AUTO) == 0)
        hdr_log(HDR_INFO, "there was no checkpoint %s: the run begins at its start",
                a->set.checkpoint);
}

static void log_end(const worker_state *state)
{
    const progress *last = &state->last;
    char collisions[48] = "";
    if (last->collides)
        snprintf(collisions, sizeof collisions, "%" PRIu64 " collisions, ", last->collisions);
    if (state->status != HD_OK)
        hdr_log(HDR_FATAL, "ended by a fault at simulated time %.6g: %s", last->time, state->fault);
    else
        hdr_log(HDR_INFO,
                "%s at simulated time %.6g after %.1f s: %s%ld orthonormalisations, %ld repair%s",
                last->stage == HD_FINISHED ? "finished" : "stopped", last->time, last->cost.wall,
                collisions, last->cost.orthonormalisations, last->cost.repairs,
                last->cost.repairs == 1 ? "" : "s");
    char step[CONDITION_STEP];
    if (energy_write(step, &last->energy)) hdr_log(HDR_WARN, "%s", step);
    if (!last->split.are) return;
    split_write(step, &last->split);
    hdr_log(HDR_WARN, "%s", step);
}

/** Ends the node if it waits for subscribers that cannot come any more. */
static void end_if_lost(app *a, const worker_state *state)
{
    a->lost = state->stage == WORKER_WAITING && state->lost >= lost_seconds;
    if (!a->lost) return;
    hdr_log(HDR_FATAL,
            "ends: the subscribers that it waits for cannot come without the ROS master");
    hdr_node_stop_within(stop_seconds, EXIT_LOST); /* roscpp may wait for a master that hangs */
    hdr_stop_request();
}

/** Says once that the energy is off by more than the scene asks. */
static void warn_of_energy(bool *warned, const hd_energy *energy)
{
    char text[CONDITION_STEP];
    if (*warned || !energy_write(text, energy)) return;
    *warned = true;
    hdr_log(HDR_WARN, "%s", text);
}

/** Serves until the worker has ended or a stop is requested; true if the worker has ended. */
static bool look_after(app *a)
{
    bool ended = false, warned = false;
    while (!ended && !hdr_stop_requested()) {
        ended = worker_wait(a->work, poll_seconds);
        worker_state state = worker_state_now(a->work);
        state.lost = hdr_node_lost(a->ros);
        end_if_lost(a, &state);
        warn_of_energy(&warned, &state.last.energy);
        if (diagnostics_update(&a->diag, &state)) worker_examine(a->work); /* for the next one */
    }
    worker_stop(a->work);
    return ended || worker_wait(a->work, *a->set.checkpoint || a->ranks ? stop_step_keeping_seconds
                                                                        : stop_step_seconds);
}

/** Says last from where the run can go on. */
static void log_checkpoint(const settings *set, const worker_state *state, bool ended)
{
    const double time = state->checkpoint.time;
    if (time < 0) return;
    if (time != state->last.time)
        hdr_log(HDR_WARN, "the checkpoint is not of the end, but of simulated time %.6g", time);
    if (ended)
        hdr_log(HDR_INFO, "the checkpoint is %s; resume:=FILE goes on from it", set->checkpoint);
}

/** Finishes the run; after a fault there is no last message, as log and diagnostics say it. */
static int finish(app *a, bool ended)
{
    worker_state state = worker_state_now(a->work);
    const hd_status finished = state.status == HD_OK ? worker_finish(a->work) : state.status;
    state = worker_state_now(a->work); /* a checkpoint may have been finished meanwhile */
    state.status = finished;
    diagnostics_publish(&a->diag, &state);
    log_end(&state);
    if (ended) table_result(&a->set, a->run);
    if (state.saving) hdr_log(HDR_ERROR, "checkpoint not written: the disk does not answer");
    log_checkpoint(&a->set, &state, ended);
    const bool unkept = state.saving || state.checkpoint.failed;
    return state.status == HD_OK && unkept ? EXIT_FILE_FAULT : fault_status(state.status);
}

/** Frees everything; the worker publishes through the node, whose services call the worker. */
static void app_free(app *a)
{
    worker_end(a->work);
    hdr_node_free(a->ros, linger_seconds);
    worker_free(a->work);
    report_free(a->rep);
    hd_run_free(a->run);
    hdr_params_free(a->params);
    changes_clear(&a->changes);
}

static int run(app *a)
{
    int status = read_settings(a);
    if (status == EXIT_SUCCESS) status = create_run(a);
    if (status != EXIT_SUCCESS) return status;
    log_start(a);
    status = failed_status(advertise(a));
    if (status != EXIT_SUCCESS) return hdr_node_lost(a->ros) > 0.0 ? EXIT_LOST : status;
    const bool ended = look_after(a);
    status = finish(a, ended);
    if (a->lost) status = EXIT_LOST;
    if (ended) return status;
    hdr_node_free(a->ros, linger_seconds); /* a step that goes on still uses everything else */
    _exit(status);                         /* mpirun ends the other ranks in that step */
}

/** Answers options, as --help, that need no master: returns an exit status, or -1 if there are
 * none. */
static int answer(int argc, char **argv)
{
    static const struct {
        const char *argument;
        int (*print)(void);
    } answers[] = {{"--help", parameters_print_help},
                   {"-h", parameters_print_help},
                   {"--version", parameters_print_version},
                   {"--parameters", parameters_print_scene},
                   {"--parameters=table", parameters_print_table}};
    for (size_t k = 0; k < sizeof answers / sizeof *answers; k++)
        if (argc == 2 && strcmp(argv[1], answers[k].argument) == 0) return answers[k].print();
    return -1;
}

/** Answers options that a scene file follows, likewise. */
static int answer_of_scene(int argc, char **argv)
{
    static const struct {
        const char *argument;
        int (*answer)(int count, char *const *arguments);
    } answers[] = {
        {"--check", check_scene}, {"--errors", check_errors}, {"--test-dynamics", check_dynamics}};
    for (size_t k = 0; k < sizeof answers / sizeof *answers; k++)
        if (argc > 1 && strcmp(argv[1], answers[k].argument) == 0)
            return answers[k].answer(argc - 2, argv + 2);
    return -1;
}

static int follow(const app *a)
{
    ranks_follow(a->ranks);
    return EXIT_SUCCESS;
}

/** Runs the node, on the rank that has ROS; returns its exit status. */
static int lead(app *a, int argc, char **argv)
{
    if (a->ranks) hd_run_lead(a->ranks);
    const hdr_status created = hdr_node_create(&a->ros, &argc, argv, "hdlyap", stop_seconds,
                                               fault_status(HD_NO_MEMORY));
    if (created != HDR_OK) return failed_status(created);
    if (!a->ros) return EXIT_SUCCESS;
    const int status = argc > 1 ? refuse_argument(argv[1]) : run(a);
    app_free(a);
    return status;
}

int hdlyap_node_main(int argc, char **argv, const hd_dynamics *const *rows, int count)
{
    app a = {.ros = NULL};
    char message[512];
    if (!particles_check(rows, count, message, sizeof message)) return refuse(message);
    particles_register(rows, count);
    const int answered = answer(argc, argv);
    if (answered >= 0) return answered;
    restart_if_slow(argv);
    const int checked = answer_of_scene(argc, argv);
    if (checked >= 0) return checked;
    if (!ranks_join(&a.ranks, &argc, &argv, message, sizeof message))
        return *message ? refuse(message) : EXIT_SUCCESS;
    const int status = a.ranks && a.ranks->rank > 0 ? follow(&a) : lead(&a, argc, argv);
    ranks_leave(a.ranks);
    return status;
}
