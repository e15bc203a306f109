/** A run -> the numbers that it says. A row of observables whose results are more than what a
 * checkpoint keeps has its say_NAME here. */
#include "said.h"

#include "hdlyap/fluctuations.h"
#include "runs.h"

#define HD_OBSERVABLE(name, NAME, bit, of_waves, result)                                           \
    __attribute__((weak)) void say_##name(said *s, const hd_run *run);
#include "hdlyap/observables.inc"

/* ---- numbers ------------------------------------------------------------------------------- */

static void say(said *s, const char *name, double value)
{
    if (s->count == s->room) {
        s->room = s->room ? 2 * s->room : 1024;
        s->number = realloc(s->number, s->room * sizeof *s->number);
        assert_non_null(s->number);
    }
    const bool another = s->count > 0 && strcmp(s->number[s->count - 1].name, name) == 0;
    const size_t place = another ? s->number[s->count - 1].place + 1 : 0;
    s->number[s->count++] = (said_number){s->part, name, place, value};
}

static void say_all(said *s, const char *name, const double *x, size_t count)
{
    for (size_t k = 0; x && k < count; k++) say(s, name, x[k]);
}

void said_free(said *s) { free(s->number); }

void expect_same_said(const said *a, const said *b)
{
    for (size_t k = 0; k < a->count && k < b->count; k++) {
        const said_number *x = &a->number[k], *y = &b->number[k];
        assert_string_equal(x->name, y->name);
        if (memcmp(&x->value, &y->value, sizeof x->value) == 0) continue;
        if (isnan(x->value) && isnan(y->value)) continue;
        fail_msg("%s: %s %zu: %.17g and %.17g", x->part, x->name, x->place, x->value, y->value);
    }
    assert_int_equal(a->count, b->count);
}

/* ---- what several parts are made of --------------------------------------------------------- */

static void say_spectrum(said *s, const hd_spectrum *of, int n)
{
    const hd_spectrum_sums sums = hd_spectrum_sum_up(of);
    say(s, "time", hd_spectrum_time(of));
    for (int col = 0; col < n; col++) {
        say(s, "exponent", hd_spectrum_exponent(of, col));
        say(s, "std_error", hd_spectrum_std_error(of, col));
        say(s, "local", hd_spectrum_local(of, col));
    }
    say(s, "local_time", sums.local_time);
    say(s, "ks_entropy", sums.ks_entropy);
    say(s, "ks_entropy_error", sums.ks_entropy_error);
    say(s, "pairing_error", sums.pairing_error);
    say(s, "exponent_sum", sums.exponent_sum);
    say(s, "exponent_sum_error", sums.exponent_sum_error);
    say(s, "kaplan_yorke", sums.kaplan_yorke);
    say(s, "kaplan_yorke_error", sums.kaplan_yorke_error);
}

static void say_weights(said *s, const hd_modes *of, const hd_scene_def *scene)
{
    const hd_fields *fields = hd_modes_fields(of);
    const size_t n = (size_t)hd_modes_vectors(of),
                 rows = (size_t)(hd_scene_coordinates(scene) * scene->number);
    say(s, "samples", (double)hd_modes_samples(of));
    for (int k = 0; k < hd_fields_subspaces(fields); k++)
        for (hd_weight w = HD_WEIGHT; w < HD_WEIGHTS; w++) {
            say_all(s, "snapshot", hd_modes_snapshot(of, k, w), n);
            say_all(s, "average", hd_modes_average(of, k, w), n);
        }
    for (int null = 0; null <= hd_scene_dimension(scene); null++) {
        say_all(s, "null snapshot", hd_modes_null_snapshot(of, null), n);
        say_all(s, "null average", hd_modes_null_average(of, null), n);
    }
    say_all(s, "turning snapshot", hd_modes_share_snapshot(of, HD_SHARE_TURNING), n);
    say_all(s, "turning average", hd_modes_share_average(of, HD_SHARE_TURNING), n);
    say_all(s, "second snapshot", hd_modes_share_snapshot(of, HD_SHARE_SECOND), n);
    say_all(s, "second average", hd_modes_share_average(of, HD_SHARE_SECOND), n);
    for (int column = 0; column < hd_fields_columns(fields); column++)
        say_all(s, "coefficients", hd_modes_coefficients(of, column), n);
    say_all(s, "fields", hd_fields_data(fields), rows * (size_t)hd_fields_stride(fields));
}

static void say_order(said *s, hd_order_over order, size_t n)
{
    say(s, "order time", order.time);
    say(s, "order count", (double)order.count);
    say_all(s, "violations", order.violations, n - 1);
    say_all(s, "domination violations", order.domination_violations, n - 1);
}

/* ---- observables --------------------------------------------------------------------------- */

