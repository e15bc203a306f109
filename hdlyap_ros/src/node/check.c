/** Scene file -> is it valid, its memory, speed, bag and waves. Speed is that of a second's trial
 * on this machine: the same scene, warmed up until intervals are as long as they become, or one of
 * fewer disks in a box of the same shape. Bytes of messages are those of tests/ros/test_bags.py. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "clock.h"
#include "hdlyap/hdlyap.h"
#include "settings.h"
#include "topic.h"

enum { REFUSED = 2, FAULT = 3 };

static const double trial_seconds = 1.0;
/** Collisions of each disk until intervals are as long as they become: they double from 2. */
static const double warmup_collisions = 120.0;
/** The recorder is sent no more reports a second. */
static const double reports_per_second = 960.0;
/** Disks x vectors^2 of a trial: beyond, an interval alone takes longer than a trial may. */
static const double trial_work = 800.0 * 1600.0 * 1600.0;
/** Averaged time of 1 % in c_T, in units of that from which errors are stated: as measured with 780
 * disks, doc/performance.md. */
static const double of_slopes = 2.0;

typedef struct trial {
    int disks;
    double seconds;      /**< per time unit */
    double interval;     /**< between orthonormalisations; NaN without exponents */
    double errors_after; /**< averaged time */
    double steps, phases, t_phases, pairs; /**< in messages; pairs of all LP steps */
} trial;

/* ---- the trial ------------------------------------------------------------------------------ */

static hd_status collision_time(double *time, const hd_scene_def *def)
{
    hd_trajectory *disks;
    const hd_status status = hd_trajectory_create(&disks, def);
    if (status != HD_OK) return status;
    *time = 0.5 * def->disks / hd_trajectory_collision_rate(disks);
    hd_trajectory_free(disks);
    return HD_OK;
}

static hd_status advance_to(hd_run *run, hd_stage stage)
{
    hd_status status = HD_OK;
    while (status == HD_OK && hd_run_stage(run) < stage) status = hd_run_advance(run);
    return status;
}

static hd_status measure(trial *out, hd_run *run)
{
    hd_status status = advance_to(run, HD_AVERAGING);
    const double begin = clock_seconds(), from = hd_run_time(run);
    const long before = hd_run_cost(run).orthonormalisations, vectors = hd_run_vectors(run);
    double seconds = 0.0;
    long done = 0;
    while (status == HD_OK && (seconds < trial_seconds || (vectors > 0 && done < 2))) {
        status = hd_run_advance(run);
        seconds = clock_seconds() - begin;
        done = hd_run_cost(run).orthonormalisations - before;
    }
    out->seconds = seconds / (hd_run_time(run) - from);
    out->interval = hd_run_cost(run).interval;
    return status;
}

static void count_messages(trial *out, const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    if (!steps) return;
    out->steps = hd_steps_count(steps);
    if (hd_run_phases(run)) out->phases = hd_phases_count(hd_run_phases(run));
    if (hd_run_t_phases(run)) out->t_phases = hd_phases_count(hd_run_t_phases(run));
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        if (step->kind == HD_MODE_LP && !step->conjugate) out->pairs += step->expected / 2;
    }
}

/** A scene of the same shape and waves whose trial is short; false if it is itself one, or there is
 * none. */
static bool make_smaller(hd_scene_def *def)
{
    const double vectors = hd_scene_carried(def), work = def->disks * vectors * vectors;
    const double part = cbrt(trial_work / fmax(work, trial_work));
    hd_scene_def smaller = *def;
    char message[200];
    if (part >= 1.0) return false;
    smaller.disks = (int)(part * def->disks);
    if (def->exponents > 0) smaller.exponents = (int)(part * vectors); /* a number of them */
    smaller.max_wave_number /= sqrt(part);
    if (hd_scene_check(&smaller, message, sizeof message) != HD_OK) return false;
    *def = smaller;
    return true;
}

/** What a trial of fewer disks says of all of them: a frame takes N^3, an error the time of sound
 * through the box. */
static void enlarge(trial *t, const hd_scene_def *tried, const hd_scene_def *def)
{
    t->disks = tried->disks;
    if (tried->disks == def->disks) return;
    t->seconds *= pow((double)def->disks / tried->disks, 3.0);
    t->errors_after *= hd_scene_sound_crossing(def) / hd_scene_sound_crossing(tried);
}

