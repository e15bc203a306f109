/** Preloaded into the node: after each message, a line in the file WITNESS with its type and what
 * the core's public headers say of the run at that moment, as JSON. What no row of published.txt
 * reads is not here. Only the thread that publishes comes here. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hdlyap/fluctuations.h"
#include "hdlyap/hdlyap.h"
#include "hdlyap_ros/publisher.h"
#include "hdlyap_ros/messages.h"

static struct {
    const hd_run *run;
    hd_cost cost;             /**< what the core said first after its last step */
    bool has_cost, has_begun; /**< has_begun: it has made a step */
    double resumed,
        stepped; /**< simulated time at the resume, -1: none; wall time of a step's end */
    double outside, sending; /**< wall seconds so far between steps; of them, in publishing all but
                                run_info, which no report contains */
    double sent, since;      /**< `sending`, and the time of the day, at the end of the last step */
    int nth;                 /**< messages of the type fields since that step */
    double changed[8];       /**< times from which changes hold */
    int changes;
} here = {.resumed = -1.0};

static void next(void *function, const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found) abort();
    memcpy(function, &found, sizeof found);
}

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- JSON ----------------------------------------------------------------------------------- */

static FILE *out;
static bool is_first; /**< of an object or a list */

static void name_it(const char *name)
{
    if (!is_first) putc(',', out);
    if (name) fprintf(out, "\"%s\":", name);
    is_first = false;
}

static void open_it(const char *name, char bracket)
{
    name_it(name);
    putc(bracket, out);
    is_first = true;
}

static void close_it(char bracket)
{
    putc(bracket, out);
    is_first = false;
}

static void number(const char *name, double x)
{
    name_it(name);
    if (isfinite(x))
        fprintf(out, "%.17g", x);
    else
        fputs(isnan(x) ? "NaN" : x > 0 ? "Infinity" : "-Infinity", out);
}

static void text(const char *name, const char *line)
{
    name_it(name);
    putc('"', out);
    for (; *line; line++) fprintf(out, *line == '"' || *line == '\\' ? "\\%c" : "%c", *line);
    putc('"', out);
}

/** Every stride-th of x. */
static void numbers(const char *name, const double *x, size_t count, size_t stride)
{
    open_it(name, '[');
    for (size_t k = 0; k < count; k++) number(NULL, x[k * stride]);
    close_it(']');
}

/** A list of what `value` is for k = 0 .. count - 1. */
#define LIST(name, count, value)                                                                   \
    do {                                                                                           \
        open_it(name, '[');                                                                        \
        for (int k = 0; k < (count); k++) number(NULL, (double)(value));                           \
        close_it(']');                                                                             \
    } while (0)
/** A list of what `write` writes. */
#define EACH(name, count, write)                                                                   \
    do {                                                                                           \
        open_it(name, '[');                                                                        \
        for (int k = 0; k < (count); k++) write;                                                   \
        close_it(']');                                                                             \
    } while (0)

/* ---- structs -------------------------------------------------------------------------------- */

typedef struct member {
    const char *name;
    size_t offset, size;
    char kind;
} member;

#define KIND(x)                                                                                    \
    _Generic((x), double : 'd', double * : 'd', int : 'i', int * : 'i', long : 'l', long * : 'l',  \
             unsigned : 'u', bool : 'b', unsigned char : 'c', char * : 's')
#define NAMED(name, type, m)                                                                       \
    {                                                                                              \
#name, offsetof(type, m), sizeof((type *)0)->m, KIND(((type *)0)->m)                       \
    }
#define M(type, m) NAMED(m, type, m)

static double value_of(const void *at, char kind, size_t k)
{
    return kind == 'd'   ? ((const double *)at)[k]
           : kind == 'l' ? (double)((const long *)at)[k]
           : kind == 'b' ? (double)((const bool *)at)[k]
           : kind == 'c' ? (double)((const unsigned char *)at)[k]
                         : (double)((const int *)at)[k];
}

