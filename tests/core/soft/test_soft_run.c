/** Runs of soft particles: numbers of exponents, pairs, numbers of another program, null vectors,
 * checkpoints, what is refused, and hard cases. */
#include "hdlyap/checkpoint.h"
#include "base/memory.h"
#include "dynamics/trajectory.h"
#include "hdlyap/covariant.h"
#include "kept.h"
#include "runs.h"
#include "same.h"
#include "soft.h"

static hd_scene_def short_run(hd_scene_def def, double duration)
{
    def.equilibration = 20.0;
    def.warmup = 20.0;
    def.duration = duration;
    return def;
}

TEST(all_exponents_come_in_pairs_and_some_vanish)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++) {
            hd_scene_def def = short_run(soft_few(dimension, potential, HD_PEFRL, 0.004), 400.0);
            def.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
            OWNED(hd_run) *run = finished(def);
            const int n = hd_run_vectors(run), zeros = 2 * dimension + 2, first = (n - zeros) / 2;
            const hd_spectrum *spectrum = hd_run_spectrum(run);
            assert_int_equal(n, 2 * dimension * def.number);
            assert_int_equal(hd_scene_counts(hd_run_scene(run)).zero, zeros);
            for (int l = 0; l < n; l++) {
                const double exponent = hd_spectrum_exponent(spectrum, l);
                CHECK_CLOSE(exponent + hd_spectrum_exponent(spectrum, n - 1 - l), 0.0, 8.0 / 400.0);
                if (l >= first && l < first + zeros)
                    CHECK_CLOSE(exponent, 0.0, potential == HD_WCA ? 0.08 : 0.03); /* ln(t) / t */
            }
            CHECK_WITHIN(hd_spectrum_exponent(spectrum, first - 1), 0.1, 10.0);
        }
}

/** Exponents 1, 16, 17, all positive ones of a particle, and the kinetic temperature. */
enum { KNOWN = 5 };

/** Adds what 10 in a square at density 0.7 have, wca, Verlet's steps of 0.0025, and the squares of
 * its errors. A run is no longer than the energy takes to walk by some 1e-3. */
static void ten_have(double *sum, double *square, uint64_t seed, double duration)
{
    static const int col[] = {0, 15, 16};
    hd_scene_def def = soft_box(2, HD_WCA, HD_VERLET, 0.0025, 10, sqrt(10 / 0.7));
    def.equilibration = def.warmup = 100.0;
    def.duration = duration;
    def.seed = seed;
    def.observe = HD_OBSERVE_GAS;
    OWNED(hd_run) *run = finished(def);
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    for (int k = 0; k < 3; k++) {
        sum[k] += hd_spectrum_exponent(spectrum, col[k]);
        square[k] += pow(hd_spectrum_std_error(spectrum, col[k]), 2);
    }
    for (int l = 0; l < hd_run_vectors(run); l++) /* errors as if all strayed together */
        sum[3] += hd_spectrum_exponent(spectrum, l) / def.number;
    square[3] += pow(0.5 * hd_run_vectors(run) / def.number * hd_spectrum_std_error(spectrum, 0),
                     2);
    sum[4] += hd_gas_read(hd_run_gas(run)).temperature;
    square[4] += pow(0.1, 2) / duration;
}

TEST(ten_have_the_numbers_of_another_program)
{
    static const double known[KNOWN] = {3.1123, 0.9887, 0.5716, 3.6588, 0.8046},
                        error[KNOWN] = {0.0018, 0.0032, 0.0035, 0.0014, 0.0003};
    const double z = 4.0;
    const int runs = second_tier() ? 16 : 1;
    double sum[KNOWN] = {0.0}, square[KNOWN] = {0.0};
    for (int k = 0; k < runs; k++) ten_have(sum, square, (uint64_t)k + 1, 2000.0);
    for (int k = 0; k < KNOWN; k++)
        CHECK_CLOSE(sum[k] / runs, known[k], z * hypot(error[k], sqrt(square[k]) / runs));
}

/* ---- null vectors -------------------------------------------------------------------------- */

/** They go through the record as they are at its end; the flow as exactly as its steps are, of wca
 * not well. */