static hd_status try_scene(trial *out, const settings *set, char *message, size_t size)
{
    hd_scene_def def = set->def;
    hd_run *run;
    double collision = 0.0;
    hd_status status = collision_time(&collision, &def);
    if (status != HD_OK) return status;
    def.equilibration = collision;
    def.warmup = warmup_collisions * collision;
    def.duration = def.target_std_error = 0.0;
    def.observe &= ~(unsigned)HD_OBSERVE_COVARIANT; /* a window is longer than a trial */
    make_smaller(&def);
    status = hd_run_create(&run, &def, message, size);
    if (status != HD_OK) return status;
    hd_run_fields_every(run, set->field_interval);
    status = measure(out, run);
    out->errors_after = hd_run_errors_after(run);
    enlarge(out, &def, &set->def);
    count_messages(out, run);
    hd_run_free(run);
    return status;
}

/* ---- what is printed ------------------------------------------------------------------------ */

/** Bytes of the messages of a report, but for fields. */
static double report_bytes(const settings *set, const trial *t)
{
    const double n = hd_scene_vectors(&set->def), waves = hd_structure_waves_of(&set->def);
    const double of[TOPICS] = {[TOPIC_SPECTRUM] = 162.0 + 40.0 * n,
                               [TOPIC_MODES] = 98.0 + 89.0 * n,
                               [TOPIC_STEPS] = 204.0 + 96.0 * t->steps,
                               [TOPIC_LP_PHASES] = 90.0 + 74.0 * t->phases,
                               [TOPIC_T_PHASES] = 90.0 + 82.0 * t->t_phases,
                               [TOPIC_STRUCTURE] = 122.0 + 16.0 * waves + 68.0 * n,
                               [TOPIC_LOCALIZATION] = 98.0 + 24.0 * n,
                               [TOPIC_GAS] = 162.0,
                               [TOPIC_STATE] = 106.0 + 32.0 * set->def.disks};
    double bytes = 220.0 + 110.0; /* cost, status */
    for (topic k = 0; k < TOPICS; k++)
        if (set->observables & topic_bit(k)) bytes += of[k];
    return bytes;
}

/** Of all steps, if all are found, and of the means in structure. */
static double field_bytes(const settings *set, const trial *t)
{
    const double waves = hd_structure_waves_of(&set->def), n = hd_scene_vectors(&set->def);
    double bytes = 0.0;
    if (set->observables & topic_bit(TOPIC_FIELDS))
        bytes += set->def.disks * (64.0 * t->steps + 48.0 * t->pairs);
    if (set->observables & topic_bit(TOPIC_STRUCTURE)) bytes += 16.0 * waves * n;
    return bytes;
}

static void print_seconds(const char *name, double seconds)
{
    if (seconds < 60.0)
        printf("%s%.3g s", name, seconds);
    else if (seconds < 3600.0)
        printf("%s%.3g min", name, seconds / 60.0);
    else
        printf("%s%.3g h", name, seconds / 3600.0);
}

static void print_memory(const settings *set, hd_room room)
{
    const int threads = set->def.threads > 0 ? set->def.threads : hd_blas_query().cores;
    const double needed = hd_room_needed(&set->def, threads, 1);
    printf("memory    %.3g GB beside 0.1 GB of libraries; there are %.3g GB (%s)\n", 1e-9 * needed,
           1e-9 * room.bytes, room.limit);
    if (set->def.observe & HD_OBSERVE_COVARIANT)
        printf("          windows of covariant vectors: up to %.3g GB more (covariant_memory)\n",
               set->def.covariant_memory);
}

static void print_speed(const settings *set, const trial *t)
{
    const hd_scene_def *def = &set->def;
    const double before = def->equilibration + hd_scene_warmup(def);
    printf("speed     %.3g s per time unit, by a trial of a second", t->seconds);
    if (t->disks < def->disks) printf(" of %d disks, and the cube of N", t->disks);
    if (!isnan(t->interval)) printf("; interval %.3g", t->interval);
    if (def->observe & HD_OBSERVE_COVARIANT) printf("; without covariant vectors");
    printf("\n");
    print_seconds("          ", before * t->seconds);
    printf(" before the averaging (%.4g time units)", before);
    if (def->duration > 0) {
        print_seconds(", ", def->duration * t->seconds);
        printf(" of averaging (%.4g)", def->duration);
    }
    printf("\n");
}

/** What comes every field_interval. */
static const char *of_interval(const settings *set)
{
    const bool fields = set->observables & topic_bit(TOPIC_FIELDS);
    if (!(set->observables & topic_bit(TOPIC_STRUCTURE))) return "fields";
    return fields ? "fields and structure factors" : "structure factors";
}

