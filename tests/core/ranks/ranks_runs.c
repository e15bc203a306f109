/** Whole runs of several ranks. */
#define _GNU_SOURCE
#include "dumbbell.h"
#include "runs.h"
#include "together.h"

/* ---- runs ----------------------------------------------------------------------------------- */

static hd_scene_def scene_of_runs(int disks, unsigned observe)
{
    return scene(.number = disks, .density = 0.7, .aspect = 0.3, .seed = 3, .equilibration = 5.0,
                 .warmup = 20.0, .duration = 40.0, .report_interval = 1.0, .threads = 1,
                 .observe = observe);
}

static void expect_same_exponents(const hd_run *run, const hd_run *alone)
{
    const double bound = hd_run_cost(run).error_bound + hd_run_cost(alone).error_bound;
    double most = 0.0;
    assert_int_equal(hd_run_vectors(run), hd_run_vectors(alone));
    for (int col = 0; col < hd_run_vectors(run); col++) {
        const double off = hd_spectrum_exponent(hd_run_spectrum(run), col) -
                           hd_spectrum_exponent(hd_run_spectrum(alone), col);
        CHECK_CLOSE(off, 0.0, bound);
        most = fmax(most, fabs(off));
    }
    if (ranks->rank == 0) print_message("exponents apart by %.1e, bounds %.1e\n", most, bound);
}

/** What walls that shear do to the particles is the same on each rank. */
TEST(a_flow_is_that_of_one_rank)
{
    const hd_scene_def scene = scene_from(scene_of_runs(24, HD_OBSERVE_GAS | HD_OBSERVE_STEPS),
                                          .boundary[1] = HD_SHEARING, .density = 0.4,
                                          .exponents = HD_EXPONENTS_ALL);
    OWNED(hd_run) *run = finish(shared(scene)), *alone = finished(scene);
    expect_same_exponents(run, alone);
    assert_true(hd_run_divergence(alone) < 0);
    CHECK_CLOSE(hd_run_divergence(run), hd_run_divergence(alone), 0.0);
    const hd_gas_means a = hd_gas_read(hd_run_gas(run)), b = hd_gas_read(hd_run_gas(alone));
    CHECK_CLOSE(a.shear_stress, b.shear_stress, 0.0);
    CHECK_CLOSE(a.wall_velocity[1], b.wall_velocity[1], 0.0);
}

TEST(exponents_are_those_of_one_rank)
{
    static const int exponents[] = {HD_EXPONENTS_POSITIVE, HD_EXPONENTS_ALL_INDEPENDENT,
                                    HD_EXPONENTS_ALL};
    for (int k = 0; k < 3; k++) {
        hd_scene_def scene = scene_of_runs(k == 0 ? 60 : 24, 0);
        scene.exponents = exponents[k];
        OWNED(hd_run) *run = finish(shared(scene)), *alone = finished(scene);
        expect_same_exponents(run, alone);
    }
}

/** S is up to 60; the same peaks, or others that are as high. */
static void expect_same_structure(const hd_structure *a, const hd_structure *b)
{
    const int n = hd_structure_vectors(a);
    assert_int_equal(hd_structure_samples(a), hd_structure_samples(b));
    assert_true(hd_structure_samples(a) > 0);
    for (int col = 0; col < n; col++) {
        for (int w = 0; w < hd_structure_waves(a); w++)
            for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++)
                CHECK_CLOSE(hd_structure_mean(a, w, e)[col], hd_structure_mean(b, w, e)[col], 1e-4);
        assert_int_equal(hd_structure_peak(a, col), hd_structure_peak(b, col));
        for (int k = 0; k < 4 * HD_DIRECTIONS; k++) {
            const hd_direction e = (hd_direction)(k % HD_DIRECTIONS);
            const unsigned bits = (unsigned)k / HD_DIRECTIONS;
            CHECK_CLOSE(hd_structure_amplitude(a, e, bits)[col],
                        hd_structure_amplitude(b, e, bits)[col], 1e-4);
        }
    }
}

/** The run has the same trajectory; its frame differs by rounding, and so by little as long as the
 * directions are those of the dynamics. */
