/** Scene file -> whether it is valid, its memory, speed, bag and waves. The core estimates memory
 * and speed; the rows of the topics give the size of a bag. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hdlyap/hdlyap.h"
#include "parameters.h"
#include "settings.h"
#include "topics/moment.h"
#include "topics/topic.h"

enum { REFUSED = 2, FAULT = 3 };

/** Most reports per second that the recorder gets. */
static const double reports_per_second = 960.0;
/** True if the scene is as dense as those in which disks, spheres, dumbbells or mixtures were seen
 * to keep their places [T8]. */
static bool may_be_caged(const hd_scene_def *def)
{
    if (!hd_dynamics_of(def)->fluid) return false; /* it has not been studied for these particles */
    hd_kind kind[HD_KINDS_MAX];
    const int dimension = hd_scene_dimension(def);
    if (hd_scene_inertia(def) > 0) return hd_scene_packing(def) >= 0.78;
    if (hd_scene_kinds(def, kind) > 1)
        return hd_scene_packing(def) >= (dimension == 2 ? 0.78 : 0.56);
    /* all may be of the second kind */
    return def->density * pow(kind->diameter, dimension) >= (dimension == 2 ? 0.88 : 0.9);
}

/* ---- what is printed ------------------------------------------------------------------------ */

/** Bytes that a message takes in a bag besides its own: its record and its entry in the index. */
static const double record_bytes = 58.0;

/** When messages are published: with reports, with fields, or with windows of covariant vectors. */
typedef enum coming { REPORTS, FIELDS, WINDOWS, COMINGS } coming;

/** Bytes that a topic takes in a bag each time it is published. */
static double bytes_of(const settings *set, const hd_estimate *t, topic k, coming when)
{
    const topic_size s = topic_size_of(k, &t->extent);
    const double parts[COMINGS] = {s.report, s.fields, s.window}, messages = fmax(s.messages, 1.0);
    const double texts = (double)(strlen("box") + strlen("20260101T000000.000000Z-00000-") +
                                  strlen(set->seed));
    const bool is_part = when != REPORTS && s.report > 0.0; /* each report has a message */
    if (!(parts[when] > 0.0)) return 0.0;
    return parts[when] + (is_part ? 0.0 : messages * (texts + record_bytes));
}

