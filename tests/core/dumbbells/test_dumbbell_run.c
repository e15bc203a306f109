/** Runs of dumbbells: numbers of exponents, pairs, checkpoints, and what is refused. */
#include "create_from.h"
#include "dumbbell.h"
#include "dynamics/dumbbells/dumbbells.h"
#include "hdlyap/checkpoint.h"
#include "hdlyap/covariant.h"
#include "runs.h"

static hd_scene_def few(int walls)
{
    hd_scene_def def = dumbbells_in_box(4, 4.0, 3.0, 0.4, 0.0, walls, 3);
    def.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
    def.equilibration = 20.0;
    def.warmup = 50.0;
    def.duration = 400.0;
    return def;
}

TEST(all_exponents_come_in_pairs_and_some_vanish)
{
    static const int zeros[] = {6, 4, 4, 2};
    for (int walls = 0; walls < 4; walls++) {
        OWNED(hd_run) *run = finished(few(walls));
        const int n = hd_run_vectors(run), first = (n - zeros[walls]) / 2;
        const hd_spectrum *spectrum = hd_run_spectrum(run);
        assert_int_equal(n, 6 * 4);
        assert_int_equal(hd_scene_counts(hd_run_scene(run)).zero, zeros[walls]);
        for (int l = 0; l < n; l++) {
            const double exponent = hd_spectrum_exponent(spectrum, l);
            CHECK_CLOSE(exponent + hd_spectrum_exponent(spectrum, n - 1 - l), 0.0, 2.0 / 400.0);
            /* ln(t) / t */
            if (l >= first && l < first + zeros[walls]) CHECK_CLOSE(exponent, 0.0, 0.03);
        }
        CHECK_WITHIN(hd_spectrum_exponent(spectrum, first - 1), 0.2, 10.0);
    }
}

static hd_run *long_box(double duration)
{
    hd_scene_def def = dumbbells_in_box(36, 24.0, 2.5, 0.25, 0.0, 0, 1);
    def.equilibration = 50.0;
    def.warmup = 100.0;
    def.duration = duration;
    def.threads = 1;
    def.observe = HD_OBSERVE_STEPS | HD_OBSERVE_GAS;
    return finished(def);
}

static const hd_step *first_step(const hd_run *run, hd_mode_kind kind)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    for (int k = 0; k < hd_steps_count(steps); k++)
        if (hd_steps_step(steps, k)->kind == kind) return hd_steps_step(steps, k);
    return NULL;
}

/** 36 in 24 x 2.5, by a program of another kind, with one standard error. */
TEST(a_long_box_has_the_numbers_of_another_program)
{
    static const double lp[] = {0.915, 0.900, 0.885, 0.874}, lp_error = 0.002, z = 4.0;
    OWNED(hd_run) *run = long_box(2000.0);
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const hd_gas_means gas = hd_gas_read(hd_run_parts(run).gas);
    const hd_step *t = first_step(run, HD_MODE_T), *l = first_step(run, HD_MODE_LP);
    CHECK_CLOSE(gas.collision_rate, 9.365, z * hypot(0.013, gas.collision_rate_error));
    CHECK_CLOSE(hd_spectrum_exponent(spectrum, 0), 5.226,
                z * hypot(0.010, hd_spectrum_std_error(spectrum, 0)));
    assert_int_equal(t->col, 103);
    assert_int_equal(l->col, 99);
    CHECK_CLOSE(t->exponent, 0.6363, z * hypot(0.0005, t->std_error));
    for (int k = 0; k < 4; k++)
        CHECK_CLOSE(hd_spectrum_exponent(spectrum, l->col + k), lp[k],
                    z * hypot(lp_error, hd_spectrum_std_error(spectrum, l->col + k)));
    const double *turning = hd_modes_share_average(hd_run_parts(run).modes, HD_SHARE_TURNING);
    CHECK_WITHIN(t->multiplicity / 2.0, 0.88, 0.94);
    CHECK_WITHIN(l->multiplicity / 4.0, 0.74, 0.80); /* with the rotation of P; without it 0.63 */
    for (int k = 0; k < 2; k++) CHECK_WITHIN(turning[t->col + k], 0.01, 0.03);
    for (int k = 0; k < 4; k++) CHECK_WITHIN(turning[l->col + k], 0.15, 0.23);
}

/** Of vectors made by hand: one angle, one place, both, and a dp alone; and the average of a run.
 */