TEST(null_vectors_stay_what_they_are)
{
    static double column[7 * SOFT_ROWS_MAX], later[7 * SOFT_ROWS_MAX];
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++) {
            const hd_scene_def def = soft_few(dimension, potential, HD_PEFRL, 0.001);
            const hd_dynamics *of = hd_dynamics_of(&def);
            const int rows = 2 * dimension * def.number, count = 2 * dimension + 1;
            const softs s = softs_of_a_fluid(def, 5);
            OWNED(hd_record) *log = new_soft_log(&def);
            const softs now = softs_later(&def, &s, 1.0, log);
            assert_int_equal(of->null_vectors(&def, s.q, s.p, column), count);
            assert_int_equal(of->null_vectors(&def, now.q, now.p, later), count);
            for (int l = 0; l < count; l++) {
                double *v = column + l * rows;
                const double close = l < count - 1 ? 1e-11 : 1e-3;
                soft_carry(v, &def, log, 0.0, 1.0, 1);
                for (int row = 0; row < rows; row++) {
                    const bool moved = l >= dimension && l < 2 * dimension; /* (0, e) to (e, e) */
                    const double shift = moved && row % (2 * dimension) == l - dimension;
                    if (l < count - 1 || potential != HD_WCA)
                        CHECK_CLOSE(v[row] - shift, later[l * rows + row], close);
                }
            }
        }
}

/** Largest angle of the exact vectors to the covariant ones of exponent zero. */
static double null_apart(double step)
{
    hd_scene_def def = soft_few(2, HD_POWER, HD_PEFRL, step);
    def.equilibration = 20.0;
    def.warmup = def.covariant_transient = 60.0;
    def.covariant_window = 40.0;
    def.covariant_sampling = 4.0;
    def.duration = 320.0;
    def.exponents = HD_EXPONENTS_ALL;
    def.observe = HD_OBSERVE_COVARIANT;
    OWNED(hd_run) *run = finished(def);
    const hd_covariant_results c = hd_covariant_read(hd_run_parts(run).covariant);
    assert_true(c.windows >= 2);
    return c.null_most;
}

/** The flow is a covariant vector of exponent zero, as exactly as steps of fourth order are. */
TEST(covariant_vectors_know_the_null_space)
{
    const double coarse = null_apart(0.004), fine = null_apart(0.002);
    CHECK_WITHIN(coarse, 1e-8, 1e-3);
    CHECK_WITHIN(coarse / fine, 8.0, 32.0);
}

/** Parts of the gradient of the energy (-F, p), and of the flow, in the unstable vectors. */
typedef struct unstable {
    double gradient, flow;
} unstable;

static unstable in_unstable(double step, uint64_t seed)
{
    hd_scene_def def = short_run(soft_few(2, HD_POWER, HD_PEFRL, step), 20.0);
    def.exponents = hd_scene_counts(&def).positive;
    def.seed = seed;
    OWNED(hd_run) *run = finished(def);
    const hd_columns v = hd_frame_columns(run->carrier.frame);
    double column[5 * SOFT_ROWS_MAX], square = 0.0;
    const double *flow = column + 4 * 4 * def.number;
    const softs s = softs_now(hd_run_trajectory(run));
    unstable in = {0.0, 0.0};
    assert_int_equal(hd_dynamics_of(&def)->null_vectors(&def, s.q, s.p, column), 5);
    for (int row = 0; row < 4 * def.number; row++) square += flow[row] * flow[row];
    for (int l = 0; l < def.exponents; l++) {
        double along = 0.0, across = 0.0;
        for (int row = 0; row < 4 * def.number; row++) {
            const int other = row % 4 < 2 ? row + 2 : row - 2;
            along += v.data[row * v.stride + l] * flow[row];
            across += v.data[row * v.stride + l] * flow[other] * (row % 4 < 2 ? -1.0 : 1.0);
        }
        in.gradient += across * across / square;
        in.flow += along * along / square;
    }
    return in;
}