static void member_of(const char *of, const member *m)
{
    const size_t each = m->kind == 'd' || m->kind == 'l'   ? 8
                        : m->kind == 'i' || m->kind == 'u' ? 4
                                                           : 1;
    if (m->kind == 's')
        text(m->name, of + m->offset);
    else if (m->size == each)
        number(m->name, value_of(of + m->offset, m->kind, 0));
    else
        LIST(m->name, (int)(m->size / each), value_of(of + m->offset, m->kind, (size_t)k));
}

static void structure(const char *name, const void *of, const member *list, size_t count)
{
    open_it(name, '{');
    for (size_t k = 0; k < count; k++) member_of(of, &list[k]);
    close_it('}');
}
#define STRUCT(name, of, list) structure(name, of, list, sizeof list / sizeof *list)

#define G(m) M(hd_gas_means, m)
static const member of_gas[] = {
    G(time),        G(collision_rate),    G(collision_rate_error), G(pressure_error),
    G(pressure_of), G(pressure_of_error), G(compressibility),      G(compressibility_error),
    G(temperature), G(temperature_error), G(potential_energy),     G(potential_energy_error)};
#define C(m) M(hd_cost, m)
static const member of_cost[] = {C(wall),
                                 C(events),
                                 C(replay),
                                 C(ortho),
                                 C(spectrum),
                                 C(modes),
                                 C(following),
                                 C(communication),
                                 C(bytes),
                                 C(calls),
                                 C(events_per_second),
                                 C(interval),
                                 C(limit),
                                 C(condition),
                                 C(defect),
                                 C(error_bound),
                                 C(orthonormalisations),
                                 C(second_passes),
                                 C(slow_vector_samples),
                                 C(repairs),
                                 C(progress),
                                 C(remaining),
                                 NAMED(target, hd_cost, target.name),
                                 NAMED(target_error, hd_cost, target.error),
                                 NAMED(target_wanted, hd_cost, target.wanted)};
#define S(m) M(hd_step, m)
static const member of_step[] = {S(kind),
                                 NAMED(n, hd_step, wave.n),
                                 NAMED(k, hd_step, wave.number),
                                 S(subspace),
                                 S(expected),
                                 S(conjugate),
                                 S(resolved),
                                 S(col),
                                 S(count),
                                 S(set),
                                 S(multiplicity),
                                 S(exponent),
                                 S(std_error),
                                 S(sharing),
                                 S(set_time),
                                 S(own_part),
                                 S(gap),
                                 S(gap_error)};
#define D(m) M(hd_dispersion, m)
static const member of_fit[] = {D(points),
                                D(k_min),
                                D(k_max),
                                D(prior_share),
                                D(c_sampling_error),
                                D(misfit),
                                NAMED(c, hd_dispersion, c.value),
                                NAMED(c_error, hd_dispersion, c.error),
                                NAMED(c2, hd_dispersion, c2.value),
                                NAMED(c2_error, hd_dispersion, c2.error),
                                NAMED(c3, hd_dispersion, c3.value),
                                NAMED(c3_error, hd_dispersion, c3.error)};
#define R(m) M(hd_relation, m)
static const member of_relation[] = {R(c2), R(c2_error), R(c3), R(c3_error), R(box_error)};
#define V(m) M(hd_velocity, m)
static const member of_velocity[] = {V(phases),           V(k_min), V(k_max), V(v), V(v_error),
                                     V(v_sampling_error), V(misfit)};
#define P(m) M(hd_phase, m)
static const member of_phase[] = {P(step), P(modulation), P(col),   P(state),       P(a),
                                  P(b),    P(phase),      P(omega), P(omega_error), P(time)};
#define H(m) M(hd_hydro_response, m)
static const member of_response[] = {H(step),  H(col),    H(modulation), H(density),
                                     H(along), H(across), H(energy),     H(across_second)};
