/** A dynamics of one's own: a chain by hand, by what is known of it, and rows made of it.
 */
#include "chain.h"

/* ---- maps ---------------------------------------------------------------------------------- */

typedef struct carried {
    hd_record *record;
    hd_frame *frame;
    chain *start, *end;
} carried;

static chain *copy_of(const chain *c)
{
    const size_t size = sizeof *c + 2 * (size_t)c->count * sizeof(double);
    chain *copy = malloc(size);
    memcpy(copy, c, size);
    return copy;
}

/** The unit vectors, carried for 5 time units in two parts. */
static carried carry_unit_vectors(double beta)
{
    const hd_scene_def scene = chain_of(N, beta, HD_EXPONENTS_ALL);
    carried c;
    void *state;
    CHECK_OK(create(&state, &scene));
    CHECK_OK(advance(state, NULL, 30.0));
    c.start = copy_of(state);
    CHECK_OK(hd_record_create(&c.record, of_chain.entry));
    CHECK_OK(advance(state, c.record, 31.003)); /* steps do not care for the ends of advances */
    CHECK_OK(advance(state, c.record, 35.0));
    c.end = state;
    CHECK_OK(hd_frame_create(&c.frame, &scene, ROWS, 1, 1));
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < ROWS; col++)
            hd_frame_data(c.frame)[row * hd_frame_stride(c.frame) + col] = row == col;
    CHECK_OK(hd_frame_replay(c.frame, c.record, 0.0, 1.7));
    CHECK_OK(hd_frame_replay(c.frame, c.record, 1.7, hd_record_duration(c.record)));
    return c;
}

static void carried_free(carried *c)
{
    hd_record_free(c->record);
    hd_frame_free(c->frame);
    free(c->start);
    free(c->end);
}

static double entry_of(const carried *c, int row, int col)
{
    return hd_frame_read(c->frame)[row * hd_frame_stride(c->frame) + col];
}

/** Each entry, against two shadow trajectories: their difference is right to eps^2, and to rounding
 * over eps. */
TEST(maps_are_those_of_shadow_trajectories)
{
    const double off = 1e-6, tolerance = 3e-7;
    HELD(carried) c = carry_unit_vectors(10.0);
    for (int col = 0; col < ROWS; col++) {
        HEAP chain *plus = copy_of(c.start);
        HEAP chain *minus = copy_of(c.start);
        plus->x[col] += off;
        minus->x[col] -= off;
        CHECK_OK(advance(plus, NULL, 35.0));
        CHECK_OK(advance(minus, NULL, 35.0));
        for (int row = 0; row < ROWS; row++)
            CHECK_CLOSE(entry_of(&c, row, col), (plus->x[row] - minus->x[row]) / (2.0 * off),
                        tolerance);
    }
}

/** S^T J S = J, to rounding in 250 steps. */
TEST(maps_are_symplectic)
{
    HELD(carried) c = carry_unit_vectors(10.0);
    for (int a = 0; a < ROWS; a++)
        for (int b = 0; b < ROWS; b++) {
            double sum = 0.0;
            for (int i = 0; i < N; i++)
                sum += entry_of(&c, 2 * i, a) * entry_of(&c, 2 * i + 1, b) -
                       entry_of(&c, 2 * i + 1, a) * entry_of(&c, 2 * i, b);
            CHECK_CLOSE(sum,
                        a % 2 == 0 && b == a + 1   ? 1.0
                        : a % 2 == 1 && b == a - 1 ? -1.0
                                                   : 0.0,
                        1e-11);
        }
}

/** Of whichever frame it is: the run's own, that of a trial of threads, that of covariant vectors.
 */
static void carry_of_scene(const void *maps, double *block, int width)
{
    const hd_scene_def *scene = ((const hd_record_slice *)maps)->scene;
    of_chain.carry(maps, block, scene->own[BETA].real == 10.0 && scene->number == N ? width : 0);
}

/** Nothing is carried in another scene. */
TEST(maps_know_their_scene)
{
    hd_dynamics row = of_chain;
    row.carry = carry_of_scene;
    hd_scene_def scene = with_covariant(HD_EXPONENTS_ALL);
    OWNED(hd_run) *usual = finished(scene);
    scene.dynamics = &row;
    OWNED(hd_run) *run = finished(scene);
    check_same_exponents(run, usual, 0.0);
    const hd_covariant_results found = hd_covariant_read(hd_run_covariant(run)),
                               before = hd_covariant_read(hd_run_covariant(usual));
    for (int col = 0; col < ROWS; col++)
        CHECK_CLOSE(hd_spectrum_exponent(found.spectrum, col),
                    hd_spectrum_exponent(before.spectrum, col), 0.0);
}