/** As exactly as its steps are; and most of the flow, of which hard bodies have nothing there. */
TEST(unstable_vectors_have_no_part_in_the_gradient_of_the_energy)
{
    enum { SEEDS = 16 };
    double flow = 0.0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        const unstable in = in_unstable(0.004, seed);
        CHECK_WITHIN(in.gradient, 0.0, 1e-7);
        flow += in.flow / SEEDS;
    }
    CHECK_WITHIN(flow, 0.5, 0.9);
}

/** Translations and their momenta are parts of the null space that modes know, and the flow is. */
TEST(modes_know_the_null_space_of_soft_particles)
{
    enum { VECTORS = 5 };
    const hd_scene_def def = soft_few(2, HD_WCA, HD_VERLET, 0.003);
    const int rows = 4 * def.number;
    const softs s = softs_of_a_fluid(def, 3);
    double column[VECTORS * SOFT_ROWS_MAX], v[SOFT_ROWS_MAX * VECTORS];
    MADE(hd_modes, modes, &def, VECTORS, 1);
    assert_int_equal(hd_dynamics_of(&def)->null_vectors(&def, s.q, s.p, column), VECTORS);
    for (int l = 0; l < VECTORS; l++) {
        double square = 0.0;
        for (int row = 0; row < rows; row++) square += pow(column[l * rows + row], 2);
        for (int row = 0; row < rows; row++)
            v[row * VECTORS + l] = column[l * rows + row] / sqrt(square);
    }
    CHECK_OK(hd_modes_measure(modes, (hd_columns){v, VECTORS, 0, VECTORS}, s.q, s.p));
    for (int l = 0; l < VECTORS; l++)
        for (int null = 0; null < 3; null++)
            CHECK_CLOSE(hd_modes_null_snapshot(modes, null)[l], null == (l < 4 ? l % 2 : 2), 1e-12);
}

/* ---- checkpoints --------------------------------------------------------------------------- */

TEST(a_run_goes_on_from_its_checkpoint_bit_for_bit)
{
    const char *path = "soft.checkpoint";
    for (int dimension = 2; dimension <= 3; dimension++) {
        hd_scene_def def = short_run(soft_few(dimension, HD_WCA, HD_PEFRL, 0.003), 20.0);
        def.observe = HD_OBSERVE_GAS;
        char message[512] = "";
        OWNED(hd_run) *whole = created(def);
        for (double time = 7.3; time < 60.0; time += 17.1) {
            hd_run *resumed;
            until_time(whole, time);
            CHECK_OK(hd_run_save(whole, path, "", message, sizeof message));
            if (hd_run_resume(&resumed, path, &def, message, sizeof message) != HD_OK)
                fail_msg("%s", message);
            expect_same_state(whole, resumed);
            for (int k = 0; k < 5; k++) {
                if (hd_run_stage(whole) == HD_FINISHED) break;
                CHECK_OK(hd_run_advance(whole));
                CHECK_OK(hd_run_advance(resumed));
            }
            expect_same_state(whole, resumed);
            assert_true(hd_trajectory_fingerprint(hd_run_trajectory(whole)) ==
                        hd_trajectory_fingerprint(hd_run_trajectory(resumed)));
            hd_run_free(resumed);
        }
    }
    (void)remove(path);
}

/** Whatever calls it is made of, and whether there is a record. */
TEST(steps_lie_where_they_lie)
{
    const hd_scene_def def = soft_few(2, HD_WCA, HD_VERLET, 0.003);
    MADE(hd_trajectory, whole, &def);
    MADE(hd_trajectory, parts, &def);
    OWNED(hd_record) *log = new_soft_log(&def);
    CHECK_OK(hd_trajectory_extend(whole, NULL, 10.0));
    for (int k = 1; k <= 1000; k++) CHECK_OK(hd_trajectory_extend(parts, log, 0.01 * k));
    const softs a = softs_now(whole), b = softs_now(parts);
    assert_memory_equal(a.q, b.q, 2 * (size_t)def.number * sizeof *a.q);
    assert_memory_equal(a.p, b.p, 2 * (size_t)def.number * sizeof *a.p);
    assert_null(hd_record_fault(log, &def));
}

/* ---- what cannot be ------------------------------------------------------------------------ */

static void refused(hd_scene_def def, const char *with)
{
    char message[512] = "";
    assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
    if (!strstr(message, with)) fail_msg("\"%s\" is not in \"%s\"", with, message);
}

