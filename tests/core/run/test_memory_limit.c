/** The estimate of a run's memory against what the core asks for, and what is said where it is too
 * little. */
#include "dumbbell.h"
#include "ledger.h"
#include "rotors.h"
#include "runs.h"
#include "soft.h"
#include "observe/observables.h"

/** To 7 %; and a run gives back what it had. */
static void compare(hd_scene_def scene)
{
    const size_t before = ledger_now().live;
    ledger_reset_peak();
    hd_run_free(finished(scene));
    assert_int_equal(ledger_now().live, before);
    CHECK_WITHIN(hd_memory_needed(&scene, scene.threads, 1) / (double)ledger_now().peak, 0.93,
                 1.07);
}

/** Intervals become as long as they do. */
static hd_scene_def short_run(int disks, int exponents, unsigned observe)
{
    return scene(.number = disks, .density = 0.8, .aspect = 1.0, .equilibration = 0.1,
                 .warmup = 3.0, .duration = 3.0, .report_interval = 3.0, .exponents = exponents,
                 .observe = observe, .threads = 2);
}

TEST(the_estimate_is_what_is_asked_for)
{
    enum { MODES = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES };
    const hd_scene_def modes = short_run(300, HD_EXPONENTS_POSITIVE, MODES),
                       structure = scene_from(modes, .observe = MODES | HD_OBSERVE_STRUCTURE);
    compare(short_run(300, HD_EXPONENTS_POSITIVE, 0));
    compare(modes);
    compare(structure);
    compare(scene_from(structure, .aspect = 0.01));
    compare(scene_from(modes, .max_wave_number = hd_wave_limits_of(&modes).largest));
    compare(short_run(200, HD_EXPONENTS_ALL, MODES));
    compare(scene_from(short_run(2000, 60, 0), .warmup = 10.0));
    compare(scene_from(short_run(20000, HD_EXPONENTS_NONE, 0), .warmup = 0.0, .equilibration = 0.0,
                       .duration = 0.5));
}

/** Of two kinds; and between walls that shear, where no exponent is known from another one. */
TEST(the_estimate_of_mixtures_and_of_flows_is_what_they_ask_for)
{
    const hd_scene_def mixed = packed(
        with_second(short_run(300, HD_EXPONENTS_POSITIVE, 0), 0.35, 1.4, 2.0), 0.6);
    compare(mixed);
    for (int k = 0; k < 2; k++) {
        hd_scene_def many = scene_of_kind(k ? HD_SPHERES : HD_DISKS, 20000, 0.5, 1.0);
        many.equilibration = many.warmup = 0.0;
        many.report_interval = many.duration = 0.5;
        many.exponents = HD_EXPONENTS_NONE;
        compare(packed(with_second(many, 0.35, 1.4, 2.0), 0.4));
    }
    compare(scene_from(short_run(200, HD_EXPONENTS_ALL, 0), .boundary[1] = HD_SHEARING,
                       .shear_b = 3.0));
    compare(scene_from(short_run(2000, 60, 0), .warmup = 10.0, .boundary[1] = HD_SHEARING,
                       .shear_b = 3.0));
}

static hd_scene_def short_dumbbells(int count, int exponents, double warmup, double duration)
{
    const double edge = sqrt(count / 0.6);
    hd_scene_def def = dumbbells_in_box(count, edge, edge, 0.25, 0.0, 0, 1);
    def.equilibration = 0.1;
    def.warmup = warmup;
    def.report_interval = def.duration = duration;
    def.exponents = exponents;
    def.threads = 2;
    return def;
}

TEST(the_estimate_of_dumbbells_is_what_they_ask_for)
{
    compare(short_dumbbells(300, HD_EXPONENTS_POSITIVE, 3.0, 3.0));
    compare(short_dumbbells(20000, 1, 4.0, 2.0));
    compare(short_dumbbells(20000, HD_EXPONENTS_NONE, 0.0, 0.5));
}