/* ---- exponents ----------------------------------------------------------------------------- */

static double exponent_of(const hd_run *run, int col)
{
    return hd_spectrum_exponent(hd_run_spectrum(run), col);
}

/** Of N - 2 pairs and four zeros; half of the vectors say as much as all, and all of them have it
 * without being told. Zeros fall with ln t / t; Verlet's energy, as h^2. */
TEST(exponents_are_in_pairs_with_four_zeros)
{
    hd_scene_def scene = chain_of(N, 10.0, HD_EXPONENTS_ALL);
    assert_int_equal(hd_scene_counts(&scene).zero, 4);
    assert_int_equal(hd_scene_counts(&scene).positive, N - 2);
    assert_int_equal(hd_scene_counts(&scene).carried, N);
    scene.duration = 4000.0;
    OWNED(hd_run) *half = finished(scene);
    scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
    OWNED(hd_run) *whole = finished(scene);
    for (int col = 0; col < N; col++) {
        const double error = hypot(hd_spectrum_std_error(hd_run_spectrum(half), col), 2e-3);
        CHECK_CLOSE(exponent_of(whole, col), exponent_of(half, col), 4.0 * error);
        CHECK_CLOSE(exponent_of(whole, col) + exponent_of(whole, ROWS - 1 - col), 0.0,
                    col < N - 2 ? hd_run_cost(whole).error_bound : 1e-4);
    }
    for (int col = N - 2; col < N + 2; col++) CHECK_CLOSE(exponent_of(half, col), 0.0, 3e-3);
    CHECK_CLOSE(exponent_of(half, 0), 0.626, 0.03);
    CHECK_CLOSE(exponent_of(half, N - 3), 0.137, 0.03);
}

TEST(without_beta_all_exponents_vanish)
{
    hd_scene_def scene = chain_of(N, 0.0, HD_EXPONENTS_ALL);
    assert_int_equal(hd_scene_counts(&scene).zero, ROWS);
    scene.duration = 2000.0;
    OWNED(hd_run) *run = finished(scene);
    for (int col = 0; col < ROWS; col++) CHECK_CLOSE(exponent_of(run, col), 0.0, 4e-3);
}

/** Of what may focus, frames of many vectors are factored in the whole norm, too. */
TEST(only_what_disperses_is_factored_in_dq_alone)
{
    for (int disperses = 0; disperses < 2; disperses++) {
        hd_dynamics row = of_chain;
        row.dispersing = disperses;
        const hd_scene_def scene = scene_from(chain_of(80, 10.0, HD_EXPONENTS_POSITIVE),
                                              .dynamics = &row, .equilibration = 1.0,
                                              .warmup = 10.0, .interval = 0.5);
        OWNED(hd_run) *run = until(created(scene), HD_AVERAGING);
        assert_true(run->cost.orthonormalisations > 10);
        assert_int_equal(hd_carrier_norm(&run->carrier, false),
                         disperses ? HD_NORM_DQ : HD_NORM_FULL);
    }
}

/** The record says when; whoever stops the run, the steps are the same bits. */
TEST(steps_do_not_depend_on_who_watches)
{
    const hd_scene_def scene = chain_of(N, 10.0, 2);
    double q[2][N], p[2][N];
    for (int watched = 0; watched < 2; watched++) {
        OWNED(hd_run) *run = created(scene);
        if (watched) hd_run_watch(run, 0.37);
        finish(run);
        hd_trajectory_state(hd_run_trajectory(run), q[watched], p[watched]);
    }
    assert_memory_equal(q[0], q[1], sizeof q[0]);
    assert_memory_equal(p[0], p[1], sizeof p[0]);
}

/* ---- covariant vectors, widths ------------------------------------------------------------- */

TEST(covariant_vectors_grow_with_the_exponents)
{
    const int kinds[] = {HD_EXPONENTS_ALL, HD_EXPONENTS_ALL_INDEPENDENT};
    for (int k = 0; k < 2; k++) {
        hd_scene_def scene = with_covariant(kinds[k]);
        scene.duration = 1000.0;
        OWNED(hd_run) *run = finished(scene);
        const hd_covariant_results found = hd_covariant_read(hd_run_covariant(run));
        assert_true(found.windows > 5);
        assert_null(found.of_frame);
        CHECK_WITHIN(found.start_mismatch.stable, 0.0, 0.01);
        for (int col = 0; col < ROWS; col++) {
            CHECK_CLOSE(hd_spectrum_exponent(found.spectrum, col), exponent_of(run, col), 0.02);
            CHECK_WITHIN(found.widths[col], 1.0 / N, 1.0);
            CHECK_WITHIN(hd_localization_widths(hd_run_localization(run))[col], 1.0 / N, 1.0);
        }
        assert_true(found.null < 0); /* the row tells of no vector */
    }
}