TEST(what_turns_is_a_part_of_each_vector)
{
    enum { COUNT = 8, VECTORS = 4 };
    static const double want[VECTORS] = {1.0, 0.0, 0.36, 0.0};
    const hd_scene_def def = dumbbells_in_box(COUNT, 8.0, 4.0, 0.3, 0.0, 0, 1);
    double v[DUMBBELL_ROWS * COUNT][VECTORS] = {{0.0}}, q[D * COUNT], p[D * COUNT];
    MADE(hd_modes, modes, &def, VECTORS, 1);
    for (int k = 0; k < D * COUNT; k++) q[k] = p[k] = 0.5 + k;
    v[DUMBBELL_ROWS * 3 + 2][0] = -0.7;
    v[DUMBBELL_ROWS * 5 + 1][1] = 0.2;
    v[DUMBBELL_ROWS * 5][2] = 0.8, v[DUMBBELL_ROWS * 6 + 2][2] = 0.6;
    v[DUMBBELL_ROWS * 2 + 5][2] = 9.0;
    v[DUMBBELL_ROWS * 2 + 4][3] = 1.0;
    CHECK_OK(hd_modes_measure(modes, (hd_columns){&v[0][0], VECTORS, 0, VECTORS}, q, p));
    hd_modes_add(modes);
    for (int l = 0; l < VECTORS; l++) {
        CHECK_CLOSE(hd_modes_share_snapshot(modes, HD_SHARE_TURNING)[l], want[l], 1e-14);
        CHECK_CLOSE(hd_modes_share_average(modes, HD_SHARE_TURNING)[l], want[l], 1e-14);
    }
    const hd_scene_def disks = scene(.number = 16);
    MADE(hd_modes, of_disks, &disks, VECTORS, 1);
    assert_null(hd_modes_share_average(of_disks, HD_SHARE_TURNING));
}

/** The exact vectors, of length 1, lie in the null space, each in its part. */
TEST(null_vectors_are_known_to_the_modes)
{
    enum { COUNT = 8, NULLS_ALL = 6 };
    static const int part[NULLS_ALL] = {0, 0, 1, 1, 2, 2};
    const hd_scene_def def = dumbbells_in_box(COUNT, 8.0, 4.0, 0.3, 0.0, 0, 1);
    double column[NULLS_ALL][DUMBBELL_ROWS * COUNT], v[DUMBBELL_ROWS * COUNT][NULLS_ALL];
    MADE(hd_trajectory, tr, &def);
    MADE(hd_modes, modes, &def, NULLS_ALL, 1);
    const molecules s = molecules_now(tr);
    assert_int_equal(hd_dynamics_of(&def)->null_vectors(&def, s.q, s.p, column[0]), NULLS_ALL);
    for (int l = 0; l < NULLS_ALL; l++) {
        double square = 0.0;
        for (int row = 0; row < DUMBBELL_ROWS * COUNT; row++)
            square += column[l][row] * column[l][row];
        for (int row = 0; row < DUMBBELL_ROWS * COUNT; row++)
            v[row][l] = column[l][row] / sqrt(square);
    }
    CHECK_OK(hd_modes_measure(modes, (hd_columns){&v[0][0], NULLS_ALL, 0, NULLS_ALL}, s.q, s.p));
    for (int l = 0; l < NULLS_ALL; l++)
        for (int null = 0; null < 3; null++)
            CHECK_CLOSE(hd_modes_null_snapshot(modes, null)[l], null == part[l] ? 1.0 : 0.0, 1e-12);
}

/** Covariant vectors look at the same frames as the modes do, and know the null space. */
TEST(all_that_can_be_observed_is)
{
    hd_scene_def def = dumbbells_in_box(20, 14.0, 2.4, 0.3, 0.0, 0, 1);
    def.equilibration = 20.0;
    def.warmup = 120.0;
    def.duration = 300.0;
    def.exponents = HD_EXPONENTS_ALL;
    def.observe = HD_OBSERVE_ALL & ~(unsigned)HD_OBSERVE_HYDRO;
    OWNED(hd_run) *run = finished(def);
    const hd_step *t = first_step(run, HD_MODE_T);
    const hd_covariant_results c = hd_covariant_read(hd_run_parts(run).covariant);
    assert_true(t->resolved);
    CHECK_WITHIN((double)c.windows, 1, 100);
    CHECK_WITHIN(c.null_most, 0.0, 1e-10);
    for (int l = t->col; l < t->col + t->count; l++)
        CHECK_CLOSE(hd_modes_average(c.of_frame, t->subspace, HD_WEIGHT)[l],
                    hd_modes_average(hd_run_parts(run).modes, t->subspace, HD_WEIGHT)[l], 0.1);
}