#define A(m) M(hd_angle_of_spaces, m)
static const member of_angle[] = {A(last),
                                  A(mean),
                                  A(std_error),
                                  A(least),
                                  A(mean_of_all),
                                  A(smallest),
                                  NAMED(every, hd_angle_of_spaces, all)};
#define U(m) M(hd_sums_of, m)
static const member of_sums[] = {M(hd_spectrum_sums, local_time),
                                 M(hd_spectrum_sums, ks_entropy_error)};
static const member of_covariant[] = {M(hd_covariant_results, windows),
                                      M(hd_covariant_results, lost),
                                      M(hd_covariant_results, window_end),
                                      M(hd_covariant_results, null),
                                      M(hd_covariant_results, null_most),
                                      NAMED(samples, hd_covariant_results, splitting.samples),
                                      NAMED(has_spaces, hd_covariant_results, splitting.has_spaces),
                                      NAMED(centre, hd_covariant_results, start_mismatch.centre),
                                      NAMED(stable, hd_covariant_results, start_mismatch.stable)};
static const member of_wave[] = {M(hd_wave, n), NAMED(k, hd_wave, number)};
static const member of_fields[] = {M(hd_subspace, kind), NAMED(n, hd_subspace, wave.n),
                                   NAMED(k, hd_subspace, wave.number), M(hd_subspace, dimension),
                                   M(hd_subspace, column)};

/* ---- what the core says --------------------------------------------------------------------- */

static hd_parts parts(void) { return hd_run_parts(here.run); }
static const hd_scene_def *scene(void) { return hd_run_scene(here.run); }
static int vectors(void) { return hd_run_vectors(here.run); }

static void say_spectrum(const char *name, const hd_spectrum *of)
{
    const hd_spectrum_sums sums = hd_spectrum_sum_up(of);
    open_it(name, '{');
    number("time", hd_spectrum_time(of));
    LIST("exponent", vectors(), hd_spectrum_exponent(of, k));
    LIST("error", vectors(), hd_spectrum_std_error(of, k));
    LIST("local", vectors(), hd_spectrum_local(of, k));
    STRUCT("sums", &sums, of_sums);
    close_it('}');
}

static void say_run(void)
{
    const hd_counts counts = hd_scene_counts(scene());
    number("time", hd_run_time(here.run));
    number("stage", hd_run_stage(here.run));
    number("fields_due", hd_run_fields_due(here.run));
    number("vectors", vectors());
    number("positive", counts.positive);
    number("zero", counts.zero);
    number("d", hd_scene_dimension(scene()));
    number("coordinates", hd_scene_coordinates(scene()));
    number("inertia", hd_scene_inertia(scene()));
    number("N", scene()->number);
    if (parts().spectrum) say_spectrum("spectrum", parts().spectrum);
}

static void say_state(const void *message)
{
    const size_t count = (size_t)(scene()->number * hd_scene_coordinates(scene()));
    double *q = calloc(2 * count, sizeof *q);
    (void)message;
    hd_trajectory_state(parts().trajectory, q, q + count);
    numbers("q", q, count, 1);
    numbers("p", q + count, count, 1);
    free(q);
}

static void say_cost(const void *message)
{
    (void)message;
    STRUCT("cost", &here.cost, of_cost);
    number("is_caged", hd_run_is_caged(here.run));
    number("sent", here.sent);
    number("outside", here.outside + seconds(CLOCK_MONOTONIC) - here.stepped);
}

static void say_told(const void *message)
{
    double *halves = calloc(2 * (size_t)vectors(), sizeof *halves);
    (void)message;
    hd_run_halves(here.run, halves, halves + vectors());
    numbers("cosine", halves, (size_t)vectors(), 1);
    numbers("ratio", halves + vectors(), (size_t)vectors(), 1);
    number("collisions", (double)hd_trajectory_told(parts().trajectory).collisions);
    free(halves);
}

static void say_gas(const void *message)
{
    const hd_gas_means means = hd_gas_read(parts().gas);
    (void)message;
    STRUCT("gas", &means, of_gas);
}

