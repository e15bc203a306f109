/** Disks and spheres of two kinds: what they start from, what they conserve, and whether tangent
 * vectors go as trajectories that start nearby. */
#include "draw.h"
#include "prepared.h"
#include "hdlyap/dynamics_test.h"

/* ---- kinds --------------------------------------------------------------------------------- */

TEST(kinds_follow_from_parameters)
{
    hd_kind kind[HD_KINDS_MAX];
    const hd_scene_def box = box_of(10, 0.3, 1.0, 1.0, 0, 1);
    assert_int_equal(hd_scene_kinds(&box, kind), 1);
    assert_true(kind[0].number == 10 && kind[0].diameter == 1 && kind[0].mass == 1);
    hd_scene_def def = with_second(box, 0.36, 1.5, 3.0);
    assert_int_equal(hd_scene_kinds(&def, kind), 2);
    assert_true(kind[0].number == 6 && kind[0].diameter == 1 && kind[0].mass == 1);
    assert_true(kind[1].number == 4 && kind[1].diameter == 1.5 && kind[1].mass == 3);
    CHECK_CLOSE(hd_scene_root_mass(&def, 5), 1.0, 0.0);
    CHECK_CLOSE(hd_scene_root_mass(&def, 6), sqrt(3.0), 0.0);
    const double volume = DIM == 2 ? PI / 4.0 : PI / 6.0;
    CHECK_CLOSE(hd_scene_packing(&def), 0.3 * volume * (0.6 + 0.4 * pow(1.5, DIM)),
                8 * DBL_EPSILON);
    def = with_second(box, 1.0, 0.5, 3.0);
    assert_int_equal(hd_scene_kinds(&def, kind), 1);
    assert_true(kind[0].number == 10 && kind[0].diameter == 0.5 && kind[0].mass == 3);
}

/** Masses are those for which rounded shares keep the energy. */
TEST(masses_are_as_asked)
{
    for (double mass = 0.001; mass <= 1000.0; mass *= 1.3) {
        hd_kind kind[HD_KINDS_MAX];
        const hd_scene_def def = with_second(box_of(10, 0.3, 1.0, 1.0, 0, 1), 0.5, 1.0, mass);
        (void)hd_scene_kinds(&def, kind);
        /* the larger share is a quotient below 2 by a rounded sum: 1.5 eps; so is the smaller one,
         * which is at least 2e-3 */
        CHECK_CLOSE(kind[1].mass, mass, mass * (1.5 * DBL_EPSILON / 2e-3 + 4 * DBL_EPSILON));
    }
}

/* ---- starts -------------------------------------------------------------------------------- */