static hd_scene_def short_softs(int dimension, int potential, int count, int exponents,
                                double warmup)
{
    const double density = dimension == 2 ? 0.7 : 0.6;
    hd_scene_def def = soft_box(dimension, potential, HD_PEFRL, 0.004, count,
                                pow(count / density, 1.0 / dimension));
    def.own[HD_SOFT_ENERGY].real = 2.0;
    def.exponents = exponents;
    def.equilibration = 0.5;
    def.warmup = warmup;
    def.report_interval = def.duration = 0.5;
    def.threads = 2;
    return def;
}

/** Whatever they are, and where there is room for more entries, as there are so many vectors. */
TEST(the_estimate_of_soft_particles_is_what_they_ask_for)
{
    static const double warmup[HD_POTENTIALS] = {
        [HD_POWER] = 8.0, [HD_WCA] = 8.0, [HD_LENNARD_JONES] = 2.0};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < HD_POTENTIALS; k++) {
            compare(short_softs(dimension, k, 100, k == HD_LENNARD_JONES ? 50 : 197, warmup[k]));
            compare(short_softs(dimension, k, 300, 10, 0.5 * warmup[k]));
            compare(short_softs(dimension, k, 2000, HD_EXPONENTS_NONE, 0.0));
        }
    compare(short_softs(2, HD_WCA, 400, HD_EXPONENTS_POSITIVE, 4.0));
}

/** A second state, for the choice of the time step; and a record with maps. */
TEST(the_estimate_of_particles_by_their_forces_is_what_they_ask_for)
{
    hd_scene_def scene = scene_from(hd_scene_def_of(&of_rotors), .number = 20000, .duration = 1.0,
                                    .exponents = HD_EXPONENTS_NONE, .equilibration = 0.0);
    compare(scene);
    scene.number = 40; /* two entries a kick */
    void *state, *maps;
    hd_record *record;
    CHECK_OK(of_rotors.create(&state, &scene));
    const size_t before = ledger_now().live;
    CHECK_OK(hd_record_create(&record, of_rotors.entry));
    CHECK_OK(of_rotors.maps_create(&maps, &scene));
    CHECK_OK(of_rotors.advance(state, record, 300.0));
    CHECK_OK(of_rotors.maps_fill(maps, record, 0.0, 300.0));
    const double count = (double)hd_record_count(record);
    CHECK_CLOSE(count, 300.0 * of_rotors.record_rate(&scene), 8.0); /* but for a part of a step */
    CHECK_WITHIN(of_rotors.record_bytes(count) / (double)(ledger_now().live - before), 0.93, 1.07);
    of_rotors.maps_free(maps);
    of_rotors.free(state);
    hd_record_free(record);
}

/** Of each field: its values at the disks, and some numbers of each vector; none of each other
 * field.
 */
TEST(fields_take_no_more_the_more_there_are)
{
    double of_one[2];
    for (int k = 0; k < 2; k++) {
        hd_scene_def scene = short_run(100, 60, HD_OBSERVE_STEPS);
        scene.max_mode_number = k == 0 ? 3 : 8;
        ledger_reset_peak();
        MADE(hd_modes, modes, &scene, 60, 1);
        of_one[k] = (double)ledger_now().peak / hd_fields_columns(hd_modes_fields(modes));
    }
    assert_true(of_one[1] <= of_one[0]);
}

/** Beside what the observables have: positions and momenta, of two directions each. */
TEST(a_state_is_counted_for_modes)
{
    const hd_scene_def bare = short_run(50, 10, 0), seen = short_run(50, 10, HD_OBSERVE_MODES);
    const double parts = hd_modes_row.bytes(&seen, 1) + hd_steps_row.bytes(&seen, 1);
    CHECK_CLOSE(hd_memory_needed(&seen, 1, 1) - hd_memory_needed(&bare, 1, 1),
                parts + 4.0 * 50.0 * sizeof(double), 1e-6);
}