/** A column of the step of the smallest exponent of a kind. */
static int lowest_of(hd_mode_kind kind)
{
    const int step = hd_steps_lowest(parts().steps, kind);
    return step < 0 ? -1 : hd_steps_example(parts().steps, step);
}

static void say_steps(void)
{
    const hd_steps *steps = parts().steps;
    const int count = hd_steps_count(steps);
    EACH("steps", count, STRUCT(NULL, hd_steps_step(steps, k), of_step));
    LIST("step_of", vectors(), hd_steps_of_vector(steps, k));
    LIST("example", count, hd_steps_is_shown(steps, k) ? hd_steps_example(steps, k) : -1);
    LIST("lowest", 2, lowest_of(k ? HD_MODE_LP : HD_MODE_T));
}

/** Weights in the fields of each subspace and in the null space, [subspace or part][vectors]. */
static void say_weights(const hd_modes *modes)
{
    const hd_fields *fields = hd_modes_fields(modes);
    const size_t n = (size_t)vectors();
    const int count = hd_fields_subspaces(fields), nulls = hd_scene_dimension(scene()) + 1;
    EACH("fields", count, STRUCT(NULL, hd_fields_subspace(fields, k), of_fields));
    EACH("weight", count, numbers(NULL, hd_modes_average(modes, k, HD_WEIGHT), n, 1));
    EACH("weight_l", count, numbers(NULL, hd_modes_average(modes, k, HD_WEIGHT_L), n, 1));
    EACH("weight_p", count, numbers(NULL, hd_modes_average(modes, k, HD_WEIGHT_P), n, 1));
    EACH("weight_now", count, numbers(NULL, hd_modes_snapshot(modes, k, HD_WEIGHT), n, 1));
    EACH("null", nulls, numbers(NULL, hd_modes_null_average(modes, k), n, 1));
    EACH("null_now", nulls, numbers(NULL, hd_modes_null_snapshot(modes, k), n, 1));
}

static void say_modes(const void *message)
{
    const hd_modes *modes = parts().modes;
    const double *turning = hd_modes_turning_average(modes);
    (void)message;
    say_steps();
    say_weights(modes);
    number("samples", (double)hd_modes_samples(modes));
    LIST("turning", vectors(), turning ? turning[k] : 0.0);
}

static void say_fit(const char *name, const char *of_long, hd_mode_kind kind)
{
    const hd_dispersion fit = hd_steps_dispersion(parts().steps, parts().spectrum, kind);
    STRUCT(name, &fit, of_fit);
    STRUCT(of_long, fit.in_long_boxes, of_relation);
}

static double rate_of(int step, bool error)
{
    double rate[2];
    const bool known = parts().phases && hd_phases_rate(parts().phases, step, &rate[0], &rate[1]);
    return known ? rate[error] : error ? -1.0 : NAN;
}

static void say_spectrum_of_steps(const void *message)
{
    const hd_steps *steps = parts().steps;
    const int count = hd_steps_count(steps);
    say_modes(message);
    say_fit("t", "t_long", HD_MODE_T);
    say_fit("l", "l_long", HD_MODE_LP);
    LIST("rate", count, rate_of(k, false));
    LIST("rate_error", count, rate_of(k, true));
    LIST("scatter", count, hd_steps_scatter(steps, hd_steps_step(steps, k)));
    const hd_velocity none = {.misfit = -1.0},
                      velocity = parts().phases ? hd_phases_velocity(parts().phases) : none;
    STRUCT("velocity", &velocity, of_velocity);
}

static double diffusion_of(const hd_phases *phases, int index, bool error)
{
    double known[2];
    known[0] = hd_phases_diffusion(phases, index, &known[1]);
    return known[error];
}

static void say_phases(const hd_phases *phases)
{
    const int count = hd_phases_count(phases);
    say_steps();
    number("followed", hd_run_followed(here.run));
    EACH("phases", count, STRUCT(NULL, hd_phases_phase(phases, k), of_phase));
    LIST("diffusion", count, diffusion_of(phases, k, false));
    LIST("diffusion_error", count, diffusion_of(phases, k, true));
}