/** What crosses a line, by the virial with arms, and what the walls take: impulses of their events
 * over both walls. */
TEST(the_pressure_is_that_of_the_walls)
{
    const double time = 2000.0;
    hd_scene_def def = dumbbells_in_box(20, 7.0, 6.0, 0.6, 0.0, 3, 2);
    double box[2], taken[2] = {0.0};
    MADE(hd_trajectory, tr, &def);
    OWNED(hd_record) *log = new_dumbbell_log(&def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 50.0));
    const hd_totals before = hd_trajectory_totals(tr);
    CHECK_OK(hd_trajectory_extend(tr, log, 50.0 + time));
    const hd_totals after = hd_trajectory_totals(tr);
    hd_scene_box(&def, box);
    for (size_t k = 0; k < hd_record_count(log); k++) {
        const hd_bump *b = hd_record_entry(log, k);
        const int d = b->n[0] == 0.0;
        const double rate = b->n[d] * b->p[d] + b->across[0] * b->spin[0];
        if (b->j < 0) taken[d] -= 2.0 * rate / (1.0 + b->across[0] * b->across[0]);
    }
    for (int d = 0; d < 2; d++) {
        const double wall = taken[d] / (2.0 * time * (box[1 - d] - 1.0)),
                     kinetic = def.number * hd_gas_temperature(&def),
                     line = (kinetic + (after.virial[d] - before.virial[d]) / time) /
                            hd_gas_area(&def);
        CHECK_CLOSE(line / wall, 1.0, 0.02);
    }
}

/** All bonds and inertias, as far as disks as dense cover 0.6; 5000 collisions or more are known to
 * 3 %. */
TEST(collisions_are_as_many_as_expected)
{
    static const double bonds[] = {0.01, 0.25, 0.8, 1.3, 2.0}, inertias[] = {-1.0, 0.0, 3.0},
                        covered[] = {0.05, 0.3, 0.6};
    for (int b = 0; b < 5; b++)
        for (int i = 0; i < 3; i++)
            for (int c = 0; c < 3; c++) {
                const double each = fmin(0.25 * PI + bonds[b], 2.1),
                             edge = sqrt(100 * each / covered[c]);
                const hd_scene_def def = dumbbells_in_box(100, edge, edge, bonds[b], inertias[i], 0,
                                                          3);
                const double expected = hd_dynamics_of(&def)->collision_rate(&def),
                             wait = 1000 / expected, time = 5000 / expected;
                MADE(hd_trajectory, tr, &def);
                CHECK_OK(hd_trajectory_extend(tr, NULL, wait));
                const double before = (double)hd_trajectory_totals(tr).collisions;
                CHECK_OK(hd_trajectory_extend(tr, NULL, wait + time));
                CHECK_CLOSE(((double)hd_trajectory_totals(tr).collisions - before) / time /
                                expected,
                            1.0, 0.2);
            }
}

TEST(a_run_goes_on_from_its_checkpoint_bit_for_bit)
{
    const char *path = "dumbbells.checkpoint";
    hd_scene_def def = dumbbells_in_box(12, 8.0, 3.0, 0.3, 0.0, 2, 9);
    char message[512] = "";
    def.equilibration = 5.0;
    def.warmup = 5.0;
    def.duration = 20.0;
    def.threads = 1;
    def.observe = HD_OBSERVE_STEPS;
    OWNED(hd_run) *whole = created(def), *resumed = NULL;
    until_time(whole, 17.3);
    CHECK_OK(hd_run_save(whole, path, "", message, sizeof message));
    if (hd_run_resume(&resumed, path, &def, message, sizeof message) != HD_OK)
        fail_msg("%s", message);
    finish(whole);
    finish(resumed);
    for (int l = 0; l < hd_run_vectors(whole); l++)
        assert_true(hd_spectrum_exponent(hd_run_spectrum(whole), l) ==
                    hd_spectrum_exponent(hd_run_spectrum(resumed), l));
    (void)remove(path);
}

static void refused(hd_scene_def def, const char *with)
{
    char message[512] = "";
    assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
    if (!strstr(message, with)) fail_msg("\"%s\" is not in \"%s\"", with, message);
}