static void expect_modes_of_one_rank(int exponents)
{
    hd_scene_def scene = scene_from(
        scene_of_runs(60, HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES | HD_OBSERVE_STRUCTURE),
        .exponents = exponents);
    OWNED(hd_run) *run = finish(shared(scene)), *alone = finished(scene);
    expect_same_exponents(run, alone);
    const hd_modes *own = hd_run_modes(alone), *shared = hd_run_modes(run);
    const int n = hd_run_vectors(run), subspaces = hd_fields_subspaces(hd_modes_fields(own));
    double largest = 0.0;
    for (int s = 0; s < subspaces; s++)
        for (int col = 0; col < n; col++) {
            const double weight = hd_modes_snapshot(own, s, HD_WEIGHT)[col];
            CHECK_CLOSE(hd_modes_snapshot(shared, s, HD_WEIGHT)[col], weight, 1e-6);
            largest = fmax(largest, weight);
        }
    assert_true(largest > 0.5);
    const hd_steps *a = hd_run_steps(run), *b = hd_run_steps(alone);
    assert_int_equal(hd_steps_count(a), hd_steps_count(b));
    for (int k = 0; k < hd_steps_count(a); k++) {
        assert_int_equal(hd_steps_step(a, k)->resolved, hd_steps_step(b, k)->resolved);
        assert_int_equal(hd_steps_step(a, k)->col, hd_steps_step(b, k)->col);
    }
    for (int k = 0; k < hd_phases_count(hd_run_t_phases(alone)); k++) {
        const hd_phase *x = hd_phases_phase(hd_run_t_phases(run), k);
        const hd_phase *y = hd_phases_phase(hd_run_t_phases(alone), k);
        assert_int_equal(x->state, y->state);
        assert_int_equal(x->col, y->col);
        CHECK_CLOSE(x->phase, y->phase, 1e-6);
    }
    expect_same_structure(hd_run_structure(run), hd_run_structure(alone));
    double cosine[2][4 * 60], ratio[2][4 * 60];
    hd_run_dq_dp(run, cosine[0], ratio[0]);
    hd_run_dq_dp(alone, cosine[1], ratio[1]);
    for (int col = 0; col < n; col++) {
        CHECK_CLOSE(cosine[0][col], cosine[1][col], 1e-6);
        CHECK_CLOSE(ratio[0][col], ratio[1][col], 1e-6);
    }
}

TEST(modes_are_those_of_one_rank)
{
    expect_modes_of_one_rank(HD_EXPONENTS_POSITIVE);
    expect_modes_of_one_rank(HD_EXPONENTS_ALL);
}

/** Widths are measured where the vectors are; the gas is that of the trajectory, the same bits. */
TEST(widths_gas_and_fluctuations_are_those_of_one_rank)
{
    const hd_scene_def scene = scene_of_runs(60, HD_OBSERVE_LOCALIZATION | HD_OBSERVE_GAS |
                                                     HD_OBSERVE_FLUCTUATIONS);
    OWNED(hd_run) *run = finish(shared(scene)), *alone = finished(scene);
    hd_localization *shared = hd_run_localization(run), *own = hd_run_localization(alone);
    assert_true(hd_localization_samples(own) > 0);
    assert_true(hd_localization_samples(shared) == hd_localization_samples(own));
    for (int col = 0; col < hd_run_vectors(run); col++) {
        CHECK_CLOSE(hd_localization_widths(shared)[col], hd_localization_widths(own)[col], 1e-6);
        CHECK_CLOSE(hd_localization_width_now(shared, col), hd_localization_width_now(own, col),
                    1e-6);
    }
    const hd_gas_means a = hd_gas_read(hd_run_gas(run)), b = hd_gas_read(hd_run_gas(alone));
    CHECK_CLOSE(a.time, b.time, 1e-9);
    CHECK_CLOSE(a.pressure, b.pressure, 1e-9);
    const hd_fluctuations *f = hd_run_fluctuations(run), *g = hd_run_fluctuations(alone);
    assert_true(hd_fluctuations_times(f) > 1);
    for (int k = 0; k < hd_fluctuations_times(f); k++) {
        const hd_order_over x = hd_fluctuations_order(f, k), y = hd_fluctuations_order(g, k);
        assert_int_equal(x.count, y.count);
        for (int col = 0; x.count > 1 && col + 1 < hd_run_vectors(run); col++) {
            CHECK_CLOSE(x.violations[col], y.violations[col], 1e-9);
            CHECK_CLOSE(hd_fluctuations_variance(f, k, col), hd_fluctuations_variance(g, k, col),
                        1e-6);
        }
    }
}