static void say_lp_phases(const void *message)
{
    (void)message;
    say_phases(parts().phases);
}

static void say_t_phases(const void *message)
{
    (void)message;
    say_phases(parts().t_phases);
}

static void say_hydro(const void *message)
{
    const hd_hydro *hydro = parts().hydro;
    (void)message;
    say_steps();
    EACH("responses", hd_hydro_count(hydro), STRUCT(NULL, hd_hydro_at(hydro, k), of_response));
}

static void say_localization(const void *message)
{
    hd_localization *shape = parts().localization;
    (void)message;
    number("samples", (double)hd_localization_samples(shape));
    numbers("widths", hd_localization_widths(shape), (size_t)vectors(), 1);
    LIST("error", vectors(), hd_localization_width_error(shape, k));
    LIST("now_", vectors(), hd_localization_width_now(shape, k));
}

static void say_structure(const void *message)
{
    const hd_structure *of = parts().structure;
    const int waves = hd_structure_waves(of), d = hd_scene_dimension(scene());
    const size_t n = (size_t)vectors();
    (void)message;
    number("samples", (double)hd_structure_samples(of));
    EACH("waves", waves, STRUCT(NULL, hd_structure_wave(of, k), of_wave));
    const int means = hd_run_fields_due(here.run) ? waves : 0;
    EACH("along", means, numbers(NULL, hd_structure_mean(of, k, HD_ALONG), n, 1));
    EACH("across", means, numbers(NULL, hd_structure_mean(of, k, HD_ACROSS), n, 1));
    LIST("peak", vectors(), hd_structure_peak(of, k));
    EACH("amplitude_along", 1 << d,
         numbers(NULL, hd_structure_amplitude(of, HD_ALONG, (unsigned)k), n, 1));
    EACH("amplitude_across", (d - 1) << d, /* SIN_Z .. and then SECOND .. are the bits 0 .. 15 */
         numbers(NULL, hd_structure_amplitude(of, HD_ACROSS, (unsigned)k), n, 1));
}

static void say_order(hd_order_over order)
{
    open_it(NULL, '{');
    number("time", order.time);
    number("count", (double)order.count);
    numbers("violations", order.violations, (size_t)vectors() - 1, 1);
    numbers("domination", order.domination_violations, (size_t)vectors() - 1, 1);
    close_it('}');
}

static void say_own(const hd_step_columns *of, int step)
{
    LIST(NULL, of->columns[step], of->own[step][k]);
}

static void say_variances(const hd_fluctuations *f, int time)
{
    LIST(NULL, vectors(), hd_fluctuations_variance(f, time, k));
}

static void say_fluctuations(const void *message)
{
    const hd_fluctuations *f = parts().fluctuations;
    const int times = hd_fluctuations_times(f);
    hd_step_columns of = {.count = 0};
    (void)message;
    if (parts().steps) {
        say_steps();
        of = hd_fluctuations_steps(f, parts().steps);
    }
    const int s = of.count;
    LIST("diffusion", vectors(), hd_fluctuations_diffusion(f, k).value);
    LIST("diffusion_error", vectors(), hd_fluctuations_diffusion(f, k).error);
    LIST("step", s, of.step[k]);
    EACH("own", s, say_own(&of, k));
    LIST("covariance", s * s, hd_fluctuations_covariance(f, &of, k / s, k % s).value);
    LIST("covariance_error", s * s, hd_fluctuations_covariance(f, &of, k / s, k % s).error);
    EACH("orders", times, say_order(hd_fluctuations_order(f, k)));
    EACH("variance", times, say_variances(f, k));
    LIST("reversed", times * s * s,
         hd_fluctuations_reversed(f, k / (s * s), &of, k / s % s, k % s));
}