static int known = 2;

/** A shift of all and their momentum stay as they are: the covariant centre holds both. */
static int null_of_chain(const hd_scene_def *scene, const double *q, const double *p,
                         double *column)
{
    (void)q, (void)p;
    for (int k = 0; k < known * scene->number; k++) {
        column[k] = k % 2 == 0;
        column[2 * scene->number + k] = k % 2 == 1;
    }
    return known;
}

/** A row may know none of it. */
TEST(the_centre_is_held_against_what_is_known_of_it)
{
    hd_dynamics row = of_chain;
    row.null_vectors = null_of_chain;
    hd_scene_def scene = with_covariant(HD_EXPONENTS_ALL);
    scene.dynamics = &row;
    for (known = 0; known <= 2; known += 2) {
        OWNED(hd_run) *run = finished(scene);
        const hd_covariant_results found = hd_covariant_read(hd_run_covariant(run));
        CHECK_WITHIN(found.null_most, found.null, 0.1); /* pi / 2 of vectors that are none of it */
        CHECK_WITHIN(found.null, known ? 0.0 : -1.0, known ? 0.1 : -1.0);
    }
}

/* ---- in a box ------------------------------------------------------------------------------ */

/** Disks as a row of one's own that leaves out all that it may. */
static hd_scene_def plain(const hd_scene_def *scene)
{
    hd_scene_def def = *scene;
    def.dynamics = NULL;
    return def;
}

static hd_status create_disks(void **state, const hd_scene_def *scene)
{
    const hd_scene_def def = plain(scene);
    return hd_disks_row.create(state, &def);
}

static double entries_of_disks(const hd_scene_def *scene)
{
    const hd_scene_def def = plain(scene);
    return hd_disks_row.record_rate(&def);
}

static double rate_of_disks(const hd_scene_def *scene)
{
    const hd_scene_def def = plain(scene);
    return hd_disks_row.collision_rate(&def);
}

static hd_dynamics disks_of_ones_own(void)
{
    hd_dynamics own = hd_disks_row;
    own.particles = "coins";
    own.create = create_disks;
    own.record_rate = entries_of_disks;
    own.collision_rate = rate_of_disks;
    own.check = NULL;
    own.fluid = NULL;
    own.totals = NULL;
    own.collides = false;
    own.examine = NULL;
    own.fingerprint = NULL;
    own.bytes = NULL;
    own.record_bytes = NULL;
    own.dispersing = false;
    return own;
}

TEST(a_row_with_a_box_has_modes)
{
    const hd_dynamics own = disks_of_ones_own();
    hd_scene_def scene = scene_from(hd_scene_def_of(&own), .number = 30, .density = 0.5,
                                    .aspect = 0.04, .equilibration = 20.0, .warmup = 100.0,
                                    .duration = 100.0, .threads = 1, .observe = HD_OBSERVE_STEPS);
    const hd_scene_def disks = plain(&scene);
    OWNED(hd_run) *run = finished(scene);
    OWNED(hd_run) *same = finished(disks);
    check_same_exponents(run, same, hd_run_cost(run).error_bound + hd_run_cost(same).error_bound);
    assert_int_equal(hd_steps_count(hd_run_steps(run)), hd_steps_count(hd_run_steps(same)));
    assert_true(hd_steps_count(hd_run_steps(run)) > 0);
    CHECK_CLOSE(hd_trajectory_examined(hd_run_trajectory(run)).kinetic_energy, 30.0, 1e-9);
    assert_false(hd_run_is_caged(run));
}

/* ---- what is refused ----------------------------------------------------------------------- */

#define REFUSED(line, ...)                                                                         \
    check_refused(scene_from(chain_of(N, 10.0, HD_EXPONENTS_ALL), __VA_ARGS__), line)
#define NO_BOX ": must not be given with particles = chain, which have no positions in a box"