TEST(what_cannot_be_is_refused_by_name)
{
    const hd_scene_def good = dumbbells_in_box(36, 24.0, 2.5, 0.25, 0.0, 0, 1);
    hd_scene_def def = good;
    CHECK_OK(hd_scene_check(&def, NULL, 0));
    def.own[0].real = 2.5;
    refused(def, "bond = 2.5: must be from 0.01 to 2");
    def = good;
    def.own[1].real = -2.0;
    refused(def, "inertia = -2: must be disks, points, or from 1e-6 to 1e6");
    def = good;
    def.own[0].real = 2.0;
    refused(def, "above the length of a dumbbell, 1 + bond = 3");
    def = good;
    def.density = 1.1;
    refused(def, "density = 1.1 (packing fraction 1.136)");
    def = good;
    def.container = HD_CIRCLE;
    def.aspect = usual_dumbbells().aspect;
    def.density = 0.3;
    refused(def, "container = circle: must be rectangle with particles = dumbbells");
    hd_trajectory *tr;
    const molecules s = {.q = {1.0, 1.0, 0.0}};
    assert_int_equal(hd_trajectory_create_from(&tr, &def, s.q, s.p), HD_REFUSED);
    def = good;
    def.observe = HD_OBSERVE_HYDRO | HD_OBSERVE_STEPS;
    refused(def, "observables = hydro: must not be given with particles = dumbbells");
}

/** A box too narrow for a molecule is refused of prepared states, too. */
TEST(no_prepared_molecule_meets_its_own_image)
{
    const molecules s = {.q = {1.0, 0.7, 0.0, 5.0, 0.7, 0.0}, .p = {1.0, 0.0, 0.0, -1.0, 0.0, 0.0}};
    hd_trajectory *tr;
    for (int walls = 0; walls < 4; walls++) {
        const hd_scene_def def = dumbbells_in_box(2, 8.0, 1.45, 0.5, 0.0, walls, 1);
        const hd_status status = hd_trajectory_create_from(&tr, &def, s.q, s.p);
        assert_int_equal(status, walls < 2 ? HD_REFUSED : HD_OK);
        hd_trajectory_free(tr);
    }
}

TEST(a_long_rest_takes_no_time)
{
    const hd_scene_def def = dumbbells_in_box(2, 8.0, 6.0, 0.5, 0.0, 0, 1);
    const molecules s = {.q = {1.0, 1.0, 0.3, 5.0, 3.0, -0.2}};
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create_from(&tr, &def, s.q, s.p));
    CHECK_OK(hd_trajectory_extend(tr, NULL, 1e12));
    const molecules now = molecules_now(tr);
    for (int k = 0; k < 2 * D; k++) CHECK_CLOSE(now.q[k], s.q[k], 0.0);
    hd_trajectory_free(tr);
}

/** Near what rows can hold at best: (d + .866) of each of short bonds, a lattice of disks without
 * gaps at 1, sqrt(3), and rows between at 1.5. A million are refused without a wait. */
TEST(long_bonds_interlock)
{
    static const struct {
        double bond, best, close;
    } cases[] = {{0.25, 0.8961, 0.003},
                 {1.0, 0.57735, 0.002},
                 {1.5, 0.50395, 0.002},
                 {1.7320508, 0.57735, 0.005},
                 {2.0, 0.535, 0.003}};
    for (int k = 0; k < 5; k++) {
        const hd_scene_def def = dumbbells_in_box(1000000, 1e3, 1e3, cases[k].bond, 0.0, 0, 1);
        CHECK_CLOSE(hd_dumbbell_density_max(&def), cases[k].best, cases[k].close);
    }
}

/** It starts, and a little more is refused, of any boundary. */
TEST(the_density_that_a_refusal_names_is_the_largest)
{
    static const double bonds[] = {0.01, 0.25, 1.0, 2.0};
    for (int walls = 0; walls < 4; walls++)
        for (int b = 0; b < 4; b++) {
            hd_scene_def def = dumbbells_in_box(30, 5.6, 5.0, bonds[b], 0.0, walls, 1);
            char message[512] = "";
            double most = 0.0;
            assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
            const char *at = strstr(message, "must be at most ");
            assert_true(at && sscanf(at, "must be at most %lf", &most) == 1);
            def.density = most * (1.0 + 1e-5); /* six digits are told */
            assert_int_equal(hd_scene_check(&def, NULL, 0), HD_REFUSED);
            def.density = most * (1.0 - 1e-5);
            MADE(hd_trajectory, tr, &def);
            CHECK_OK(hd_trajectory_extend(tr, NULL, 0.5));
        }
}
