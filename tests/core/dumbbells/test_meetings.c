/** Events of dumbbells against a slow twin, which looks at all gaps at close times, and finds where
 * one closes, or was least, between two of them. */
#include "create_from.h"
#include "dumbbell.h"
#include "dynamics/dumbbells/dumbbells.h"

enum { FACINGS = 4000, LOOKS = 20 }; /* in a slice; no gap has two extrema between two of them */

/** Of one after the other: what comes next is the core's state. Faster molecules take shorter ones,
 * and every time and speed below is by this one. */
static const double SLICE = 0.02;
/** Times of one event by both ways: roundings over the rate at which the gap closes. */
static const double TIME_CLOSE = 1e-9;
/** Rates that are no contact for sure, and what momenta of both ways differ by. */
static const double GRAZE = 1e-6, MOMENTA_CLOSE = 1e-6;

/** Where what is negative at `high` was not yet. */
static double crossing(const hd_scene_def *def, const molecules *s, const facing *f, double low,
                       double high)
{
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        *(gap_then(NULL, def, s, f, middle) > 0 ? &low : &high) = middle;
    }
    return high;
}

/** Time of the least gap, which closes at `low` and opens at `high`. */
static double least_between(const hd_scene_def *def, const molecules *s, const facing *f,
                            double low, double high)
{
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        *(rate_then(def, s, f, middle) < 0 ? &low : &high) = middle;
    }
    return high;
}

/** The first contact within (0, `end`], whose rate is not lost in rounding: INFINITY if none. */
static double first_contact(facing *first, const hd_scene_def *def, const molecules *s, double end,
                            double slice)
{
    facing all[FACINGS];
    const double look = slice / LOOKS, fast = SLICE / slice;
    const int count = facings_of(all, FACINGS, def, s, 1.0 + def->own[0].real + 20.0 * fast * end);
    double earliest = INFINITY;
    for (int k = 0; k < count; k++)
        for (double h = 0.0; h < end; h += look) {
            const double to = fmin(h + look, end);
            double t = to;
            if (!(gap_then(NULL, def, s, &all[k], to) < 0)) {
                if (!(rate_then(def, s, &all[k], h) < 0 && rate_then(def, s, &all[k], to) > 0))
                    continue;
                t = least_between(def, s, &all[k], h, to);
                if (!(gap_then(NULL, def, s, &all[k], t) < 0)) continue;
            }
            t = crossing(def, s, &all[k], h, t);
            if (rate_then(def, s, &all[k], t) < -GRAZE * fast && t < earliest) {
                earliest = t;
                *first = all[k];
            }
            break;
        }
    return earliest;
}

/** The same molecules, disks, and by the direction of the normal the same image or wall. */
static void check_is_of(const hd_bump *bump, const hd_scene_def *def, const molecules *s,
                        const facing *f)
{
    double w[2 * D];
    (void)gap_then(w, def, s, f, 0.0);
    assert_int_equal(bump->i, f->i);
    assert_int_equal(bump->j, f->j < 0 ? -1 : f->j);
    for (int d = 0; d < 2; d++)
        CHECK_CLOSE(f->j < 0 ? bump->n[d] : -bump->n[d], w[d], MOMENTA_CLOSE);
    for (int k = 0; k < (f->j < 0 ? 1 : 2); k++) {
        double arm[2];
        arm_then(arm, def, s, k == 0 ? f->i : f->j, f->disk[k], 0.0);
        CHECK_CLOSE(bump->along[k] * root_of(def), bump->n[0] * arm[0] + bump->n[1] * arm[1],
                    MOMENTA_CLOSE);
        CHECK_CLOSE(bump->across[k] * root_of(def), bump->n[1] * arm[0] - bump->n[0] * arm[1],
                    MOMENTA_CLOSE);
    }
}

/** What has been seen by the twin. */
typedef struct seen {
    int events;
    double least; /**< gap */
} seen;

