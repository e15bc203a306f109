/** Events of dumbbells against a slow twin, which looks at all gaps at close times, and finds where
 * one closes, or was least, between two of them. */
#include "dumbbell.h"
#include "dynamics/dumbbells/bump.h"

enum { FACINGS = 4000 };

/** Between two looks: no gap has two extrema there. */
static const double LOOK = 1e-3;
/** Times of one event by both ways: roundings over the rate at which the gap closes, and of grazing
 * ones their root. */
static const double TIME_CLOSE = 1e-9, GRAZE = 1e-6;

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
static double first_contact(facing *first, const hd_scene_def *def, const molecules *s, double end)
{
    facing all[FACINGS];
    const double bond = def->own[0].real;
    const int count = facings_of(all, FACINGS, def, s, 1.0 + bond + 20.0 * end);
    double earliest = INFINITY;
    for (int k = 0; k < count; k++)
        for (double h = 0.0; h < end; h += LOOK) {
            const double to = fmin(h + LOOK, end);
            double t = to;
            if (!(gap_then(NULL, def, s, &all[k], to) < 0)) {
                if (!(rate_then(def, s, &all[k], h) < 0 && rate_then(def, s, &all[k], to) > 0))
                    continue;
                t = least_between(def, s, &all[k], h, to);
                if (!(gap_then(NULL, def, s, &all[k], t) < 0)) continue;
            }
            t = crossing(def, s, &all[k], h, t);
            if (rate_then(def, s, &all[k], t) < -GRAZE && t < earliest) {
                earliest = t;
                *first = all[k];
            }
            break;
        }
    return earliest;
}

static bool is_of(const hd_bump *bump, const facing *f)
{
    return (int)bump->i == f->i && (int)bump->j == (f->j < 0 ? -1 : f->j);
}

/** Goes on from the core's state; each event of the twin is the core's, and the states agree. */
static int slice_agrees(hd_trajectory *tr, hd_record *log, const hd_scene_def *def, double length)
{
    molecules s = molecules_now(tr);
    double at = 0.0;
    size_t events = 0;
    hd_record_clear(log);
    CHECK_OK(hd_trajectory_extend(tr, log, hd_trajectory_time(tr) + length));
    for (;;) {
        facing f;
        const double t = first_contact(&f, def, &s, length - at);
        if (!(t < INFINITY)) break;
        assert_true(events < hd_record_count(log));
        const hd_bump *bump = hd_record_entry(log, events++);
        CHECK_CLOSE(at + t, bump->t, TIME_CLOSE);
        assert_true(is_of(bump, &f));
        fly_for(&s, def->disks, t);
        bounce(def, &s, &f);
        at += t;
    }
    assert_int_equal(events, hd_record_count(log));
    fly_for(&s, def->disks, length - at);
    const molecules now = molecules_now(tr);
    for (int k = 0; k < D * def->disks; k++) CHECK_CLOSE(now.p[k], s.p[k], 1e-6);
    CHECK_WITHIN(least_gap_of(def, &now), -1e-12, 10.0);
    return (int)events;
}

static int run_agrees(hd_scene_def def, double time)
{
    const double length = 0.02;
    int events = 0;
    MADE(hd_trajectory, tr, &def);
    OWNED(hd_record) *log = new_dumbbell_log(&def);
    while (hd_trajectory_time(tr) < time) events += slice_agrees(tr, log, &def, length);
    CHECK_CLOSE(hd_trajectory_kinetic_energy(tr), def.disks, 1e-12 * def.disks);
    return events;
}

TEST(events_are_those_of_a_twin_that_looks_at_all_gaps)
{
    static const double bonds[] = {0.05, 0.25, 0.5, 0.8};
    int events = 0;
    for (int walls = 0; walls < 4; walls++)
        for (int k = 0; k < 4; k++) {
            const double edge = (walls ? 2.5 : 1.9) + bonds[k]; /* several images of each */
            events += run_agrees(dumbbells_in_box(2 + (walls + k) % (k < 2 ? 5 : 3), edge * 1.5,
                                                  edge, bonds[k], k % 2 ? -1.0 : 0.0, walls, 7),
                                 second_tier() ? 80.0 : 8.0);
        }
    print_message("%d events\n", events);
    CHECK_WITHIN(events, second_tier() ? 10000 : 1000, 1e6);
}