static void expect_start(hd_scene_def def)
{
    char message[300] = "";
    if (hd_scene_check(&def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    OWNED(hd_trajectory) *tr = trajectory_of(def);
    const hd_invariants now = hd_trajectory_examined(tr);
    assert_true(now.overlap <= now.overlap_rounding);
    CHECK_CLOSE(now.kinetic_energy, def.number, 1e-14 * def.number);
    for (int d = 0; d < DIM; d++)
        if (hd_scene_boundary(&def, d) == HD_PERIODIC)
            CHECK_CLOSE(now.momentum[d], 0.0, 1e-12 * def.number);
}

/** As dense as fluids are, for each set of walls, and ratios of sizes and masses at their ends. */
TEST(there_is_a_start_at_densities_of_fluids)
{
    const double densest = DIM == 2 ? 0.8 : 0.6;
    expect_start(packed(with_second(box_of(780, 0.1, 0.867, 1.0, 0, 1), 0.35, 1.4, 1.0), densest));
    for (int walls = 0; walls < WALL_SETS; walls++) {
        const hd_scene_def box = box_of(200, 0.05, 0.867, 1.0, walls, 1);
        expect_start(packed(with_second(box, 0.5, 1.4, 1.0), 0.8 * densest));
        expect_start(packed(with_second(box, 0.05, 4.0, 1000.0), 0.7 * densest));
        expect_start(packed(with_second(box, 0.5, 0.2, 0.001), 0.5 * densest));
    }
    /* more particles than disks of one kind could be */
    expect_start(
        packed(with_second(box_of(400, 0.1, 0.9, 1.0, 0, 1), 0.9, 0.2, 1.0), 0.6 * densest));
    expect_start(
        packed(with_second(box_of(400, 0.1, 0.9, 1.0, 0, 1), 1.0, 0.2, 1.0), 0.6 * densest));
    if (DIM == 2)
        expect_start(
            packed(with_second(scene(.container = HD_CIRCLE, .number = 200), 0.5, 1.4, 1.0), 0.75));
}

/** Which particle is where is drawn by the seed, and the same for the same seed. */
TEST(the_seed_draws_places)
{
    enum { COUNT = 50 };
    double q[3][DIM * COUNT];
    for (int k = 0; k < 3; k++) {
        const hd_scene_def def = with_second(box_of(COUNT, 0.2, 1.0, 1.0, 0, k == 2 ? 2 : 1), 0.5,
                                             1.2, 2.0);
        OWNED(hd_trajectory) *tr = trajectory_of(def);
        hd_trajectory_state(tr, q[k], NULL);
    }
    int moved = 0;
    for (int i = 0; i < COUNT; i++) moved += q[0][DIM * i] != q[2][DIM * i];
    assert_memory_equal(q[0], q[1], sizeof q[0]);
    assert_true(moved > COUNT / 2);
}

static void expect_refused(hd_scene_def def, const char *line)
{
    char message[300] = "";
    assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
    if (!strstr(message, line)) assert_string_equal(message, line);
}

TEST(what_has_no_start_is_refused_by_name)
{
    const hd_scene_def box = box_of(100, 0.1, 0.9, 1.0, 0, 1);
    const hd_scene_def two = with_second(box, 0.35, 1.4, 1.0);
    expect_refused(packed(two, DIM == 2 ? 0.81 : 0.61), "density = ");
    expect_refused(packed(two, DIM == 2 ? 0.81 : 0.61),
                   DIM == 2 ? "packing fraction 0.8, with second_fraction = 0.35"
                            : "packing fraction 0.6, with second_fraction = 0.35");
    expect_refused(with_second(box, 1.1, 1.4, 1.0), "second_fraction = 1.1: must be from 0 to 1");
    /* kinds that rounding leaves without a particle; half a particle is one */
    static const char one_kind[] =
        ": must be 0, 1, or leave at least one particle of each kind with "
        "number = 100";
    expect_refused(with_second(box, 0.00499, 1.4, 1.0), one_kind);
    expect_refused(with_second(box, 0.996, 1.4, 1.0), one_kind);
    expect_refused(with_second(box, DBL_TRUE_MIN, 1.0, 1.0), one_kind);
    static const double taken[] = {0.0, 0.005, 0.994, 1.0};
    for (int k = 0; k < 4; k++) {
        const hd_scene_def def = with_second(box, taken[k], 1.4, 1.0);
        CHECK_OK(hd_scene_check(&def, NULL, 0));
    }
    expect_refused(with_second(box, 0.5, 5.1, 1.0), "second_diameter = 5.1: must be from 0.2 to 5");
    expect_refused(with_second(box, 0.5, 1.4, 0.0), "second_mass = 0: must be from 0.001 to 1000");
    expect_refused(with_second(box_of(4, 0.16, 1.0, 1.0, 0, 1), 0.5, 5.0, 1.0),
                   "must be above the disk diameter 5");
    /* less than the densest packing, but not in this box */
    expect_refused(
        packed(with_second(box_of(3, 0.1, 1.0, 1.0, 0, 1), 1.0, 2.0, 1.0), DIM == 2 ? 0.79 : 0.59),
        "no start is found");
    /* those that come to touch all around, so that gaps shrink by many tens at each stop */
    if (DIM > 2) {
        expect_refused(with_second(box_of(7, 41.0, 3.0, 1.0, 2, 56), 1.0, 0.3, 1.0),
                       "no start is found");
        return;
    }
    hd_scene_def round = box_of(2, 0.1, 1.0, 1.0, 0, 1);
    round.container = HD_CIRCLE;
    round.aspect = hd_scene_def_default().aspect;
    for (int k = 0; k < 2; k++)
        expect_refused(packed(with_second(round, 0.5, k == 0 ? 0.3 : 3.0, 1.0), 0.79),
                       "container = circle: no start is found");
}

/** Between walls hardly further apart than a particle, which it meets so often that no stop may
 * last as long as between walls that are far: in less than a second, or refused. */
TEST(starts_in_narrow_channels)
{
    for (double gap = 1e-1; gap > 3e-9; gap *= 0.1) {
        const double width = 1.3 + gap, length = 20.0;
        hd_scene_def def = box_of(4, 4.0 / (width * length * (DIM == 3 ? width : 1.0)),
                                  width / length, width / length, ALL_WALLS - 1, 1);
        char message[300] = "";
        def = with_second(def, 0.5, 1.3, 1.0);
        if (hd_scene_check(&def, message, sizeof message) != HD_OK)
            expect_refused(def, "no start is found");
        else
            expect_start(def);
        if (gap > 1e-3) assert_string_equal(message, "");
    }
}

/** What is read from an archive has no start, which takes long to find, or is nowhere. */
TEST(a_resumed_one_needs_no_start)
{
    const hd_scene_def def = packed(with_second(box_of(1000, 0.1, 0.9, 1.0, 0, 1), 0.5, 2.0, 3.0),
                                    DIM == 2 ? 0.87 : 0.7);
    hd_trajectory *none = NULL;
    OWNED(hd_trajectory) *tr = NULL;
    assert_int_equal(hd_trajectory_create(&none, &def), HD_REFUSED);
    CHECK_OK(hd_trajectory_create_empty(&tr, &def));
    assert_int_equal(hard_in(tr)->motion.count, 1000);
    assert_int_equal(hard_in(tr)->motion.disk[499].size, 0);
    assert_int_equal(hard_in(tr)->motion.disk[500].size, 1);
}

/* ---- motion -------------------------------------------------------------------------------- */

/** Energy and momenta through many collisions of masses as different as can be. */
TEST(energy_and_momenta_stay)
{
    for (int walls = 0; walls < WALL_SETS + (DIM == 2); walls++) {
        hd_scene_def def = box_of(20, 0.1, 0.9, 1.1, walls % WALL_SETS, 3);
        if (walls == WALL_SETS) def = scene(.container = HD_CIRCLE, .number = 20, .seed = 3);
        const double packing = DIM == 2 ? 0.5 : 0.3;
        for (double mass = 0.001; mass < 2000; mass *= 100.0) {
            const hd_scene_def two = packed(with_second(def, 0.4, 1.7, mass), packing);
            OWNED(hd_trajectory) *tr = trajectory_of(two);
            CHECK_OK(trajectory_to(tr, NULL, DIM == 2 ? 500.0 : 50.0));
            const hd_invariants now = hd_trajectory_examined(tr);
            assert_true(fabs(now.energy_error) <= now.energy_rounding);
            assert_true(now.overlap <= now.overlap_rounding);
            for (int d = 0; d < DIM; d++)
                if (hd_scene_boundary(&two, d) == HD_PERIODIC)
                    CHECK_CLOSE(now.momentum[d], 0.0, 1e-9);
            if (walls == WALL_SETS) CHECK_CLOSE(now.angular_momentum, 0.0, 1e-9);
        }
    }
}

/** Two that touch, and approach by so many roundings of their momenta: they are reflected if these
 * are more than eight, of whatever size they are; otherwise they are pushed apart, once. */
static void expect_graze(double diameter, double mass, double roundings)
{
    const hd_scene_def def = with_second(box_of(2, DIM == 2 ? 1e-3 : 3e-5, 1.0, 1.0, 0, 1), 0.5,
                                         diameter, mass);
    const double touching = 0.5 + 0.5 * diameter, small = 0.5 * roundings * DBL_EPSILON;
    double q[2 * DIM] = {9.0, 9.0}, p[2 * DIM] = {small, 0.5};
    q[DIM] = 9.0 +
             touching * (1.0 - 1e-10); /* overlapping, or rounding decides whether they meet */
    q[DIM + 1] = 9.0;
    p[DIM] = -small * sqrt(mass), p[DIM + 1] = -0.5 * sqrt(mass);
    OWNED(hd_record) *log = new_log();
    OWNED(hd_trajectory) *tr = started(&def, q, p);
    CHECK_OK(trajectory_to(tr, log, 0.01));
    assert_int_equal(log->count, roundings > 8);
    assert_int_equal(void_contacts(tr), roundings < 8);
}

TEST(grazes_are_those_of_momenta_whatever_the_size)
{
    for (double diameter = 0.2; diameter < 5.0; diameter *= 1.9)
        for (double mass = 0.001; mass < 2000.0; mass *= 10.0) {
            expect_graze(diameter, mass, 6.0);
            expect_graze(diameter, mass, 10.0);
        }
}

/** A light particle among heavy ones at rest, which are 1000 times as heavy: a Lorentz gas. In a
 * collision the heavy one gets at most 2/1001 of the relative speed, v to first order: after k of
 * them it is as fast as 2 k v / 1001; the light one loses that twice, and 2 v / 1001. */
TEST(heavy_ones_hardly_move)
{
    enum { COUNT = 9 };
    const hd_scene_def def = packed(
        with_second(box_of(COUNT, 0.1, 1.0, 1.0, 0, 5), 8.0 / COUNT, 1.5, 1000.0), 0.3);
    double q[DIM * COUNT], p[DIM * COUNT] = {1.0, 0.3}, speed[COUNT] = {0};
    OWNED(hd_trajectory) *first = trajectory_of(def);
    hd_trajectory_state(first, q, NULL);
    OWNED(hd_trajectory) *tr = started(&def, q, p);
    const double begin = hypot(1.0, 0.3);
    CHECK_OK(trajectory_to(tr, NULL, DIM == 2 ? 14.0 : 60.0));
    hd_trajectory_state(tr, NULL, p);
    const hd_totals totals = hd_trajectory_totals(tr);
    assert_true(totals.collisions >= 5 && totals.collisions_of[0] == 0);
    for (int k = 0; k < DIM * COUNT; k++)
        speed[k / DIM] = hypot(speed[k / DIM], p[k] / hd_scene_root_mass(&def, k / DIM));
    const double hits = (double)totals.collisions, heavy = begin * 2.0 * hits / 1001.0;
    CHECK_WITHIN(speed[0], begin * (1.0 - 2.0 * hits * (1.0 + hits) / 1001.0), begin);
    CHECK_WITHIN(speed[0], 0.8 * begin, begin); /* of equal masses it would be a third of this */
    for (int i = 1; i < COUNT; i++) CHECK_WITHIN(speed[i], 0.0, heavy);
}

/** What a record says of kinds, and of the force on walls. */
typedef struct seen {
    uint64_t of[3];
    double force[DIM]; /**< momentum given to both walls of a direction, or to the round one */
} seen;

static void look(seen *s, const hd_scene_def *def, const hd_event *e)
{
    hd_kind kind[HD_KINDS_MAX];
    (void)hd_scene_kinds(def, kind);
    const int of_i = e->i >= kind[0].number;
    if (e->j >= 0) {
        s->of[of_i + (e->j >= kind[0].number)]++;
        return;
    }
    double along = 0.0, square = 0.0;
    for (int d = 0; d < DIM; d++) along += e->n[d] * e->p[d], square += e->n[d] * e->n[d];
    const int wall = e->j == HD_WALL_ROUND ? 0 : -1 - (int)e->j;
    s->force[wall] += 2.0 * kind[of_i].mass * fabs(along) / sqrt(square);
}

/** Twice the kinetic energy and the virial of the collisions are that of the walls, as if they met
 * centres at the mean radius: up to sum m q.v at both ends, over the time [T19]. */
static void expect_virial(hd_scene_def def)
{
    const double time = 2000.0;
    OWNED(hd_trajectory) *tr = trajectory_of(def);
    OWNED(hd_record) *log = new_log();
    seen s = {.of = {0}};
    CHECK_OK(trajectory_to(tr, log, time));
    for (size_t k = 0; k < log->count; k++) look(&s, &def, &events_in(log)[k]);
    const hd_totals totals = hd_trajectory_totals(tr);
    double box[3], inside = 2.0 * def.number * time, outside = 0.0, size = 0.0, mass = 0.0,
                   diameter = 0.0;
    hd_kind kind[HD_KINDS_MAX];
    for (int k = hd_scene_kinds(&def, kind) - 1; k >= 0; k--)
        diameter += kind[k].diameter * kind[k].number / def.number;
    hd_scene_box(&def, box);
    for (int d = 0; d < DIM; d++) {
        inside += totals.virial[d];
        size = hypot(size, 0.5 * box[d]);
        outside += 0.5 * s.force[d] * (box[d] - diameter);
    }
    for (int i = 0; i < def.number; i++) mass += pow(hd_scene_root_mass(&def, i), 2.0);
    /* |sum m q.v| <= size sqrt(mass sum m v^2), at both ends */
    CHECK_CLOSE(inside, outside, 2.0 * size * sqrt(mass * 2.0 * def.number));
    assert_true(2.0 * size * sqrt(mass * 2.0 * def.number) < 0.02 * inside);
    for (int k = 0; k < 3; k++) assert_int_equal(totals.collisions_of[k], s.of[k]);
    assert_int_equal(totals.collisions_of[0] + totals.collisions_of[1] + totals.collisions_of[2],
                     totals.collisions);
}

TEST(the_virial_is_that_of_the_walls)
{
    const double packing = DIM == 2 ? 0.4 : 0.25;
    expect_virial(
        packed(with_second(box_of(8, 0.1, 0.8, 0.9, ALL_WALLS, 3), 0.5, 1.6, 4.0), packing));
    expect_virial(
        packed(with_second(box_of(8, 0.1, 0.8, 0.9, ALL_WALLS, 4), 0.5, 0.5, 0.3), packing));
    if (DIM == 3) return;
    expect_virial(
        packed(with_second(scene(.container = HD_CIRCLE, .number = 8, .seed = 3), 0.5, 1.6, 4.0),
               packing));
}

/* ---- tangent maps -------------------------------------------------------------------------- */

/** hd_dynamics_test holds them against shadow trajectories, S^T J S and null vectors, in times that
 * follow from the expected time between collisions, up to which differences of trajectories are
 * small. Fast ones are small here, so that both kinds collide as often as is expected of the first.
 */
TEST(tangent_maps_go_as_trajectories)
{
    const int scenes = second_tier() ? 400 : 40;
    hd_random random = hd_random_seeded(12, 0);
    int tried = 0;
    for (int k = 0; k < scenes / (DIM - 1); k++) {
        const int walls = one_of(&random, WALL_SETS + 1), number = 2 + one_of(&random, 8);
        hd_scene_def def = box_of(number, 0.05, log_uniform(&random, 0.6, 1.6), 1.0,
                                  walls % WALL_SETS, (uint64_t)k);
        if (DIM == 2 && walls == WALL_SETS)
            def = scene(.container = HD_CIRCLE, .number = number, .seed = (uint64_t)k);
        const double mass = log_uniform(&random, 0.2, 5.0),
                     diameter = pow(mass, 0.5 / (DIM - 1)) * (0.7 + 0.3 * uniform(&random));
        def = packed(with_second(def, uniform(&random), diameter, mass),
                     0.05 + 0.35 / (DIM - 1) * uniform(&random));
        char message[300] = "";
        if (hd_scene_check(&def, NULL, 0) != HD_OK) continue;
        const hd_status status = hd_dynamics_test(hd_dynamics_of(&def), &def, message,
                                                  sizeof message);
        assert_string_equal(message, "");
        CHECK_OK(status);
        tried++;
    }
    assert_true(tried >= scenes / (DIM - 1) / 2);
}