/** Goes on from the core's state; each event of the twin is the core's, and the states agree. */
static void slice_agrees(seen *all, hd_trajectory *tr, hd_record *log, const hd_scene_def *def,
                         double slice)
{
    molecules s = molecules_now(tr);
    const double fast = SLICE / slice;
    double at = 0.0;
    size_t events = 0;
    hd_record_clear(log);
    CHECK_OK(hd_trajectory_extend(tr, log, hd_trajectory_time(tr) + slice));
    for (;;) {
        facing f;
        const double t = first_contact(&f, def, &s, slice - at, slice);
        if (!(t < INFINITY)) break;
        assert_true(events < hd_record_count(log));
        const hd_bump *bump = hd_record_entry(log, events++);
        CHECK_CLOSE(at + t, bump->t, TIME_CLOSE / fast);
        fly_for(&s, def->number, t);
        check_is_of(bump, def, &s, &f);
        bounce(def, &s, &f);
        at += t;
    }
    assert_int_equal(events, hd_record_count(log));
    fly_for(&s, def->number, slice - at);
    const molecules now = molecules_now(tr);
    for (int k = 0; k < D * def->number; k++) CHECK_CLOSE(now.p[k], s.p[k], MOMENTA_CLOSE * fast);
    all->least = fmin(all->least, least_gap_of(def, &now));
    all->events += (int)events;
}

/** From here on, for so many slices; energy and momentum stay. */
static void agrees(seen *all, hd_trajectory *tr, const hd_scene_def *def, int slices, double slice)
{
    const double energy = hd_trajectory_examined(tr).kinetic_energy;
    OWNED(hd_record) *log = new_dumbbell_log(def);
    for (int k = 0; k < slices; k++) slice_agrees(all, tr, log, def, slice);
    const hd_invariants now = hd_trajectory_examined(tr);
    CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, energy, energy * now.energy_rounding);
    for (int d = 0; d < 2; d++)
        if (def->boundary[d] == HD_PERIODIC)
            CHECK_CLOSE(now.momentum[d], 0.0, 1e-12 * def->number * sqrt(energy));
    CHECK_WITHIN(all->least, -1e-12, 10.0);
}

static void scene_agrees(seen *all, hd_scene_def def, int slices)
{
    MADE(hd_trajectory, tr, &def);
    agrees(all, tr, &def, slices, SLICE);
}

static void tell(const seen *all)
{
    print_message("%d events, smallest gap %.2g\n", all->events, all->least);
}

TEST(events_are_those_of_a_twin_that_looks_at_all_gaps)
{
    static const double bonds[] = {0.05, 0.25, 0.5, 0.8};
    seen all = {.least = INFINITY};
    for (int walls = 0; walls < 4; walls++)
        for (int k = 0; k < 4; k++) {
            const double edge = (walls ? 2.5 : 1.9) + bonds[k]; /* several images of each */
            scene_agrees(&all,
                         dumbbells_in_box(2 + (walls + k) % (k < 2 ? 5 : 3), edge * 1.5, edge,
                                          bonds[k], k % 2 ? -1.0 : 0.0, walls, 7),
                         second_tier() ? 4000 : 400);
        }
    tell(&all);
    CHECK_WITHIN(all.events, second_tier() ? 10000 : 1000, 1e6);
}

/* ---- hard cases, of all boundaries --------------------------------------------------------- */

TEST(shortest_and_longest_bonds_agree)
{
    seen all = {.least = INFINITY};
    for (int walls = 0; walls < 4; walls++)
        for (int points = 0; points < 2; points++) {
            const double inertia = points ? -1.0 : 0.0;
            scene_agrees(&all, dumbbells_in_box(5, 3.2, 2.7, 0.01, inertia, walls, 4), 150);
            scene_agrees(&all, dumbbells_in_box(4, 5.0, 4.5, 2.0, inertia, walls, 4), 150);
        }
    tell(&all);
    CHECK_WITHIN(all.events, 500, 1e6);
}