TEST(what_cannot_be_is_refused_by_name)
{
    const hd_scene_def good = soft_box(2, HD_WCA, HD_PEFRL, 0.0, 36, 8.0);
    hd_scene_def def = good;
    CHECK_OK(hd_scene_check(&def, NULL, 0));
    def.boundary[1] = HD_REFLECTING;
    refused(def, "boundary_y = reflecting: must be periodic with particles = soft_disks");
    def = good;
    def.container = HD_CIRCLE;
    def.aspect = hd_scene_def_default().aspect;
    refused(def, "container = circle: must be rectangle with particles = soft_disks");
    refused(soft_box(3, HD_LENNARD_JONES, HD_PEFRL, 0.0, 20, 4.9),
            "the box edge Lx = 4.9 must be above 5, twice the range of potential = lennard_jones");
    def = good;
    def.own[HD_SOFT_ENERGY].real = -0.1;
    refused(def, "energy = -0.1: must be above 0, the potential energy per particle of the start "
                 "lattice with potential = wca");
    def = good;
    def.own[HD_SOFT_TIME_STEP].real = -1.0;
    refused(def, "time_step = -1: must be from 0 to 10");
    def = good;
    def.own[HD_SOFT_POTENTIAL].whole = 7;
    refused(def, "potential = 7: must be power, wca or lennard_jones");
    def = good;
    def.number = 1;
    def.density = 1.0 / 64.0;
    refused(def, "number = 1: must be an integer from 2");
}

/** They tell of no collisions: not as a number, and not as a target. */
TEST(a_target_is_what_they_tell)
{
    hd_scene_def def = short_run(soft_box(2, HD_POWER, HD_VERLET, 0.01, 16, 6.0), 1e5);
    def.exponents = HD_EXPONENTS_NONE;
    def.observe = HD_OBSERVE_GAS;
    strcpy(def.target.line, "collision_rate 1%");
    char message[512] = "";
    assert_int_equal(hd_target_check(&def, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "target = collision_rate 1%: must be without collision_rate: "
                                 "soft_disks do not collide");
    strcpy(def.target.line, "temperature 1%, potential_energy 2%, pressure 1%");
    OWNED(hd_run) *run = finished(def);
    const hd_gas_means m = hd_gas_read(hd_run_gas(run));
    CHECK_WITHIN(m.time, 10.0, 9e4);
    CHECK_WITHIN(m.temperature_error, 1e-5, 0.01 * m.temperature);
    CHECK_WITHIN(m.potential_energy_error, 1e-5, 0.02 * m.potential_energy);
    CHECK_WITHIN(m.pressure_error, 1e-5, 0.01 * m.pressure);
    assert_true(isnan(m.collision_rate) && m.collision_rate_error == -1.0);
}

/** In a long box, but what asks for collisions. */
TEST(all_that_can_be_observed_is)
{
    hd_scene_def def = soft_box(2, HD_WCA, HD_VERLET, 0.004, 20, 10.0);
    def.density = 20 / (24.0 * 2.4);
    def.aspect = 0.1;
    def.equilibration = 20.0;
    def.warmup = 120.0;
    def.duration = 300.0;
    def.exponents = HD_EXPONENTS_ALL;
    def.observe = HD_OBSERVE_ALL & ~(unsigned)HD_OBSERVE_HYDRO;
    OWNED(hd_run) *run = finished(def);
    const hd_covariant_results c = hd_covariant_read(hd_run_parts(run).covariant);
    CHECK_WITHIN((double)c.windows, 1, 100);
    CHECK_WITHIN(hd_gas_read(hd_run_gas(run)).pressure, 0.2, 1.0);
}

/** The least energy that a refusal names is the least. */
TEST(a_start_lattice_can_have_too_much_energy)
{
    hd_scene_def def = soft_box(2, HD_WCA, HD_PEFRL, 0.0, 36, 6.0);
    char message[512] = "";
    double least = 0.0;
    def.own[HD_SOFT_ENERGY].real = 0.1;
    assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
    const char *at = strstr(message, "must be above ");
    assert_true(at && sscanf(at, "must be above %lf", &least) == 1);
    def.own[HD_SOFT_ENERGY].real = least * (1.0 - 1e-5);
    assert_int_equal(hd_scene_check(&def, NULL, 0), HD_REFUSED);
    def.own[HD_SOFT_ENERGY].real = least * (1.0 + 1e-5);
    MADE(hd_trajectory, tr, &def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 0.5));
}