static void say_covariant(const void *message)
{
    const hd_covariant_results seen = hd_covariant_read(parts().covariant);
    const size_t n = (size_t)vectors();
    (void)message;
    STRUCT("covariant", &seen, of_covariant);
    say_spectrum("of", seen.spectrum);
    number("following", here.cost.following);
    numbers("mismatch", seen.start_mismatch_each, n, 1);
    numbers("neighbours", seen.splitting.neighbours, n - 1, 1);
    numbers("neighbours_least", seen.splitting.neighbours_least, n - 1, 1);
    numbers("widths", seen.widths, n, 1);
    numbers("cosines", seen.cosines, n, 1);
    EACH("orders", seen.times, say_order(seen.order[k]));
    EACH("angles", seen.splitting.has_spaces ? HD_PAIRS_OF_SPACES : 0,
         STRUCT(NULL, &seen.splitting.angle[k], of_angle));
    const hd_modes *const weights[] = {seen.half[0], seen.half[1], seen.of_frame};
    for (int half = 0; half < 3 && weights[half]; half++) {
        open_it((const char *[]){"dq", "dp", "frame"}[half], '{');
        say_weights(weights[half]);
        close_it('}');
    }
}

/** L and P modes of the step of a vector, if it has some. */
static void say_pairs(int step)
{
    hd_pmode *pmode = parts().fields;
    const size_t length = (size_t)(scene()->number * hd_scene_coordinates(scene()));
    const hd_step *of = step < 0 ? NULL : hd_steps_step(parts().steps, step);
    if (!of || of->kind != HD_MODE_LP ||
        !hd_pmode_reconstruct(pmode, of, parts().modes, hd_run_frame_columns(here.run)))
        return;
    const int d = hd_pmode_pairs(pmode);
    double *p = calloc(2 * length, sizeof *p);
    hd_trajectory_state(parts().trajectory, NULL, p);
    const hd_modulations *bits =
        &hd_fields_subspace(hd_modes_fields(parts().modes), of->subspace)->modulations;
    LIST("modulation", d, bits->bits[k]);
    LIST("residual", 2 * d, hd_pmode_residual(pmode, k));
    number("rotation", hd_pmode_rotation_distance(pmode));
    EACH("mode", 2 * d, numbers(NULL, hd_pmode_field(pmode, k), length, 1));
    EACH("divided", d,
         (hd_pmode_divide(pmode, p + length, k + d, p), numbers(NULL, p + length, length, 1)));
    free(p);
}

static void say_mode_field(const void *message)
{
    const int col = (int)((const hdr_mode_field *)message)->index - 1;
    const hd_columns frame = hd_run_frame_columns(here.run);
    const size_t rows = (size_t)(2 * scene()->number * hd_scene_coordinates(scene()));
    say_state(message);
    say_steps();
    number("nth", here.nth++);
    if (col < frame.first || col >= frame.first + frame.count) return;
    numbers("vector", frame.data + (col - frame.first), rows, (size_t)frame.stride);
    say_pairs(hd_steps_of_vector(parts().steps, col));
}

/** Only those vectors of which the message is. */
static void say_slow_vectors(const void *message)
{
    const hdr_slow_vectors *of = message;
    const int begin = (int)of->first_index - 1, end = begin + (int)of->vectors;
    const hd_columns frame = hd_run_columns(here.run);
    const size_t rows = (size_t)(2 * scene()->number * hd_scene_coordinates(scene()));
    const hd_modes *modes = parts().modes;
    say_state(message);
    if (!modes) return;
    const hd_fields *fields = hd_modes_fields(modes);
    const int count = hd_fields_subspaces(fields);
    const hd_subspace *last = hd_fields_subspace(fields, count - 1);
    say_steps();
    EACH("fields", count, STRUCT(NULL, hd_fields_subspace(fields, k), of_fields));
    const int known = end <= vectors() && begin >= 0 ? end - begin : 0;
    EACH("coefficient", last->column + last->dimension,
         numbers(NULL, hd_modes_coefficients(modes, k) + begin, (size_t)known, 1));
    const int from = begin > frame.first ? begin : frame.first;
    const int to = end < frame.first + frame.count ? end : frame.first + frame.count;
    number("first", from);
    EACH("vector", to - from,
         numbers(NULL, frame.data + (from - frame.first + k), rows, (size_t)frame.stride));
}