static double bytes_of_all(const settings *set, const hd_estimate *t, unsigned topics, coming when)
{
    double bytes = 0.0;
    for (topic k = 0; k < TOPICS; k++)
        if (topics & topic_bit(k)) bytes += bytes_of(set, t, k, when);
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

static void print_memory(const settings *set, hd_memory_limit room)
{
    const int threads = set->def.threads > 0 ? set->def.threads : hd_blas_query().cores;
    const double needed = hd_memory_needed(&set->def, threads, 1);
    printf("memory    %.3g GB beside 0.1 GB of libraries; there are %.3g GB (%s)\n", 1e-9 * needed,
           1e-9 * room.bytes, room.limit);
    if (set->observables & topics_that_are(TOPIC_OF_WINDOWS))
        printf("          windows of covariant vectors: up to %.3g GB more (covariant_memory)\n",
               set->def.covariant_memory);
}

static void print_speed(const settings *set, const hd_estimate *t)
{
    const hd_scene_def *def = &set->def;
    char left_out[PARAMETER_TEXT];
    printf("speed     %.3g s per time unit, by a trial of a second", t->seconds);
    if (t->particles < def->number)
        printf(" with %d %s, scaled by N^3", t->particles, set->particles);
    if (t->extrapolated > 0)
        printf(", extrapolated from its %.3g time units of warm-up", t->extrapolated);
    if (!isnan(t->interval)) printf("; interval %.3g", t->interval);
    topic_names(left_out, sizeof left_out, set->observables & topics_of_stages(t->untried));
    if (*left_out) printf("; not in this trial: %s", left_out);
    printf("\n");
    print_seconds("          ", t->before * t->seconds);
    printf(" before the averaging (%.4g time units)", t->before);
    if (def->duration > 0) {
        print_seconds(", ", def->duration * t->seconds);
        printf(" of averaging (%.4g)", def->duration);
        const double time = t->before + def->duration;
        const double recorded = time / (reports_per_second * def->report_interval);
        if (recorded > time * t->seconds)
            print_seconds("; if recorded, in all at least ", recorded);
    }
    printf("\n");
}

static unsigned topics_recorded(const settings *set)
{
    return set->observables | topics_that_are(TOPIC_ALWAYS);
}

/** Simulated time between two messages. */
static double time_between(const settings *set, coming when)
{
    const double report = set->def.report_interval;
    if (when == FIELDS) return fmax(set->def.field_interval, report);
    return when == WINDOWS ? set->def.covariant_window : report;
}

/** Prints how much each topic takes of a bag, in units of `unit` bytes. */
static void print_shares(const settings *set, const hd_estimate *t, coming when, double unit)
{
    const char *separator = ":";
    for (topic k = 0; k < TOPICS; k++) {
        const double bytes = topics_recorded(set) & topic_bit(k) ? bytes_of(set, t, k, when) : 0.0;
        if (bytes > 0.0) printf("%s %s %.3g", separator, topic_name(k), bytes / unit);
        if (bytes > 0.0) separator = ",";
    }
    printf("\n");
}

/** Bytes in the bag of a whole run; before the averaging only topics that need no averages are
 * published. */
static double bytes_in_all(const settings *set, const hd_estimate *t)
{
    const unsigned of_averages = topics_that_are(TOPIC_OF_VECTORS) |
                                 topics_of_stages(HD_OBSERVE_ANY);
    double bytes = t->before / time_between(set, REPORTS) *
                   bytes_of_all(set, t, topics_recorded(set) & ~of_averages, REPORTS);
    for (coming when = REPORTS; when < COMINGS; when++)
        bytes += set->def.duration / time_between(set, when) *
                 bytes_of_all(set, t, topics_recorded(set), when);
    return bytes;
}

static void print_bag(const settings *set, const hd_estimate *t)
{
    const double speed = set->pace > 0 ? fmin(set->pace, 1.0 / t->seconds) : 1.0 / t->seconds;
    const double paced = fmin(speed, reports_per_second * set->def.report_interval);
    double per_unit = 0.0;
    for (coming when = REPORTS; when < COMINGS; when++) {
        const double bytes = bytes_of_all(set, t, topics_recorded(set), when);
        const double between = time_between(set, when);
        per_unit += bytes / between;
        if (when == REPORTS)
            printf("bag       %.4g kB a report", 1e-3 * bytes);
        else if (bytes > 0.0)
            printf("          at most %.3g MB every %.3g time units", 1e-6 * bytes, between);
        if (bytes > 0.0) print_shares(set, t, when, when == REPORTS ? 1e3 : 1e6);
    }
    printf("          ");
    if (set->def.duration > 0) printf("%.3g MB in all; ", 1e-6 * bytes_in_all(set, t));
    printf("at most %.3g GB an hour if publishing and recording took no time, uncompressed\n",
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
        const char *kinds = wave[k].transverse.count == 0 ? " LP" : " T,LP";
        char nodes[NODES_SIZE];
        printf("%s%s", wave[k].pairs.count == 0 ? " T" : kinds,
               settings_write_nodes(nodes, def, &wave[k]));
    }
    if (count > shown) printf(" and %d more", count - shown);
    printf("\n");
}

/** Prints the part of an error that averaging does not reduce. */
static void print_open(const char *name, const hd_scene_def *def, hd_mode_kind kind)
{
    const double open = hd_relation_open(def, kind);
    if (open < INFINITY)
        printf("          %s has another error of about %.2g %%, due to the waves, edges and walls "
               "of this box: longer runs do not reduce it.\n",
               name, 100.0 * open);
}

static void print_slopes(const settings *set, const hd_estimate *t)
{
    const bool has_c_l = hd_relation_open(&set->def, HD_MODE_LP) < INFINITY;
    printf("          of %s about 1 %% from finite averaging after %.3g (",
           has_c_l ? "c_T and c_L" : "c_T", t->slopes_after);
    print_seconds("", (t->before + t->slopes_after) * t->seconds);
    printf("). An estimate, from runs of 780 disks.\n");
    print_open("c_T", &set->def, HD_MODE_T);
    print_open("c_L", &set->def, HD_MODE_LP);
}

static void print_errors(const settings *set, const hd_estimate *t)
{
    const bool known = hd_dynamics_of(&set->def)->fluid; /* there is a theory for their steps */
    const bool steps = known &&
                       hd_scene_counts(&set->def).vectors >= hd_steps_exponents_least(&set->def);
    printf("errors    %s after %.3g time units of averaging (",
           steps ? "of exponents of steps below 1 % when they are first stated," : "first stated",
           t->errors_after);
    print_seconds("", (t->before + t->errors_after) * t->seconds);
    printf(steps ? " from the start);\n" : " from the start)\n");
    if (steps) print_slopes(set, t);
    if (set->def.duration > 0 && set->def.duration < t->errors_after)
        printf("          The duration is too short for any error.\n");
    if (may_be_caged(&set->def))
        printf("          %s may keep their places at this density, as in a crystal: then errors "
               "hold for one arrangement\n          of them, and other seeds may differ by more "
               "(~status: "
               "caged).\n",
               set->particles);
}

/** Prints when the target is reached, in simulated time of averaging and in wall time. */
static void print_target(const settings *set, const hd_estimate *t)
{
    const hd_scene_def *def = &set->def;
    const bool known = t->target_after < INFINITY; /* false for NaN */
    const double after = known ? t->target_after : t->errors_after;
    if (!*def->target.line) return;
    printf("target    %s\n          ", def->target.line);
    if (isinf(t->target_after)) {
        printf("never reached: the error that longer runs do not reduce is larger, see above\n");
        return;
    }
    printf(known ? "reached after some %.3g time units of averaging ("
                 : "not before %.3g time units of averaging, when errors are first stated (",
           after);
    print_seconds("", (t->before + after) * t->seconds);
    printf(" from the start)%s\n", known ? ", as the errors of the trial say" : "");
    if (def->duration > 0 && def->duration < after) printf("          The duration ends before.\n");
}

static void print_all(const settings *set, const hd_estimate *t, hd_memory_limit room)
{
    const hd_scene_def *def = &set->def;
    char system[SYSTEM_SIZE];
    printf("scene     %s is valid: %s, %d vectors\n", set->scene,
           settings_write_system(system, set), hd_scene_counts(def).vectors);
    print_memory(set, room);
    print_speed(set, t);
    print_bag(set, t);
    if (!hd_scene_counts(def).vectors || hd_scene_dimension(def) == 0) return; /* no steps */
    if (*set->warning)
        printf("warning   %s\n", set->warning);
    else if (def->observe & HD_OBSERVE_WAVES)
        print_waves(set);
    print_errors(set, t);
    print_target(set, t);
}

static int refused(int status, const char *message)
{
    fprintf(stderr, "%s\n", message);
    return status;
}

/** The name that run.launch gives to a scene without a name. */
static const char *name_of(const char *path, char *name, size_t size)
{
    const char *slash = strrchr(path, '/');
    snprintf(name, size, "%s", slash ? slash + 1 : path);
    char *suffix = strstr(name, ".yaml");
    if (suffix) *suffix = '\0';
    return name;
}

/** Prints results for valid settings; returns the exit status. */
typedef int printer(settings *set, const char *path, const hdr_params *params);

static int of_file(int count, char *const *arguments, printer *print)
{
    char message[512] = "";
    hdr_params *params;
    settings set;
    if (count < 1) {
        snprintf(message, sizeof message, "%s: must be followed by a scene file",
                 arguments[-1]); /* the option */
        return refused(REFUSED, message);
    }
    if (hdr_params_read(&params, arguments[0], count - 1, arguments + 1) != HDR_OK)
        return refused(REFUSED, hdr_error_text());
    const bool right = settings_read(&set, params, NULL, message, sizeof message);
    const int status = right ? print(&set, arguments[0], params) : refused(REFUSED, message);
    hdr_params_free(params);
    return fflush(stdout) == 0 ? status : FAULT;
}

static int fault(hd_status status, const char *message)
{
    return refused(status == HD_REFUSED ? REFUSED : FAULT,
                   *message ? message : hd_status_text(status));
}

static int try_scene(settings *set, const char *path, const hdr_params *params)
{
    char message[512] = "", name[256];
    hd_estimate t = {.particles = 0};
    const hd_memory_limit room = hd_memory_available();
    if (!*hdr_param_text(params, "scene")) set->scene = name_of(path, name, sizeof name);
    hd_status tried = hd_memory_check(&set->def, room, message, sizeof message);
    if (tried == HD_OK) tried = hd_estimate_run(&t, &set->def, message, sizeof message);
    if (tried != HD_OK) return fault(tried, message);
    t.extent = extent_of(set, t.extent);
    print_all(set, &t, room);
    return EXIT_SUCCESS;
}

static int tell_errors(settings *set, const char *path, const hdr_params *params)
{
    double after;
    (void)path, (void)params;
    const hd_status status = hd_estimate_errors(&after, &set->def);
    if (status != HD_OK) return fault(status, "");
    printf("%.6g\n", after);
    if (*set->warning) fprintf(stderr, "%s\n", set->warning);
    return EXIT_SUCCESS;
}

static int test_dynamics(settings *set, const char *path, const hdr_params *params)
{
    char message[512] = "";
    (void)path, (void)params;
    const hd_status status = hd_dynamics_test(hd_dynamics_of(&set->def), &set->def, message,
                                              sizeof message);
    if (status != HD_OK) return fault(status, message);
    puts("ok");
    return EXIT_SUCCESS;
}

int check_scene(int count, char *const *arguments) { return of_file(count, arguments, try_scene); }

int check_errors(int count, char *const *arguments)
{
    return of_file(count, arguments, tell_errors);
}

int check_dynamics(int count, char *const *arguments)
{
    return of_file(count, arguments, test_dynamics);
}