/* ---- hard cases ---------------------------------------------------------------------------- */

TEST(two_at_the_same_place_are_no_start_but_where_nothing_diverges)
{
    for (int potential = 0; potential < HD_POTENTIALS; potential++) {
        const hd_scene_def def = soft_few(2, potential, HD_VERLET, 0.001);
        softs s = softs_of_a_fluid(def, 5);
        hd_trajectory *tr;
        s.q[2] = s.q[0];
        s.q[3] = s.q[1];
        const hd_status status = hd_trajectory_create_from(&tr, &def, s.q, s.p);
        assert_int_equal(status, potential == HD_POWER ? HD_OK : HD_NOT_FINITE);
        if (status == HD_OK) CHECK_OK(hd_trajectory_extend(tr, NULL, 1.0));
        hd_trajectory_free(tr);
    }
}

/** At once, or when two come so near as seldom happens: what was averaged before stays. */
TEST(a_step_that_is_too_long_is_named)
{
    static const double steps[] = {0.05, 0.02};
    for (int k = 0; k < 2; k++) {
        const hd_scene_def def = short_run(soft_few(2, HD_WCA, HD_VERLET, steps[k]), 1e5);
        hd_status status = HD_OK;
        OWNED(hd_run) *run = created(def);
        while (status == HD_OK) status = hd_run_advance(run);
        assert_int_equal(status, HD_ENERGY_LOST);
        assert_non_null(strstr(hd_status_text(status), "the time step is too long"));
        assert_true(hd_trajectory_energy(hd_run_parts(run).trajectory).most > HD_ENERGY_LOST_FROM);
        if (hd_run_stage(run) < HD_AVERAGING) continue;
        CHECK_WITHIN(hd_spectrum_exponent(hd_run_spectrum(run), 0), 1.0, 10.0);
        CHECK_WITHIN(hd_spectrum_time(hd_run_spectrum(run)), 10.0, 1e5);
    }
}

/* ---- the rest of the row ------------------------------------------------------------------- */

/** Each fault planted into a record that is whole. */
TEST(a_record_says_what_is_wrong_with_it)
{
    const hd_scene_def def = soft_few(2, HD_WCA, HD_VERLET, 0.003);
    static const struct {
        int entry, number; /* of a kick in its first step; of its doubles */
        double value;
        const char *fault;
    } planted[] = {{0, 1, 0.0, "the first entry begins no time step"},
                   {0, 3, 0.002, "a time step has a wrong length"},
                   {1, 1, 5.0, "an entry names a particle that does not exist"},
                   {1, 1, 0.5, "an entry names a particle that does not exist"},
                   {1, 2, 0.0, "an entry names a partner that does not exist"},
                   {1, 2, 5.0, "an entry names a partner that does not exist"},
                   {1, 5, NAN, "a number is not finite"}};
    const softs s = softs_of_a_fluid(def, 3);
    for (size_t k = 0; k < sizeof planted / sizeof *planted; k++) {
        OWNED(hd_record) *log = new_soft_log(&def);
        (void)softs_later(&def, &s, 1.0, log);
        double *entry = log->entry;
        const size_t size = log->size / sizeof *entry;
        assert_null(hd_record_fault(log, &def));
        while (planted[k].entry == 1 && entry[1] < 0) entry += size;
        entry[planted[k].number] = planted[k].value;
        assert_string_equal(hd_record_fault(log, &def), planted[k].fault);
    }
}

TEST(a_long_run_takes_no_more_memory)
{
    hd_scene_def def = short_run(soft_few(2, HD_WCA, HD_VERLET, 0.004), 2000.0);
    OWNED(hd_run) *run = created(def);
    until_time(run, 1000.0);
    const size_t before = hd_memory_allocations();
    finish(run);
    assert_int_equal(hd_memory_allocations(), before);
}