static void say_own_parameter(const hd_parameter *row)
{
    const double value = hd_parameter_effect(row, scene());
    const char *word = hd_parameter_word_of(row, (int)value);
    open_it(NULL, '{');
    text("name", row->name);
    if (row->words && word)
        text("value", word);
    else
        number("value", value);
    close_it('}');
}

static void say_scene(void)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    open_it("effect", '{');
    for (int k = 0; k < count; k++) number(row[k].name, hd_parameter_effect(&row[k], scene()));
    close_it('}');
    const hd_dynamics *of = hd_dynamics_of(scene());
    EACH("own", of->parameters, say_own_parameter(&of->parameter[k]));
    number("packing", hd_scene_packing(scene()));
    EACH("boundary", 3, text(NULL, hd_scene_boundary_word(scene(), k)));
}

static void say_run_info(const void *message)
{
    double box[HD_DIMENSION_MAX] = {0}, outline[2][HD_OUTLINE];
    hd_wave waves[256];
    const int count = scene()->observe & HD_OBSERVE_WAVES ? hd_waves(scene(), waves, 256) : 0;
    const hd_blas blas = hd_blas_query();
    (void)message;
    say_scene();
    hd_scene_box(scene(), box);
    numbers("box", box, HD_DIMENSION_MAX, 1);
    EACH("waves", count, STRUCT(NULL, &waves[k], of_wave));
    const size_t corners = (size_t)hd_scene_outline(scene(), outline[0], outline[1]);
    numbers("outline_x", outline[0], corners, 1);
    numbers("outline_y", outline[1], corners, 1);
    number("ranks", hd_run_ranks(here.run));
    number("threads", hd_run_threads(here.run));
    number("blas_threads", blas.threads);
    text("blas_library", blas.library);
    text("blas_kernel", blas.kernel);
    text("blas_threading", blas.threading);
    text("version", HDLYAP_VERSION);
    number("resumed", here.resumed);
    number("change_time", hd_run_change_time(here.run));
    numbers("changed", here.changed, (size_t)here.changes, 1);
}

static const struct {
    const char *type;
    void (*say)(const void *message);
} witnesses[] = {
    {"hdr_run_info", say_run_info},
    {"hdr_spectrum", say_told},
    {"hdr_modes", say_modes},
    {"hdr_steps", say_spectrum_of_steps},
    {"hdr_lp_phases", say_lp_phases},
    {"hdr_t_phases", say_t_phases},
    {"hdr_mode_field", say_mode_field},
    {"hdr_hydro", say_hydro},
    {"hdr_structure", say_structure},
    {"hdr_covariant", say_covariant},
    {"hdr_localization", say_localization},
    {"hdr_fluctuations", say_fluctuations},
    {"hdr_gas", say_gas},
    {"hdr_state", say_state},
    {"hdr_run_status", say_cost},
    {"hdr_cost", say_cost},
    {"hdr_slow_vectors", say_slow_vectors},
};

/* ---- between node and core ------------------------------------------------------------------ */

static void say(const char *type, const void *message)
{
    if (!out && !(out = fopen(getenv("WITNESS"), "w"))) abort();
    is_first = true;
    open_it(NULL, '{');
    text("type", type);
    number("since", here.since);
    number("now", seconds(CLOCK_REALTIME));
    say_run();
    for (size_t k = 0; k < sizeof witnesses / sizeof *witnesses; k++)
        if (strcmp(witnesses[k].type, type) == 0) witnesses[k].say(message);
    close_it('}');
    putc('\n', out);
    fflush(out);
}