TEST(what_needs_a_box_is_refused_by_name)
{
    REFUSED("observables = modes" NO_BOX, .observe = HD_OBSERVE_MODES);
    REFUSED("observables = gas" NO_BOX, .observe = HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION);
    REFUSED("observables = t_phases" NO_BOX, .observe = HD_OBSERVE_T_PHASES);
    REFUSED("density = 0.5" NO_BOX, .density = 0.5);
    REFUSED("aspect = 1" NO_BOX, .aspect = 1.0);
    REFUSED("container = circle" NO_BOX, .container = HD_CIRCLE);
    REFUSED("boundary_y = reflecting" NO_BOX, .boundary[1] = HD_REFLECTING);
    REFUSED("max_mode_number = 2" NO_BOX, .max_mode_number = 2);
    REFUSED("target = pressure 1%: must be without pressure: gas is not among the observables",
            .target = (hd_text){"pressure 1%"});
}

TEST(own_parameters_are_refused_like_others)
{
    REFUSED("beta = -1: must be from 0 to 1000", .own[BETA].real = -1.0);
    REFUSED("beta = nan: must be from 0 to 1000", .own[BETA].real = NAN);
    REFUSED("time_step = 0.5: must be from 1e-6 to 0.1", .own[STEP].real = 0.5);
    REFUSED("number = 2: must be 3 or more with particles = chain", .number = 2);
    REFUSED("exponents = 17: must be positive, all, all_independent, none or from 1 to 2 N = 16",
            .exponents = 17);
}

TEST(no_gas_without_pressure)
{
    const hd_dynamics own = disks_of_ones_own();
    check_refused(scene_from(hd_scene_def_of(&own), .observe = HD_OBSERVE_GAS),
                  "observables = gas: must not be given with particles = coins, whose pressure "
                  "cannot be measured");
}

/** Of each step; momenta lose so much of themselves. */
static const double LOST = 5e-4;

static void carry_with_friction(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    const double left = 1.0 - LOST;
    const spring *s = part->entry;
    for (size_t k = 0; k < part->count; k += N) {
        const hd_record_slice one = {s + k, N, part->begin, part->end, N, part->scene};
        of_chain.carry(&one, block, width);
        for (int row = 0; row < ROWS; row++)
            for (int col = 0; col < width && row % 2 == 1; col++) block[row * width + col] *= left;
    }
}

/** With friction S^T J S = (1 - LOST) J: pairs add up to its rate, and each vector is carried. */
TEST(what_needs_pairs_is_refused_without_them)
{
    hd_dynamics unpaired = of_chain;
    unpaired.symplectic = false;
    unpaired.carry = carry_with_friction;
    hd_scene_def scene = chain_of(N, 10.0, HD_EXPONENTS_ALL);
    scene.dynamics = &unpaired;
    scene.duration = 1000.0;
    assert_int_equal(hd_scene_counts(&scene).carried, ROWS);
    OWNED(hd_run) *run = finished(scene);
    for (int col = 0; col < N - 2; col++)
        CHECK_CLOSE(exponent_of(run, col) + exponent_of(run, ROWS - 1 - col),
                    log(1.0 - LOST) / scene.own[STEP].real, 1e-4); /* part of a step at the end */
    double positive = 0.0;
    for (int col = 0; col < ROWS; col++) positive += fmax(exponent_of(run, col), 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(hd_run_spectrum(run)).ks_entropy, positive, 1e-14);
    scene.exponents = HD_EXPONENTS_POSITIVE;
    check_refused(scene,
                  "exponents = positive: must be all, all_independent, none or from 1 to "
                  "16 with particles = chain, whose exponents are not in pairs of opposite sign");
}

/* ---- memory, trial ------------------------------------------------------------------------- */

TEST(what_it_takes_is_known_before)
{
    char message[256] = "";
    const hd_scene_def scene = chain_of(64, 10.0, HD_EXPONENTS_ALL);
    hd_estimate estimate;
    CHECK_OK(hd_estimate_run(&estimate, &scene, message, sizeof message));
    CHECK_WITHIN(estimate.seconds, 1e-7, 10.0);
    CHECK_WITHIN(hd_memory_needed(&scene, 1, 1), 64.0 * 128.0 * 16.0, 1e8);
    assert_int_equal(
        hd_memory_check(&scene, (hd_memory_limit){1e4, "machine", 1}, message, sizeof message),
        HD_NO_MEMORY);
    assert_int_equal(hd_waves(&scene, NULL, 0), 0);
    assert_int_equal(hd_steps_exponents_least(&scene), 0);
    for (int kind = HD_MODE_T; kind <= HD_MODE_LP; kind++)
        assert_true(hd_relation_open(&scene, (hd_mode_kind)kind) == INFINITY);
}