void say_gas(said *s, const hd_run *run)
{
    const hd_gas_means means = hd_gas_read(hd_run_gas(run));
    say_all(s, "means", (const double *)&means, sizeof means / sizeof(double));
}

void say_modes(said *s, const hd_run *run) { say_weights(s, hd_run_modes(run), hd_run_scene(run)); }

static void say_step(said *s, const hd_steps *steps, int k)
{
    const hd_step *step = hd_steps_step(steps, k);
    const bool waves = step->kind != HD_MODE_ZERO;
    say(s, "resolved", step->resolved);
    say(s, "col", step->col);
    say(s, "count", step->count);
    say(s, "set", step->set);
    say(s, "members", step->members);
    say(s, "multiplicity", step->multiplicity);
    say(s, "step exponent", step->exponent);
    say(s, "step error", step->std_error);
    say(s, "step mixing", step->mixing);
    say(s, "sharing", step->sharing);
    say(s, "set_time", step->set_time);
    say(s, "own_part", step->own_part);
    say(s, "gap", step->gap);
    say(s, "gap_error", step->gap_error);
    say(s, "is shown", hd_steps_is_shown(steps, k));
    if (step->resolved) say(s, "example", hd_steps_example(steps, k));
    if (step->resolved && waves) say(s, "scatter", hd_steps_scatter(steps, step));
}

void say_steps(said *s, const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    for (int k = 0; k < hd_steps_count(steps); k++) say_step(s, steps, k);
    for (int col = 0; col < hd_run_vectors(run); col++)
        say(s, "step of vector", hd_steps_of_vector(steps, col));
    for (hd_mode_kind kind = HD_MODE_T; kind <= HD_MODE_LP; kind++) {
        const hd_dispersion d = hd_steps_dispersion(steps, hd_run_spectrum(run), kind);
        const double numbers[] = {d.points,   d.k_min,    d.k_max,    d.prior_share,
                                  d.c.value,  d.c.error,  d.c2.value, d.c2.error,
                                  d.c3.value, d.c3.error, d.misfit,   d.c_sampling_error,
                                  d.c_mixing};
        say(s, "lowest", hd_steps_lowest(steps, kind));
        say_all(s, "dispersion", numbers, sizeof numbers / sizeof *numbers);
    }
}

void say_structure(said *s, const hd_run *run)
{
    const hd_structure *of = hd_run_structure(run);
    const size_t n = (size_t)hd_run_vectors(run);
    say(s, "samples", (double)hd_structure_samples(of));
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++) {
        for (int w = 0; w < hd_structure_waves(of); w++) {
            say_all(s, "mean", hd_structure_mean(of, w, e), n);
            say_all(s, "snapshot", hd_structure_snapshot(of, w, e), n);
        }
        for (int m = 0; m < HD_TRANSVERSE_IN(hd_scene_dimension(hd_run_scene(run))); m++)
            say_all(s, "amplitude", hd_structure_amplitude(of, e, (unsigned)m), n);
    }
    for (int col = 0; col < hd_run_vectors(run); col++) say(s, "peak", hd_structure_peak(of, col));
}

static void say_all_phases(said *s, const hd_phases *of, const hd_steps *steps)
{
    double omega, error;
    for (int k = 0; k < hd_phases_count(of); k++) {
        const hd_phase *x = hd_phases_phase(of, k);
        const double diffusion = hd_phases_diffusion(of, k, &error);
        const double numbers[] = {x->step, x->modulation, x->col,         x->state,
                                  x->a,    x->b,          x->phase,       x->omega,
                                  x->time, diffusion,     x->omega_error, error};
        say_all(s, "phase", numbers, sizeof numbers / sizeof *numbers);
    }
    for (int k = 0; k < hd_steps_count(steps); k++)
        if (hd_phases_rate(of, k, &omega, &error)) say(s, "omega", omega), say(s, "error", error);
    const hd_velocity v = hd_phases_velocity(of);
    const double numbers[] = {v.phases,  v.k_min,  v.k_max,           v.v,
                              v.v_error, v.misfit, v.v_sampling_error};
    say_all(s, "velocity", numbers, sizeof numbers / sizeof *numbers);
}

void say_phases(said *s, const hd_run *run)
{
    say_all_phases(s, hd_run_phases(run), hd_run_steps(run));
}

void say_t_phases(said *s, const hd_run *run)
{
    say_all_phases(s, hd_run_t_phases(run), hd_run_steps(run));
}

void say_localization(said *s, const hd_run *run)
{
    hd_localization *of = hd_run_localization(run);
    say(s, "samples", (double)hd_localization_samples(of));
    say_all(s, "widths", hd_localization_widths(of), (size_t)hd_run_vectors(run));
    for (int col = 0; col < hd_run_vectors(run); col++) {
        say(s, "width now", hd_localization_width_now(of, col));
        say(s, "width error", hd_localization_width_error(of, col));
    }
}