static void print_bag(const settings *set, const trial *t)
{
    const double r = set->def.report_interval, fields = fmax(set->field_interval, r);
    const double speed = set->pace > 0 ? fmin(set->pace, 1.0 / t->seconds) : 1.0 / t->seconds;
    const double per_unit = report_bytes(set, t) / r + field_bytes(set, t) / fields;
    const double paced = fmin(speed, reports_per_second * r);
    printf("bag       %.4g kB a report", 1e-3 * report_bytes(set, t));
    if (field_bytes(set, t) > 0)
        printf(", at most %.3g MB of %s every %.3g time units", 1e-6 * field_bytes(set, t),
               of_interval(set), fields);
    if (set->def.duration > 0) printf(", %.3g MB in all", 1e-6 * set->def.duration * per_unit);
    printf(";\n          at most %.3g GB an hour if publishing and recording took no time, "
           "uncompressed\n",
           3.6e-6 * paced * per_unit);
}

static void print_waves(const settings *set)
{
    const hd_scene_def *def = &set->def;
    enum { SHOWN = 200 };
    hd_wave wave[SHOWN];
    const int count = hd_waves(def, wave, SHOWN), shown = count < SHOWN ? count : SHOWN;
    printf("waves    ");
    for (int k = 0; k < shown; k++) {
        const char *kinds = hd_wave_transverse(&wave[k], def->boundary).count == 0 ? " LP"
                                                                                   : " T,LP";
        printf("%s(%d,%d)", hd_wave_pairs(&wave[k], def->boundary).count == 0 ? " T" : kinds,
               wave[k].n[0], wave[k].n[1]);
    }
    if (count > shown) printf(" and %d more", count - shown);
    printf("\n");
}

/** What no averaging takes away. */
static void print_open(const char *begin, const hd_scene_def *def, hd_mode_kind kind)
{
    const double open = hd_relation_open(def, kind);
    if (open < INFINITY)
        printf("%s some %.2g %%, which this box and its waves leave open.\n", begin, 100.0 * open);
}

static void print_errors(const settings *set, const trial *t)
{
    const double before = set->def.equilibration + hd_scene_warmup(&set->def);
    const double steps = t->errors_after, slopes = of_slopes * steps;
    printf("errors    of exponents of steps below 1 %% when they are first stated, after %.3g time "
           "units of averaging (",
           steps);
    print_seconds("", (before + steps) * t->seconds);
    printf(" from the start);\n          of c_T and c_L about 1 %% of sampling after %.3g (",
           slopes);
    print_seconds("", (before + slopes) * t->seconds);
    printf("). An estimate, from runs of 780 disks.\n");
    print_open("          Beside it, of c_T", &set->def, HD_MODE_T);
    print_open("          Beside it, of c_L", &set->def, HD_MODE_LP);
    if (set->def.duration > 0 && set->def.duration < steps)
        printf("          The duration is too short for any error.\n");
}

static void print_all(const settings *set, const trial *t, hd_room room)
{
    const hd_scene_def *def = &set->def;
    double box[2];
    hd_scene_box(def, box);
    printf("scene     %s is valid: %d disks in %.6g x %.6g, %d vectors\n", set->scene, def->disks,
           box[0], box[1], hd_scene_vectors(def));
    print_memory(set, room);
    print_speed(set, t);
    print_bag(set, t);
    if (!hd_scene_vectors(def)) return;
    if (set->observables & TOPICS_OF_MODES) print_waves(set);
    print_errors(set, t);
}

static int refused(int status, const char *message)
{
    fprintf(stderr, "%s\n", message);
    return status;
}

int check_scene(int count, char *const *arguments)
{
    char message[512] = "";
    hdr_params *params;
    settings set;
    trial t = {.seconds = 0.0};
    if (count < 1) return refused(REFUSED, "--check: must be followed by a scene file");
    if (hdr_params_read(&params, arguments[0], count - 1, arguments + 1) != HDR_OK)
        return refused(REFUSED, hdr_error_text());
    int status = EXIT_SUCCESS;
    if (!settings_read(&set, params, NULL, message, sizeof message)) {
        status = refused(REFUSED, message);
    } else {
        const hd_room room = hd_room_available();
        hd_status tried = hd_scene_check(&set.def, message, sizeof message);
        if (tried == HD_OK) tried = hd_room_check(&set.def, room, message, sizeof message);
        if (tried == HD_OK) tried = try_scene(&t, &set, message, sizeof message);
        if (tried == HD_OK)
            print_all(&set, &t, room);
        else
            status = refused(tried == HD_REFUSED ? REFUSED : FAULT,
                             *message ? message : hd_status_text(tried));
    }
    hdr_params_free(params);
    return fflush(stdout) == 0 ? status : FAULT;
}