static hd_scene_def dumbbells(int exponents)
{
    hd_scene_def scene = dumbbells_in_box(24, 14.0, 3.0, 0.25, 0.0, 2, 3);
    scene.equilibration = 5.0;
    scene.warmup = scene.duration = 20.0;
    scene.threads = 1;
    scene.exponents = exponents;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_LOCALIZATION | HD_OBSERVE_GAS;
    return scene;
}

TEST(dumbbells_are_those_of_one_rank)
{
    static const int exponents[] = {HD_EXPONENTS_POSITIVE, HD_EXPONENTS_ALL};
    for (int k = 0; k < 2; k++) {
        OWNED(hd_run) *run = finish(shared(dumbbells(exponents[k]))),
                      *alone = finished(dumbbells(exponents[k]));
        check_same_run(run, alone);
        for (int col = 0; col < hd_run_vectors(run); col++)
            CHECK_CLOSE(hd_modes_share_snapshot(hd_run_modes(run), HD_SHARE_TURNING)[col],
                        hd_modes_share_snapshot(hd_run_modes(alone), HD_SHARE_TURNING)[col], 1e-6);
    }
}

/** The same on every rank, and once more the same: with other delays. */
static void expect_same_bits(hd_scene_def scene)
{
    enum { VECTORS_MAX = 100 };
    double kept[VECTORS_MAX];
    for (int again = 0; again < 2; again++) {
        OWNED(hd_run) *run = finish(shared(scene));
        assert_true(hd_run_vectors(run) <= VECTORS_MAX);
        for (int col = 0; col < hd_run_vectors(run); col++) {
            double here = hd_spectrum_exponent(hd_run_spectrum(run), col), first = here;
            hd_communicator_broadcast(ranks, &first, sizeof first);
            CHECK_CLOSE(here, first, 0.0);
            if (again) CHECK_CLOSE(here, kept[col], 0.0);
            kept[col] = here;
        }
    }
}

TEST(bits_are_the_same)
{
    expect_same_bits(scene_of_runs(30, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES));
    expect_same_bits(dumbbells(HD_EXPONENTS_POSITIVE));
}

static void expect_same_response(const hd_hydro_response *a, const hd_hydro_response *b)
{
    CHECK_CLOSE(a->density, b->density, 1e-6);
    CHECK_CLOSE(a->along, b->along, 1e-6);
    CHECK_CLOSE(a->across, b->across, 1e-6);
    CHECK_CLOSE(a->energy, b->energy, 1e-6);
}

/** Vectors of the modes, from all ranks, and the hydrodynamic response, on each. */
static void expect_vectors_of_one_rank(int exponents)
{
    hd_scene_def scene = scene_from(
        scene_of_runs(60, HD_OBSERVE_ALL & ~(unsigned)HD_OBSERVE_COVARIANT),
        .exponents = exponents);
    hd_run *run = shared(scene), *alone = created(scene);
    finish(run);
    finish(alone);
    CHECK_OK(hd_run_measure(run, 61));
    const hd_columns got = hd_run_vectors_now(run), want = hd_run_vectors_now(alone);
    const bool all = exponents == HD_EXPONENTS_ALL; /* the other half needs the whole of this one */
    assert_int_equal(got.first + got.count, want.count);
    assert_int_equal(got.first, all ? 0 : 61);
    for (int row = 0; row < 240; row++)
        for (int col = 0; col < got.count; col++)
            CHECK_CLOSE(got.data[row * got.stride + col],
                        want.data[row * want.stride + got.first + col], 1e-6);
    hd_hydro *hydro[2];
    double q[120], p[120];
    hd_run *const both[2] = {run, alone};
    for (int k = 0; k < 2; k++) {
        CHECK_OK(hd_hydro_create(&hydro[k], &scene, hd_run_steps(both[k])));
        hd_trajectory_state(hd_run_trajectory(both[k]), q, p);
        hd_hydro_measure(hydro[k], hd_run_steps(both[k]), hd_run_vectors_now(both[k]), q, p);
    }
    int resolved = 0;
    for (int k = 0; k < hd_hydro_count(hydro[0]); k++) {
        resolved += hd_hydro_at(hydro[0], k)->col >= 0;
        expect_same_response(hd_hydro_at(hydro[0], k), hd_hydro_at(hydro[1], k));
    }
    assert_true(resolved > 0);
    for (int k = 0; k < 2; k++) {
        hd_hydro_free(hydro[k]);
        hd_run_free(both[k]);
    }
}

