/** Two runs -> their numbers, one by one. */
#include "same.h"
#include "kept.h"
#include "run/run_state.h"

/** What the wall clock says differs between two runs. */
static bool of_the_clock(const char *name)
{
    return strncmp(name, "run wall", 8) == 0 || strcmp(name, "cost") == 0;
}

/** All arrays of both, but those. */
static void expect_same_bytes(const bytes *a, const bytes *b)
{
    assert_int_equal(a->size, b->size);
    for (size_t at = 0; at < a->size;) {
        const char *name = a->data + at;
        const size_t size = kept_array_size(name);
        if (!of_the_clock(name) && memcmp(name, b->data + at, size) != 0)
            fail_msg("%s differs", name);
        at += size;
    }
}

static void expect_same_phases(const hd_phases *a, const hd_phases *b)
{
    double errors[2];
    for (int k = 0; k < hd_phases_count(a); k++) {
        const hd_phase *x = hd_phases_phase(a, k), *y = hd_phases_phase(b, k);
        assert_int_equal(x->state, y->state);
        assert_int_equal(x->col, y->col);
        CHECK_CLOSE(x->a, y->a, 0.0);
        CHECK_CLOSE(x->b, y->b, 0.0);
        CHECK_CLOSE(x->phase, y->phase, 0.0);
        CHECK_CLOSE(x->omega, y->omega, 0.0);
        CHECK_CLOSE(x->omega_error, y->omega_error, 0.0);
        CHECK_CLOSE(x->time, y->time, 0.0);
        CHECK_CLOSE(hd_phases_diffusion(a, k, &errors[0]), hd_phases_diffusion(b, k, &errors[1]),
                    0.0);
        CHECK_CLOSE(errors[0], errors[1], 0.0);
    }
    CHECK_CLOSE(hd_phases_velocity(a).v, hd_phases_velocity(b).v, 0.0);
}

static void expect_same_doubles(const double *a, const double *b, int count)
{
    for (int k = 0; k < count; k++) CHECK_CLOSE(a[k], b[k], 0.0);
}

static void expect_same_modes(const hd_modes *a, const hd_modes *b)
{
    const int n = hd_modes_vectors(a);
    for (int s = 0; s < hd_fields_subspaces(hd_modes_fields(a)); s++)
        for (hd_weight w = HD_WEIGHT; w < HD_WEIGHTS; w++)
            expect_same_doubles(hd_modes_snapshot(a, s, w), hd_modes_snapshot(b, s, w), n);
    for (int c = 0; c < hd_fields_columns(hd_modes_fields(a)); c++)
        expect_same_doubles(hd_modes_coefficients(a, c), hd_modes_coefficients(b, c), n);
}

#if HD_DIM == 2 /* of disks alone */
static void expect_same_structure(const hd_structure *a, const hd_structure *b)
{
    assert_int_equal(hd_structure_samples(a), hd_structure_samples(b));
    for (int w = 0; w < hd_structure_waves(a); w++)
        for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++)
            expect_same_doubles(hd_structure_mean(a, w, e), hd_structure_mean(b, w, e),
                                hd_structure_vectors(a));
}
#endif

static void expect_same_spectrum(const hd_spectrum *a, const hd_spectrum *b, int n)
{
    CHECK_CLOSE(hd_spectrum_sum_up(a).local_time, hd_spectrum_sum_up(b).local_time, 0.0);
    for (int col = 0; col < n; col++) {
        const double local[] = {hd_spectrum_local(a, col), hd_spectrum_local(b, col)};
        assert_int_equal(isnan(local[0]), isnan(local[1]));
        if (!isnan(local[0])) CHECK_CLOSE(local[0], local[1], 0.0);
        CHECK_CLOSE(hd_spectrum_std_error(a, col), hd_spectrum_std_error(b, col), 0.0);
    }
}

static void expect_same_steps(const hd_steps *a, const hd_steps *b)
{
    for (int k = 0; k < hd_steps_count(a); k++) {
        const hd_step *x = hd_steps_step(a, k), *y = hd_steps_step(b, k);
        assert_int_equal(x->resolved, y->resolved);
        assert_int_equal(x->col, y->col);
        assert_int_equal(x->count, y->count);
        assert_int_equal(x->set, y->set);
        assert_int_equal(x->members, y->members);
        CHECK_CLOSE(x->multiplicity, y->multiplicity, 0.0);
        CHECK_CLOSE(x->exponent, y->exponent, 0.0);
        CHECK_CLOSE(x->std_error, y->std_error, 0.0);
        assert_int_equal(x->sharing, y->sharing);
        CHECK_CLOSE(x->set_time, y->set_time, 0.0);
        CHECK_CLOSE(x->own_part, y->own_part, 0.0);
        CHECK_CLOSE(x->gap, y->gap, 0.0);
        CHECK_CLOSE(x->gap_error, y->gap_error, 0.0);
    }
}

static void expect_same_gas(const hd_gas *a, const hd_gas *b)
{
    const hd_gas_means x = hd_gas_read(a), y = hd_gas_read(b);
    assert_memory_equal(&x, &y, sizeof x);
}

static void expect_same_localization(hd_localization *a, hd_localization *b, int n)
{
    expect_same_doubles(hd_localization_widths(a), hd_localization_widths(b), n);
    assert_true(hd_localization_samples(a) == hd_localization_samples(b));
    for (int col = 0; col < n; col++) {
        CHECK_CLOSE(hd_localization_width_now(a, col), hd_localization_width_now(b, col), 0.0);
        CHECK_CLOSE(hd_localization_width_error(a, col), hd_localization_width_error(b, col), 0.0);
    }
}

void expect_same_state(hd_run *a, hd_run *b)
{
    if (hd_run_spectrum(a))
        expect_same_spectrum(hd_run_spectrum(a), hd_run_spectrum(b), hd_run_vectors(a));
    if (hd_run_steps(a)) expect_same_steps(hd_run_steps(a), hd_run_steps(b));
    assert_int_equal(hd_trajectory_wall_events(hd_run_trajectory(a)),
                     hd_trajectory_wall_events(hd_run_trajectory(b)));
    if (hd_run_modes(a)) expect_same_modes(hd_run_modes(a), hd_run_modes(b));
    CHECK_CLOSE(hd_run_followed(a), hd_run_followed(b), 0.0);
    if (hd_run_phases(a)) expect_same_phases(hd_run_phases(a), hd_run_phases(b));
    if (hd_run_gas(a)) expect_same_gas(hd_run_gas(a), hd_run_gas(b));
    if (hd_run_localization(a))
        expect_same_localization(hd_run_localization(a), hd_run_localization(b), hd_run_vectors(a));
    if (hd_run_t_phases(a)) expect_same_phases(hd_run_t_phases(a), hd_run_t_phases(b));
#if HD_DIM == 2
    if (hd_run_structure(a)) expect_same_structure(hd_run_structure(a), hd_run_structure(b));
#endif
    const bytes of_a = kept_bytes(a), of_b = kept_bytes(b);
    expect_same_bytes(&of_a, &of_b);
    free(of_a.data);
    free(of_b.data);
}