/** Just below the densest lattice. */
TEST(a_dense_crystal_agrees)
{
    seen all = {.least = INFINITY};
    for (int walls = 0; walls < 4; walls++) {
        hd_scene_def def = dumbbells_in_box(20, 5.7, 4.3, 0.25, 0.0, walls, 4);
        def.density = 0.98 * hd_dumbbell_density_max(&def);
        scene_agrees(&all, def, 20);
    }
    tell(&all);
    CHECK_WITHIN(all.events, 500, 1e6);
}

TEST(one_alone_between_walls_agrees)
{
    seen all = {.least = INFINITY};
    for (int walls = 1; walls < 4; walls++) {
        scene_agrees(&all, dumbbells_in_box(1, 2.2, 1.8, 0.5, 0.0, walls, 4), 400);
        scene_agrees(&all, dumbbells_in_box(1, 3.0, 2.0, 0.5, -1.0, walls, 4), 400);
    }
    scene_agrees(&all, dumbbells_in_box(1, 2.2, 1.1, 0.5, 0.0, 3, 4), 400); /* cannot turn round */
    tell(&all);
    CHECK_WITHIN(all.events, 100, 1e6);
}

static hd_trajectory *prepared(const hd_scene_def *def, const molecules *s)
{
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create_from(&tr, def, s->q, s->p));
    return tr;
}

/** Their momenta, too, are a million soon. */
TEST(spins_of_a_million_agree)
{
    const double fast = 1e6;
    seen all = {.least = INFINITY};
    for (int walls = 0; walls < 4; walls++) {
        const hd_scene_def def = dumbbells_in_box(2, 4.2, 2.4, 0.5, 0.0, walls, 4);
        const double spin = fast * root_of(&def), upright = 0.5 * PI * root_of(&def);
        const molecules s = {.q = {1.4, 1.2, upright, 2.65, 1.2, upright},
                             .p = {1.0, 0.2, spin, -1.0, -0.2, -spin}};
        OWNED(hd_trajectory) *tr = prepared(&def, &s);
        agrees(&all, tr, &def, 2000, SLICE / fast);
    }
    tell(&all);
    CHECK_WITHIN(all.events, 50, 1e6);
}

/** As late as time 250 what turns a million times as fast meets within 1e-9, as the time rounds;
 * that is what is stated, and more than of what does not turn. */
TEST(fast_spins_overlap_by_their_rounding)
{
    enum { EVENTS = 100 };
    const hd_scene_def def = dumbbells_in_box(2, 14.0, 6.0, 0.5, 0.0, 0, 4);
    const double slow = 0.006;
    molecules s = {.q = {3.0, 3.0, 0.0, 6.0, 3.0, 0.0}, .p = {slow, 0.0, 1e6 * root_of(&def)}};
    double deepest = 0.0;
    OWNED(hd_record) *log = new_dumbbell_log(&def);
    OWNED(hd_trajectory) *first = prepared(&def, &s), *tr = prepared(&def, &s);
    for (double t = 1.5 / slow; hd_record_count(log) < EVENTS; t += 0.01)
        CHECK_OK(hd_trajectory_extend(first, log, t));
    for (size_t k = 0; k < EVENTS; k++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, ((const hd_bump *)hd_record_entry(log, k))->t));
        const hd_invariants now = hd_trajectory_examined(tr);
        assert_true(now.overlap <= now.overlap_rounding);
        CHECK_CLOSE(now.overlap_max, fmax(1e-9, now.overlap_rounding), 0.0);
        deepest = fmax(deepest, now.overlap);
    }
    s.p[2] = 0.0;
    OWNED(hd_trajectory) *at_rest = prepared(&def, &s);
    print_message("%.2g\n", deepest);
    assert_true(deepest > 2.0 * hd_trajectory_examined(at_rest).overlap_rounding);
}

/** Two contacts at t = 0.5, the second as far as the first has left some approach, in the order of
 * the record; then nothing. Momenta are those of two mirrors, one after the other. */