TEST(vectors_are_gathered_for_reports)
{
    expect_vectors_of_one_rank(HD_EXPONENTS_POSITIVE);
    expect_vectors_of_one_rank(HD_EXPONENTS_ALL);
}

/** From the column on that is asked for. */
TEST(vectors_are_gathered_for_fields)
{
    const hd_scene_def scene = scene_of_runs(30, HD_OBSERVE_FIELDS);
    OWNED(hd_run) *run = shared(scene);
    finish(run);
    assert_true(hd_run_fields_due(run));
    CHECK_OK(hd_run_measure(run, 40));
    const hd_columns got = hd_run_vectors_now(run);
    assert_int_equal(got.first + got.count, hd_run_vectors(run));
    assert_int_equal(got.first, 40);
}

TEST(nothing_is_gathered_for_nobody)
{
    static const int exponents[] = {HD_EXPONENTS_POSITIVE, HD_EXPONENTS_ALL};
    for (int k = 0; k < 2; k++) {
        const hd_scene_def scene = scene_from(scene_of_runs(30, HD_OBSERVE_STEPS),
                                              .exponents = exponents[k]);
        OWNED(hd_run) *run = finish(shared(scene));
        assert_true(hd_modes_samples(hd_run_modes(run)) > 0);
        assert_int_equal(hd_run_vectors_now(run).count, 0);
    }
}

/** Windows, and the way back through them. */
TEST(covariant_vectors_are_those_of_one_rank)
{
    const hd_scene_def scene = scene_from(
        scene_of_runs(10, HD_OBSERVE_COVARIANT), .exponents = HD_EXPONENTS_ALL_INDEPENDENT,
        .covariant_window = 10.0, .covariant_transient = 10.0, .covariant_sampling = 1.0);
    OWNED(hd_run) *run = finish(shared(scene)), *alone = finished(scene);
    const hd_covariant *a = hd_run_covariant(run), *b = hd_run_covariant(alone);
    assert_int_equal(hd_covariant_read(a).windows, hd_covariant_read(b).windows);
    assert_true(hd_covariant_read(a).windows >= 2);
    for (int col = 0; col < 40; col++) {
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_read(a).spectrum, col),
                    hd_spectrum_exponent(hd_covariant_read(b).spectrum, col), 1e-6);
        CHECK_CLOSE(hd_covariant_read(a).widths[col], hd_covariant_read(b).widths[col], 1e-6);
        CHECK_CLOSE(hd_covariant_read(a).cosines[col], hd_covariant_read(b).cosines[col], 1e-6);
    }
    CHECK_CLOSE(hd_covariant_read(a).splitting.angle[HD_UNSTABLE_STABLE].mean,
                hd_covariant_read(b).splitting.angle[HD_UNSTABLE_STABLE].mean, 1e-6);
}

/** What one rank gets wrong is said by all with the first report. */
TEST(disks_are_compared)
{
    for (int with_frame = 0; with_frame < 2; with_frame++) {
        hd_scene_def scene = scene_of_runs(20, 0);
        OWNED(hd_run) *run = NULL;
        hd_status status = HD_OK;
        if (!with_frame) scene.exponents = HD_EXPONENTS_NONE;
        scene.seed += ranks->rank == ranks->ranks - 1;
        CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
        while (status == HD_OK && hd_run_time(run) < 1.5) status = hd_run_advance(run);
        assert_int_equal(status, HD_RANKS_APART);
        CHECK_CLOSE(hd_run_time(run), 1.0, 1e-9);
    }
}