TEST(what_is_too_much_is_said)
{
    char line[256] = "";
    const hd_memory_limit room = {8e9, "machine", 1};
    const hd_scene_def large = short_run(20000, HD_EXPONENTS_POSITIVE, HD_OBSERVE_ALL & 31);
    int exponents = 0, disks = 0;
    assert_int_equal(hd_memory_check(&large, room, line, sizeof line), HD_NO_MEMORY);
    assert_true(strncmp(line, "out of memory: number = 20000 with 39997 exponents need 5", 56) ==
                0);
    assert_non_null(strstr(line, "there are 8 GB (machine)"));
    const char *fits = strstr(line, "exponents = ");
    assert_non_null(fits);
    assert_int_equal(sscanf(fits, "exponents = %d would fit, or number = %d", &exponents, &disks),
                     2);
    assert_true(exponents > 100 && exponents % 100 == 0); /* two digits: it is an estimate */
    hd_scene_def one = scene_from(large, .exponents = exponents);
    CHECK_OK(hd_memory_check(&one, room, NULL, 0));
    assert_true(hd_memory_needed(&one, 2, 1) > 0.9 * room.bytes * 0.9);
    one = large;
    one.number = disks;
    CHECK_OK(hd_memory_check(&one, room, NULL, 0));
    assert_true(hd_memory_needed(&one, 2, 1) > 0.7 * room.bytes);
}

TEST(nothing_fits_where_there_is_nothing)
{
    char line[256] = "";
    const hd_scene_def small = short_run(50, 10, 0);
    assert_int_equal(
        hd_memory_check(&small, (hd_memory_limit){1.0, "machine", 1}, line, sizeof line),
        HD_NO_MEMORY);
    assert_non_null(strstr(line, "not even one particle would fit"));
}

TEST(fields_are_counted)
{
    const hd_scene_def scene = short_run(300, 10, HD_OBSERVE_FIELDS);
    const size_t before = ledger_now().live;
    MADE(hd_pmode, pmode, &scene);
    const double asked = (double)(ledger_now().live - before);
    const double stated = hd_fields_row.bytes(&scene, 1);
    CHECK_WITHIN(stated / asked, 0.93, 1.07);
}

/** Of windows, once their rings have gone round. */
TEST(windows_take_what_is_counted)
{
    static const struct {
        int disks, exponents;
        double window;
    } cases[] = {{4, 1, 300.0}, {30, HD_EXPONENTS_ALL, 20.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double window = cases[k].window;
        hd_scene_def def = short_run(cases[k].disks, cases[k].exponents, HD_OBSERVE_COVARIANT);
        def.density = 0.4;
        def.covariant_window = def.covariant_transient = def.warmup = window;
        def.covariant_sampling = 1.0;
        def.duration = 4.0 * window;
        OWNED(hd_run) *run = until(created(def), HD_AVERAGING);
        const size_t before = ledger_now().live;
        finish(run);
        const double counted = hd_covariant_bytes(hd_run_covariant(run));
        print_message("%.4g MB counted\n", 1e-6 * counted);
        CHECK_WITHIN((double)(ledger_now().live - before) / counted, 0.97, 1.02);
        assert_int_equal(hd_covariant_read(hd_run_covariant(run)).lost, 0);
    }
}

TEST(nothing_is_allocated_for_it)
{
    hd_run *run;
    char line[256] = "";
    const hd_scene_def large = short_run(1000000, HD_EXPONENTS_POSITIVE, HD_OBSERVE_ALL & 31);
    const size_t before = ledger_now().allocations;
    assert_int_equal(hd_run_create(&run, &large, line, sizeof line), HD_NO_MEMORY);
    assert_null(run);
    assert_int_equal(ledger_now().allocations, before);
    assert_non_null(strstr(line, "would fit"));
}

TEST(there_is_some)
{
    const hd_memory_limit room = hd_memory_available();
    CHECK_WITHIN(room.bytes, 1e7, 1e15);
}