/** Of each step whose modes can be reconstructed from the vectors as they are. */
void say_fields(said *s, const hd_run *run)
{
    const hd_scene_def *scene = hd_run_scene(run);
    const size_t size = (size_t)(hd_scene_coordinates(scene) * scene->number);
    HEAP double *p = calloc(2 * size, sizeof *p);
    hd_pmode *of = hd_run_fields(run);
    hd_trajectory_state(hd_run_trajectory(run), NULL, p);
    for (int k = 0; k < hd_steps_count(hd_run_steps(run)); k++) {
        if (!hd_pmode_reconstruct(of, hd_steps_step(hd_run_steps(run), k), hd_run_modes(run),
                                  hd_run_vectors_now(run)))
            continue;
        say(s, "rotation distance", hd_pmode_rotation_distance(of));
        for (int c = 0; c < 2 * hd_pmode_pairs(of); c++) {
            say(s, "residual", hd_pmode_residual(of, c));
            say_all(s, "field", hd_pmode_field(of, c), size);
            if (c < hd_pmode_pairs(of)) continue;
            hd_pmode_divide(of, p + size, c, p);
            say_all(s, "divided", p + size, size);
        }
    }
}

void say_hydro(said *s, const hd_run *run)
{
    for (int k = 0; k < hd_hydro_count(hd_run_hydro(run)); k++) {
        const hd_hydro_response *r = hd_hydro_at(hd_run_hydro(run), k);
        const double numbers[] = {r->step,  r->col,    r->modulation, r->density,
                                  r->along, r->across, r->energy,     r->across_second};
        say_all(s, "response", numbers, sizeof numbers / sizeof *numbers);
    }
}

static void say_splitting(said *s, hd_splitting_results of, size_t n)
{
    say(s, "splitting samples", (double)of.samples);
    say_all(s, "neighbours", of.neighbours, n - 1);
    say_all(s, "neighbours_least", of.neighbours_least, n - 1);
    for (int pair = 0; of.has_spaces && pair < HD_PAIRS_OF_SPACES; pair++) {
        const hd_angle_of_spaces *angle = &of.angle[pair];
        const double numbers[] = {angle->last, angle->mean, angle->std_error, angle->least,
                                  angle->mean_of_all};
        say_all(s, "angle", numbers, sizeof numbers / sizeof *numbers);
        for (int bin = 0; bin < HD_ANGLE_BINS; bin++) {
            say(s, "smallest", (double)angle->smallest[bin]);
            say(s, "all", (double)angle->all[bin]);
        }
    }
}

void say_covariant(said *s, const hd_run *run)
{
    const hd_covariant_results r = hd_covariant_read(hd_run_covariant(run));
    const size_t n = (size_t)r.vectors;
    say(s, "windows", (double)r.windows);
    say(s, "lost", (double)r.lost);
    say(s, "window_end", r.window_end - run->agenda.start);
    say_spectrum(s, r.spectrum, r.vectors);
    say_splitting(s, r.splitting, n);
    for (int k = 0; k < r.times; k++) say_order(s, r.order[k], n);
    say(s, "mismatch most", r.start_mismatch.most);
    say(s, "mismatch centre", r.start_mismatch.centre);
    say(s, "mismatch stable", r.start_mismatch.stable);
    say_all(s, "mismatch each", r.start_mismatch_each, n);
    say_all(s, "turned", r.turned, n);
    say(s, "null", r.null);
    say(s, "null_most", r.null_most);
    for (int half = 0; half < 2; half++)
        if (r.half[half]) say_weights(s, r.half[half], hd_run_scene(run));
    if (r.of_frame) say_weights(s, r.of_frame, hd_run_scene(run));
    say_all(s, "widths", r.widths, n);
    say_all(s, "cosines", r.cosines, n);
}

static void say_pairs_of_steps(said *s, const hd_run *run)
{
    const hd_fluctuations *of = hd_run_fluctuations(run);
    const hd_step_columns columns = hd_fluctuations_steps(of, hd_run_steps(run));
    for (int a = 0; a < columns.count; a++)
        for (int b = 0; b < columns.count; b++) {
            const hd_diffusion d = hd_fluctuations_covariance(of, &columns, a, b);
            say(s, "covariance", d.value);
            say(s, "covariance error", d.error);
            for (int k = 0; k < hd_fluctuations_times(of); k++)
                say(s, "reversed", hd_fluctuations_reversed(of, k, &columns, a, b));
        }
}