/** A watcher sees the slowest vectors at each of its times. */
static void expect_watched(int disks)
{
    const hd_scene_def scene = scene_of_runs(disks, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
    OWNED(hd_run) *run = shared(scene);
    const int first = hd_run_vectors(run) - 6;
    hd_run_watch(run, 0.25);
    int seen = 0;
    while (hd_run_time(run) < 35.0) {
        CHECK_OK(hd_run_advance(run));
        assert_int_equal(hd_run_vectors_now(run).count, 0); /* those of before are none of now */
        CHECK_OK(hd_run_measure(run, first));
        const hd_columns known = hd_run_vectors_now(run);
        if (hd_run_stage(run) < HD_AVERAGING) assert_int_equal(known.count, 0);
        if (hd_run_stage(run) != HD_AVERAGING || hd_run_time(run) < 26.0) continue;
        assert_int_equal(known.first, first);
        assert_int_equal(known.count, 6);
        seen++;
    }
    assert_true(seen >= 36);
}

TEST(the_slowest_are_watched)
{
    expect_watched(40);
    expect_watched(20); /* the last of four ranks has no vectors */
}

/* ---- checkpoints ----------------------------------------------------------------------------- */

/** Kept by several ranks, it goes on with several or with one; kept by one, with several. */
TEST(checkpoints_fit_any_number_of_ranks)
{
    const hd_scene_def scene = scene_of_runs(30, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
    char message[300] = "", own[40], path[] = "ranks.checkpoint";
    snprintf(own, sizeof own, "ranks_%d.checkpoint", ranks->rank);
    hd_run *run, *same, *fewer, *more, *alone = created(scene);
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    until_time(run, 40.0);
    until_time(alone, 40.0);
    CHECK_OK(hd_run_save(run, path, "", message, sizeof message));
    CHECK_OK(hd_run_save(alone, own, "", message, sizeof message));
    CHECK_OK(hd_run_resume_shared(&same, path, NULL, ranks, message, sizeof message));
    CHECK_OK(hd_run_resume(&fewer, path, NULL, message, sizeof message));
    CHECK_OK(hd_run_resume_shared(&more, own, NULL, ranks, message, sizeof message));
    finish(run);
    finish(alone);
    finish(same);
    finish(fewer);
    finish(more);
    for (int col = 0; col < hd_run_vectors(run); col++)
        CHECK_CLOSE(hd_spectrum_exponent(hd_run_spectrum(same), col),
                    hd_spectrum_exponent(hd_run_spectrum(run), col), 0.0);
    expect_same_exponents(fewer, run);
    expect_same_exponents(more, alone);
    hd_run *const all[] = {run, alone, same, fewer, more};
    for (int k = 0; k < 5; k++) hd_run_free(all[k]);
    (void)remove(own);
    if (ranks->rank == 0) (void)remove(path);
}

TEST(checkpoints_that_fail_are_said_by_all)
{
    const hd_scene_def scene = scene_of_runs(20, 0);
    char message[300] = "";
    hd_run *run, *none;
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    assert_int_equal(hd_run_save(run, "no/such/folder", "", message, sizeof message),
                     HD_FILE_FAULT);
    assert_int_equal(strstr(message, "no/such/folder") != NULL, ranks->rank == 0);
    /* a file that one of them does not see */
    char path[40];
    CHECK_OK(hd_run_save(run, "ranks.checkpoint", "", message, sizeof message));
    snprintf(path, sizeof path, "ranks.checkpoint%s", ranks->rank == ranks->ranks - 1 ? "x" : "");
    assert_int_equal(hd_run_resume_shared(&none, path, NULL, ranks, message, sizeof message),
                     HD_FILE_FAULT);
    assert_non_null(strstr(message, "ranks.checkpoint"));
    hd_run_free(run);
    if (ranks->rank == 0) (void)remove("ranks.checkpoint");
}

/** The next descriptor that is free. */
static int next_descriptor(void)
{
    const int next = dup(STDERR_FILENO);
    (void)close(next);
    return next;
}

TEST(checkpoints_that_fail_leave_no_file_open)
{
    OWNED(hd_run) *run = shared(scene_of_runs(20, 0));
    const int before = next_descriptor();
    for (int again = 0; again < 3; again++)
        assert_int_equal(hd_run_save(run, "no/such/folder", "", NULL, 0), HD_FILE_FAULT);
    assert_int_equal(next_descriptor(), before);
}

/* ---- rank 0 leads --------------------------------------------------------------------------- */

static const hd_parameter *parameter_named(const char *name)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    while (strcmp(row->name, name) != 0) row++;
    return row;
}

/** All that a node does with a run, and what it says of it. */
static double lead(hd_communicator *c)
{
    hd_scene_def scene = scene_of_runs(30,
                                       HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_FIELDS);
    char message[300], path[] = "led.checkpoint";
    int fields = 0;
    OWNED(hd_run) *run = NULL;
    scene.observe |= HD_OBSERVE_COVARIANT;
    scene.exponents = HD_EXPONENTS_ALL;
    if (c) assert_int_equal(hd_run_create_shared(&run, &scene, c, message, 300), HD_REFUSED);
    scene.observe &= ~(unsigned)HD_OBSERVE_COVARIANT;
    scene.field_interval = 2.0;
    scene.exponents = HD_EXPONENTS_POSITIVE; /* of which some are gathered, not all */
    CHECK_OK(hd_run_create_shared(&run, &scene, c, message, 300));
    while (hd_run_time(run) < 30.0) {
        CHECK_OK(hd_run_advance(run));
        if (!hd_run_fields_due(run)) continue;
        CHECK_OK(hd_run_measure(run, 1));
        fields += hd_run_vectors_now(run).first <= 1 && hd_run_vectors_now(run).count > 0;
    }
    assert_true(fields > 0);
    hd_run_watch(run, 0.5);
    while (hd_run_time(run) < 35.0) {
        CHECK_OK(hd_run_advance(run));
        CHECK_OK(hd_run_measure(run, hd_run_vectors(run) - 4));
    }
    hd_run_watch(run, INFINITY);
    hd_run_observe(run, HD_OBSERVE_STEPS);
    CHECK_OK(
        hd_run_change(run, parameter_named("target"), "smallest 1e-9, T(1,0) 1e-9%", message, 300));
    CHECK_OK(hd_run_change(run, parameter_named("duration"), "50", message, 300));
    assert_int_equal(hd_run_change(run, parameter_named("duration"), "-1", message, 300),
                     HD_REFUSED);
    until_time(run, 45.0);
    CHECK_OK(hd_run_reset_average(run));
    CHECK_OK(hd_run_save(run, path, "a label", message, 300));
    hd_run_free(run);
    scene.duration = 55.0;
    CHECK_OK(hd_run_resume_shared(&run, path, &scene, c, message, 300));
    (void)remove(path);
    finish(run);
    const double sum = hd_spectrum_sum_up(hd_run_spectrum(run)).ks_entropy;
    CHECK_CLOSE(hd_run_time(run), 100.0, 1e-9);
    return sum;
}

TEST(others_follow)
{
    if (ranks->rank > 0) {
        hd_run_follow(ranks, NULL, 0);
        return;
    }
    hd_run_lead(ranks);
    const double sum = lead(ranks);
    hd_run_dismiss(ranks);
    CHECK_CLOSE(sum, lead(NULL), 1e-6);
}

TEST(what_they_cannot_carry_is_refused)
{
    char message[200];
    hd_run *run;
    hd_scene_def scene = scene_from(scene_of_runs(20, HD_OBSERVE_COVARIANT),
                                    .exponents = HD_EXPONENTS_ALL, .covariant_window = 10.0,
                                    .covariant_transient = 10.0, .covariant_sampling = 1.0);
    assert_int_equal(hd_run_create_shared(&run, &scene, ranks, message, sizeof message),
                     HD_REFUSED);
    assert_non_null(strstr(message, "covariant"));
    assert_non_null(strstr(message, "all_independent"));
}

int main(int argc, char **argv) { return ranks_main(argc, argv); }