#define PUBLISH(type)                                                                              \
    hdr_status type##_publish(hdr_publisher *publisher, const type *message)                       \
    {                                                                                              \
        hdr_status (*real)(hdr_publisher *, const type *);                                         \
        const double begin = seconds(CLOCK_MONOTONIC);                                             \
        next(&real, #type "_publish");                                                             \
        const hdr_status status = real(publisher, message);                                        \
        if (status == HDR_OK && getenv("WITNESS")) say(#type, message);                            \
        if (strcmp(#type, "hdr_run_info") != 0) here.sending += seconds(CLOCK_MONOTONIC) - begin;  \
        return status;                                                                             \
    }
HDR_MESSAGES(PUBLISH)

hd_status hd_run_create_shared(hd_run **run, const hd_scene_def *def, hd_communicator *communicator,
                               char *message, size_t size)
{
    hd_status (*real)(hd_run **, const hd_scene_def *, hd_communicator *, char *, size_t);
    next(&real, "hd_run_create_shared");
    const hd_status status = real(run, def, communicator, message, size);
    here.run = *run;
    here.since = seconds(CLOCK_REALTIME);
    return status;
}

hd_status hd_run_resume_shared(hd_run **run, const char *path, const hd_scene_def *def,
                               hd_communicator *communicator, char *message, size_t size)
{
    hd_status (*real)(hd_run **, const char *, const hd_scene_def *, hd_communicator *, char *,
                      size_t);
    next(&real, "hd_run_resume_shared");
    const hd_status status = real(run, path, def, communicator, message, size);
    here.run = *run;
    here.since = seconds(CLOCK_REALTIME);
    if (*run) here.resumed = hd_run_time(*run);
    return status;
}

hd_status hd_run_advance(hd_run *run)
{
    hd_status (*real)(hd_run *);
    next(&real, "hd_run_advance");
    if (here.has_begun) here.outside += seconds(CLOCK_MONOTONIC) - here.stepped;
    const hd_status status = real(run);
    here.stepped = seconds(CLOCK_MONOTONIC);
    here.since = seconds(CLOCK_REALTIME);
    here.sent = here.sending;
    here.has_begun = true;
    here.has_cost = false;
    here.nth = 0;
    return status;
}

static void change(const hd_run *run)
{
    if (here.has_begun) here.changed[here.changes++ % 8] = hd_run_change_time(run);
}

hd_status hd_run_change(hd_run *run, const hd_parameter *row, const char *value, char *message,
                        size_t size)
{
    hd_status (*real)(hd_run *, const hd_parameter *, const char *, char *, size_t);
    next(&real, "hd_run_change");
    change(run);
    return real(run, row, value, message, size);
}

void hd_run_fields_every(hd_run *run, double interval)
{
    void (*real)(hd_run *, double);
    next(&real, "hd_run_fields_every");
    change(run);
    real(run, interval);
}

/** WITNESS_RARE: the core says what it seldom says. */
static bool is_rare(void) { return getenv("WITNESS_RARE"); }

/** Its clock stands still between two steps, so that all who ask are told the same. */
hd_cost hd_run_cost(const hd_run *run)
{
    hd_cost (*real)(const hd_run *);
    next(&real, "hd_run_cost");
    if (!here.has_cost) here.cost = real(run);
    if (!here.has_cost && is_rare()) {
        here.cost.second_passes += 5;
        here.cost.repairs += 3;
        here.cost.slow_vector_samples += 9;
        here.cost.communication = 0.25;
        here.cost.bytes = 4096;
        here.cost.calls = 17;
    }
    here.has_cost = true;
    return here.cost;
}

bool hd_run_is_caged(const hd_run *run)
{
    bool (*real)(const hd_run *);
    next(&real, "hd_run_is_caged");
    return real(run) || is_rare();
}

hd_covariant_results hd_covariant_read(const hd_covariant *covariant)
{
    hd_covariant_results (*real)(const hd_covariant *);
    next(&real, "hd_covariant_read");
    hd_covariant_results results = real(covariant);
    if (is_rare()) results.lost += 2;
    return results;
}