static void at_once(const hd_scene_def *def, const molecules *start, const facing both[2],
                    int contacts)
{
    OWNED(hd_record) *log = new_dumbbell_log(def);
    OWNED(hd_trajectory) *tr = prepared(def, start);
    molecules s = *start;
    CHECK_OK(hd_trajectory_extend(tr, log, 0.9));
    assert_int_equal(hd_record_count(log), contacts);
    fly_for(&s, def->number, 0.5);
    for (int k = 0; k < contacts; k++) {
        const hd_bump *bump = hd_record_entry(log, (size_t)k);
        double arm[2];
        arm_then(arm, def, &s, both[0].i, both[0].disk[0], 0.0);
        const double there = bump->n[1] * arm[0] - bump->n[0] * arm[1];
        const facing *f = &both[there * bump->across[0] < 0];
        CHECK_CLOSE(bump->t, 0.5, 1e-14);
        check_is_of(bump, def, &s, f);
        bounce(def, &s, f);
    }
    const molecules now = molecules_now(tr);
    for (int k = 0; k < D * def->number; k++) CHECK_CLOSE(now.p[k], s.p[k], 1e-14);
    if (def->own[1].real < 0) /* of points one does not feel the other */
        for (int k = 0; k < D * def->number; k++) CHECK_CLOSE(now.p[k], -start->p[k], 1e-14);
}

/** Flat against each other, or against a wall. The first contact takes all approach from the second
 * if 3 arm^2 is below the inertia. */
TEST(both_disks_of_a_molecule_meet_at_once)
{
    static const double inertias[] = {0.0, -1.0, 3.0};
    for (int walls = 0; walls < 4; walls++)
        for (int k = 0; k < 3; k++) {
            hd_scene_def def = dumbbells_in_box(2, 6.0, 6.0, 0.8, inertias[k], walls, 4);
            const double upright = 0.5 * PI * root_of(&def);
            const molecules s = {.q = {2.0, 3.0, upright, 4.0, 3.0, upright},
                                 .p = {1.0, 0.0, 0.0, -1.0, 0.0, 0.0}};
            at_once(&def, &s, (facing[]){{0, 1, {0, 0}, {0, 0}}, {0, 1, {0, 0}, {1, 1}}},
                    k == 2 ? 1 : 2);
        }
    for (int wall = 0; wall < 4; wall++)
        for (int k = 0; k < 3; k++) {
            const hd_scene_def def = dumbbells_in_box(1, 6.0, 6.0, 0.8, inertias[k], 3, 4);
            const int d = wall % 2, far = wall / 2;
            molecules s = {.q = {3.0, 3.0, d == 0 ? 0.5 * PI * root_of(&def) : 0.0}};
            s.q[d] = far ? 5.0 : 1.0;
            s.p[d] = far ? 1.0 : -1.0;
            at_once(&def, &s,
                    (facing[]){{0, -1 - wall, {0, 0}, {0, 0}}, {0, -1 - wall, {0, 0}, {1, 0}}},
                    k == 2 ? 1 : 2);
        }
}

/** The first contact since `start` is that one, at `t`, and nothing came after it. */
static void met_once(const hd_trajectory *tr, const hd_record *log, const hd_scene_def *def,
                     const molecules *start, const facing *f, double t, double close)
{
    const hd_bump *bump = hd_record_entry(log, 0);
    molecules s = *start;
    assert_int_equal(hd_record_count(log), 1);
    CHECK_CLOSE(bump->t, t, close);
    fly_for(&s, def->number, bump->t);
    check_is_of(bump, def, &s, f);
    bounce(def, &s, f);
    const molecules now = molecules_now(tr);
    for (int c = 0; c < D * def->number; c++) CHECK_CLOSE(now.p[c], s.p[c], close);
}

/** A tip passes by a hair, k 1e-13, or meets by as much, at 0.5 + asin(sine). */
static void grazes(const hd_scene_def *def, const molecules *start, const facing *f, int k,
                   double sine)
{
    OWNED(hd_record) *log = new_dumbbell_log(def);
    OWNED(hd_trajectory) *tr = prepared(def, start);
    CHECK_OK(hd_trajectory_extend(tr, log, 4.0));
    if (k > 0) assert_int_equal(hd_record_count(log), 0);
    if (k < 0) /* 1e-15 over a rate of 3e-7 or more */
        met_once(tr, log, def, start, f, 0.5 + asin(sine), 1e-8);
}

