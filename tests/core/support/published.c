#include "published.h"
#include "testing.h"

static void check_number(double x, const char *name)
{
    if (x == 0.0 || (isfinite(x) && fabs(x) >= DBL_MIN)) return;
    fail_msg("%s = %g", name, x);
}

/** What need not be measured. */
static void check_measured(double x, const char *name)
{
    if (!isnan(x)) check_number(x, name);
}

static void check_numbers(const double *x, int count, const char *name)
{
    for (int k = 0; k < count; k++) check_number(x[k], name);
}

static void check_spectrum(const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const int n = hd_run_vectors(run);
    const double local_time = hd_spectrum_sum_up(spectrum).local_time;
    check_number(local_time, "time of the local exponents");
    HEAP double *halves = malloc(2 * (size_t)n * sizeof *halves);
    for (int col = 0; col < n; col++) {
        check_number(hd_spectrum_exponent(spectrum, col), "exponent");
        check_number(hd_spectrum_std_error(spectrum, col), "standard error");
        assert_int_equal(isnan(hd_spectrum_local(spectrum, col)), !(local_time > 0));
        check_measured(hd_spectrum_local(spectrum, col), "local exponent");
    }
    hd_run_dq_dp(run, halves, halves + n);
    for (int col = 0; col < n; col++) {
        check_measured(halves[col], "cos Theta");
        check_measured(halves[n + col], "dp / dq");
        assert_true(!(fabs(halves[col]) > 1.0 + 1e-12));
        /* only a half that vanishes has no angle */
        assert_true(!isnan(halves[col]) || !(halves[n + col] > 1e-150 && halves[n + col] < 1e150));
    }
    check_number(hd_spectrum_time(spectrum), "averaged time");
    check_number(hd_spectrum_exponent(spectrum, 0), "lambda_max");
    check_number(hd_spectrum_sum_up(spectrum).ks_entropy, "entropy");
    check_number(hd_spectrum_sum_up(spectrum).ks_entropy_error, "error of the entropy");
    check_number(hd_spectrum_sum_up(spectrum).pairing_error, "pairing error");
}

static void check_modes(const hd_modes *modes)
{
    const int n = hd_modes_vectors(modes);
    for (int s = 0; s < hd_fields_subspaces(hd_modes_fields(modes)); s++)
        for (hd_weight which = HD_WEIGHT; which < HD_WEIGHTS; which++) {
            check_numbers(hd_modes_snapshot(modes, s, which), n, "weight");
            check_numbers(hd_modes_average(modes, s, which), n, "average weight");
        }
    for (int null = 0; null < NULLS; null++)
        check_numbers(hd_modes_null_average(modes, null), n, "part in the null space");
}

static void check_structure(const hd_structure *s)
{
    const int n = hd_structure_vectors(s);
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++) {
        for (int w = 0; w < hd_structure_waves(s); w++)
            check_numbers(hd_structure_mean(s, w, e), n, "structure factor");
        for (unsigned bits = 0; bits < WALL_SETS; bits++)
            check_numbers(hd_structure_amplitude(s, e, bits), n, "amplitude");
    }
}

static void check_dispersion(hd_dispersion fit)
{
    const double x[] = {fit.c.value,  fit.c.error,  fit.c2.value, fit.c2.error,
                        fit.c3.value, fit.c3.error, fit.misfit,   fit.prior_share};
    check_numbers(x, 8, "dispersion");
}

static void check_steps(const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const int n = hd_modes_vectors(hd_steps_modes(steps));
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        check_number(step->multiplicity, "multiplicity");
        check_number(step->exponent, "exponent of a step");
        check_number(step->std_error, "error of a step");
        assert_true(step->multiplicity >= 0.0 && step->multiplicity <= step->count * (1.0 + 1e-9));
        assert_true(!step->resolved || (step->col >= 0 && step->col + step->count <= n));
    }
    check_dispersion(hd_steps_dispersion(steps, hd_run_spectrum(run), HD_MODE_T));
    check_dispersion(hd_steps_dispersion(steps, hd_run_spectrum(run), HD_MODE_LP));
}

static void check_phases(const hd_phases *phases)
{
    double error;
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        const double x[] = {phase->a,     phase->b,           phase->phase,
                            phase->omega, phase->omega_error, phase->time};
        check_numbers(x, 6, "phase");
        check_number(hd_phases_diffusion(phases, k, &error), "diffusion");
        check_number(error, "error of the diffusion");
    }
    check_number(hd_phases_velocity(phases).v, "velocity");
    check_number(hd_phases_velocity(phases).v_error, "error of the velocity");
}

/** Reconstructed modes and responses, which the caller of a run makes from its vectors. */
static void check_fields(const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const int rows = DIM * hd_run_scene(run)->number;
    double *state = malloc(3 * (size_t)rows * sizeof *state), *p = state + rows, *out = p + rows;
    hd_trajectory_state(hd_run_trajectory(run), state, p);
    MADE(hd_pmode, pmode, hd_run_scene(run));
    MADE(hd_hydro, hydro, hd_run_scene(run), steps);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (!hd_pmode_reconstruct(pmode, step, hd_run_modes(run), hd_run_vectors_now(run)))
            continue;
        for (int c = 0; c < step->expected; c++) {
            hd_pmode_divide(pmode, out, c, p);
            check_numbers(out, rows, "divided field");
            check_numbers(hd_pmode_field(pmode, c), rows, "field");
            check_number(hd_pmode_residual(pmode, c), "residual");
        }
        check_number(hd_pmode_rotation_distance(pmode), "distance from a rotation");
    }
    const hd_columns vectors = hd_run_vectors_now(run);
    if (vectors.count > 0) hd_hydro_measure(hydro, steps, vectors, state, p);
    for (int k = 0; k < hd_hydro_count(hydro); k++) {
        const hd_hydro_response *r = hd_hydro_at(hydro, k);
        const double x[] = {r->density, r->along, r->across, r->energy};
        check_numbers(x, 4, "response");
    }
    free(state);
}

static void check_cost(hd_cost cost)
{
    const double x[] = {cost.std_error, cost.progress, cost.remaining};
    const double measured[] = {cost.interval, cost.condition, cost.defect};
    check_numbers(x, 3, "cost");
    for (int k = 0; k < 3; k++) {
        assert_int_equal(isnan(measured[k]), cost.orthonormalisations == 0);
        check_measured(measured[k], "cost of an interval");
    }
    assert_int_equal(cost.limit == HD_LIMIT_NONE, cost.orthonormalisations == 0);
    check_measured(cost.error_bound, "error bound");
    check_measured(cost.events_per_second, "events per second");
}

void check_published(const hd_run *run)
{
    check_number(hd_run_time(run), "time");
    check_cost(hd_run_cost(run));
    if (hd_run_spectrum(run)) check_spectrum(run);
    if (hd_run_modes(run)) check_modes(hd_run_modes(run));
    if (hd_run_steps(run)) check_steps(run);
    if (hd_run_phases(run)) check_phases(hd_run_phases(run));
    if (hd_run_t_phases(run)) check_phases(hd_run_t_phases(run));
    if (hd_run_structure(run)) check_structure(hd_run_structure(run));
    if (hd_run_steps(run)) check_fields(run);
}