void say_fluctuations(said *s, const hd_run *run)
{
    const hd_fluctuations *of = hd_run_fluctuations(run);
    for (int k = 0; k < hd_fluctuations_times(of); k++) {
        say_order(s, hd_fluctuations_order(of, k), (size_t)hd_run_vectors(run));
        for (int col = 0; col < hd_run_vectors(run); col++)
            say(s, "variance", hd_fluctuations_variance(of, k, col));
    }
    for (int col = 0; col < hd_run_vectors(run); col++) {
        const hd_diffusion d = hd_fluctuations_diffusion(of, col);
        say(s, "diffusion", d.value);
        say(s, "diffusion error", d.error);
    }
    if (hd_run_steps(run)) say_pairs_of_steps(s, run);
}

/* ---- the run ------------------------------------------------------------------------------- */

static void say_trajectory(said *s, const hd_run *run)
{
    const hd_trajectory *of = hd_run_trajectory(run);
    const size_t size = (size_t)(hd_scene_coordinates(hd_run_scene(run)) *
                                 hd_run_scene(run)->number);
    HEAP double *q = calloc(2 * size, sizeof *q);
    const hd_totals totals = hd_trajectory_totals(of);
    const hd_invariants examined = hd_trajectory_examined(of);
    hd_trajectory_state(of, q, q + size);
    say_all(s, "q p", q, 2 * size);
    say(s, "time", hd_trajectory_time(of));
    say(s, "collisions", (double)totals.collisions);
    say(s, "wall_events", (double)totals.wall_events);
    say_all(s, "totals", &totals.expected,
            (sizeof totals - offsetof(hd_totals, expected)) / sizeof(double));
    say_all(s, "examined", (const double *)&examined, sizeof examined / sizeof(double));
}

/** But for what the wall clock says. */
static void say_cost(said *s, const hd_run *run)
{
    const hd_cost c = hd_run_cost(run);
    const double numbers[] = {c.interval,
                              c.limit,
                              c.condition,
                              c.defect,
                              c.error_bound,
                              (double)c.orthonormalisations,
                              (double)c.second_passes,
                              (double)c.slow_vector_samples,
                              (double)c.repairs,
                              c.std_error,
                              c.stalled_since,
                              c.stalled_error,
                              c.progress,
                              c.target.value,
                              c.target.error,
                              c.target.wanted,
                              c.target.open,
                              c.target.left,
                              c.target.reached};
    say_all(s, "cost", numbers, sizeof numbers / sizeof *numbers);
}

static void say_run(said *s, const hd_run *run)
{
    const size_t n = (size_t)hd_run_vectors(run);
    HEAP double *halves = calloc(2 * n + 1, sizeof *halves);
    hd_run_dq_dp(run, halves, halves + n);
    say_all(s, "halves", halves, 2 * n);
    say(s, "stage", hd_run_stage(run));
    say(s, "report due", hd_run_report_due(run));
    say(s, "followed", hd_run_phase_time(run));
    say(s, "caged", hd_run_is_caged(run));
    say(s, "divergence", hd_run_divergence(run));
    say(s, "divergence_error", hd_run_divergence_error(run));
    say(s, "shortest duration", hd_run_shortest_duration(run));
    say_cost(s, run);
}

static const char *const names[HD_OBSERVED] = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) #name,
#include "hdlyap/observables.inc"
};
static void (*const say_row[HD_OBSERVED])(said *s, const hd_run *run) = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) say_##name,
#include "hdlyap/observables.inc"
};

/** Says the bytes that a checkpoint keeps of the observable s->part. */
static void say_kept(said *s, const hd_run *run)
{
    HEAP char *kept = NULL;
    size_t size = 0;
    int k = 0;
    while (strcmp(names[k], s->part) != 0) k++;
    FILE *file = open_memstream(&kept, &size);
    hd_archive archive = hd_archive_writer(file);
    const hd_moment now = {.trajectory = hd_run_trajectory(run), .archive = &archive};
    hd_observable_rows[k]->archive(run->observables.part[k], &now);
    CHECK_OK(hd_archive_end(&archive));
    fclose(file);
    for (size_t place = 0; place < size; place++) say(s, "kept", kept[place]);
}

said said_of_averages(const hd_run *run)
{
    said s = {.part = "spectrum"};
    const hd_parts parts = hd_run_parts(run);
    if (parts.spectrum) say_spectrum(&s, parts.spectrum, hd_run_vectors(run));
    for (int k = 0; k < HD_OBSERVED; k++) {
        s.part = names[k];
        if (run->observables.part[k]) (say_row[k] ? say_row[k] : say_kept)(&s, run);
    }
    return s;
}

said said_by(const hd_run *run)
{
    said s = said_of_averages(run);
    s.part = "trajectory";
    say_trajectory(&s, run);
    s.part = "run";
    say_run(&s, run);
    return s;
}