/** Tips of bonds of 1 that turn once in 2 pi, from half a radian before they point at each other or
 * at a wall. */
TEST(grazing_at_arms_is_told_from_passing)
{
    for (int k = -8; k <= 8; k++) {
        for (int walls = 0; walls < 4; walls++) {
            const hd_scene_def def = dumbbells_in_box(2, 8.0, 8.0, 1.0, 0.0, walls, 4);
            const double apart = 2.0 + k * 1e-13, root = root_of(&def);
            const molecules s = {.q = {3.0, 3.0, -0.5 * root, 3.0, 3.0 + apart, -0.5 * root},
                                 .p = {0.0, 0.0, root, 0.0, 0.0, root}};
            grazes(&def, &s, &(facing){0, 1, {0, 0}, {1, 0}}, k, 0.5 * apart);
        }
        for (int wall = 0; wall < 4; wall++) {
            const hd_scene_def def = dumbbells_in_box(1, 8.0, 8.0, 1.0, 0.0, 3, 4);
            const double away = 1.0 + k * 1e-13, root = root_of(&def),
                         there = PI * (wall / 2 ? 0.0 : 1.0) + 0.5 * PI * (wall % 2);
            molecules s = {.q = {4.0, 4.0, (there - 0.5 - 0.5 * PI) * root}, .p = {0.0, 0.0, root}};
            s.q[wall % 2] = wall / 2 ? 8.0 - away : away;
            grazes(&def, &s, &(facing){0, -1 - wall, {0, 0}, {1, 0}}, k, 2.0 * away - 1.0);
        }
    }
}

/** The first gap that closes is this one, open at `low` and closed at `high`. */
static void meets(const hd_scene_def *def, const molecules *start, const facing *f, double low,
                  double high)
{
    OWNED(hd_record) *log = new_dumbbell_log(def);
    OWNED(hd_trajectory) *tr = prepared(def, start);
    CHECK_OK(hd_trajectory_extend(tr, log, high));
    met_once(tr, log, def, start, f, crossing(def, start, f, low, high), TIME_CLOSE);
}

/** A disk that touches another from within a bond of 2 leaves it at a small rate, and the turn
 * brings the other one after it, with almost all of the bend that the search expects. */
TEST(what_opens_slowly_is_met_again)
{
    const double phi = 0.3, c = cos(phi), s = sin(phi);
    for (int walls = 0; walls < 4; walls++)
        for (double rate = 1e-4; rate < 0.2; rate *= 10.0) {
            const hd_scene_def def = dumbbells_in_box(2, 8.0, 8.0, 2.0, 0.0, walls, 4);
            const double root = root_of(&def);
            const molecules start = {.q = {3.0, 3.0, 0.0, 4.0 - c, 4.0 + s, 0.5 * PI * root},
                                     .p = {0.0, 0.0, root, -rate * c, 1.0 + rate * s, 0.0}};
            meets(&def, &start, &(facing){0, 1, {0, 0}, {1, 0}}, rate / c, 3.0 * rate / c);
        }
}

/** Tips that part slower than they turn meet just before the circles around both molecules do. */
TEST(the_end_of_a_passage_is_searched)
{
    const double passage = 2.8;
    for (int walls = 0; walls < 4; walls++)
        for (double v = 0.01; v > 1e-4; v *= 0.25) {
            const hd_scene_def def = dumbbells_in_box(2, 8.0, 8.0, 1.0, 0.0, walls, 4);
            const double root = root_of(&def), turned = passage * root;
            const molecules start = {.q = {3.0, 3.0, -turned, 5.0 - v * passage, 3.0, turned},
                                     .p = {0.0, 0.0, root, v, 0.0, -root}};
            meets(&def, &start, &(facing){0, 1, {0, 0}, {1, 0}}, passage - 3.0 * v, passage - v);
        }
}
