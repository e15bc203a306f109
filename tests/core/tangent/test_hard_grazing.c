/** Grazing collisions, one at a time: |p.n| from a tenth of |p| down to 1e-14 of it. The tangent
 * map stays finite and symplectic; the trajectory takes the contact or passes, the same each time,
 * and ends. */
#include "prepared.h"
#include "tangent.h"
#include "twin.h"

static const double LX = 8.0, LY = 8.0;
static const double TAKEN_MIN = 1e-14; /* least |p.n| / |p| */
enum { ANGLES = HD_SANITIZED ? 8 : 24 };

/** |p.n| / |p| = impact, disk 1 at `angle` of disk 0 and passing at that side. */
typedef struct graze {
    double impact, angle, side;
} graze;

static void unit_vectors(const graze *g, double n[2], double t[2])
{
    n[0] = cos(g->angle);
    n[1] = sin(g->angle);
    t[0] = -g->side * n[1];
    t[1] = g->side * n[0];
}

/** Momentum of disk 1 relative to disk 0, of length `speed`. */
static void relative_momentum(const graze *g, double speed, double p[2])
{
    double n[2], t[2];
    unit_vectors(g, n, t);
    for (int d = 0; d < 2; d++)
        p[d] = speed * (sqrt(1.0 - g->impact * g->impact) * t[d] - g->impact * n[d]);
}

/** The largest entries of S are p_t^2 / b n n^T, to and from both disks: |S| = 2 p_t^2 / |b|, and
 * flights of a quarter stretch it further by less than (1 + 1/4)^2. */
static void check_event(const graze *g, double speed)
{
    double n[2], t[2], p[2];
    unit_vectors(g, n, t);
    relative_momentum(g, speed, p);
    hd_event event = {.t = 0.25, .i = 0, .j = 1, .n = {n[0], n[1]}, .p = {p[0], p[1]}};
    const hd_event_log log = {.event = &event, .count = 1, .capacity = 1, .duration = 0.5};
    const double size = check_symplectic_map(&log, 2), stretch = 2.0 * speed / g->impact;
    if (g->impact < 1e-3) assert_true(size > 0.9 * stretch && size < 1.6 * stretch);
}

TEST(maps_stay_finite_and_symplectic)
{
    const double speed[] = {1e-3, 1.0, 30.0};
    for (double impact = 0.1; impact > 0.5 * TAKEN_MIN; impact *= 0.1)
        for (int a = 0; a < ANGLES; a++)
            for (int k = 0; k < 6; k++) {
                const graze g = {impact, 2.0 * PI * a / ANGLES, k % 2 ? -1.0 : 1.0};
                check_event(&g, speed[k / 2]);
            }
}

/** The largest entry of S is 2 p_t^2 / (R b), from dq along n to dp along n. */
static void check_round_wall(double impact, double angle, double radius)
{
    const double n[2] = {cos(angle), sin(angle)}, pt = sqrt(1.0 - impact * impact);
    hd_event event = {.t = 0.25,
                      .j = HD_WALL_ROUND,
                      .n = {radius * n[0], radius * n[1]},
                      .p = {impact * n[0] - pt * n[1], impact * n[1] + pt * n[0]}};
    const hd_event_log log = {.event = &event, .count = 1, .capacity = 1, .duration = 0.5};
    const double size = check_symplectic_map(&log, 1), stretch = 2.0 / (radius * impact);
    if (stretch > 1e3) assert_true(size > 0.9 * stretch && size < 1.6 * stretch);
}

TEST(a_round_wall_is_finite_and_symplectic)
{
    for (double impact = 1.0; impact > 0.5 * TAKEN_MIN; impact *= 0.1)
        for (int a = 0; a < ANGLES; a++)
            for (double radius = 0.01; radius < 200.0; radius *= 10.0)
                check_round_wall(impact, 2.0 * PI * a / ANGLES, radius);
}

static const double DRIFT[2] = {0.3125, -0.1875}; /* of both disks */

/** Two disks that meet at `wait`, drifting together `drift` times DRIFT. */
static void prepare(const graze *g, double wait, double drift, double q[4], double p[4])
{
    double n[2], t[2], r[2];
    unit_vectors(g, n, t);
    relative_momentum(g, 1.0, r);
    for (int d = 0; d < 2; d++) {
        p[d] = drift * DRIFT[d] - 0.5 * r[d];
        p[2 + d] = drift * DRIFT[d] + 0.5 * r[d];
        q[d] = 4.0 - 0.5 * n[d] + 0.5 * wait * r[d];
        q[2 + d] = q[d] + n[d] - wait * r[d];
    }
}

/** A contact that is not taken is one within rounding: while they pass, the two are no deeper in
 * each other than rounding of their coordinates, 4 eps (L + |p| t). That decides below |p.n| =
 * 1e-7: the depth is its square, halved. */
static void check_passage(const hd_scene_def *def, const double *q, const double *p, double meets,
                          double impact)
{
    enum { LOOKS = 32 };
    const double speed = fmax(hypot(p[0], p[1]), hypot(p[2], p[3]));
    const double reach = LX + speed * (meets + 2.0 * impact);
    OWNED(hd_trajectory) *tr = started(def, q, p);
    for (int k = 0; k <= LOOKS; k++) {
        const double t = meets + 2.0 * impact * (2.0 * k / LOOKS - 1.0);
        if (t < 0) continue;
        CHECK_OK(hd_trajectory_extend(tr, NULL, t));
        CHECK_CLOSE(hd_trajectory_overlap(tr), 0.0, 4.0 * DBL_EPSILON * reach);
    }
    assert_true(hd_trajectory_collisions(tr) <= 1);
    if (impact > 2e-7) assert_true(hd_trajectory_collisions(tr) == 1);
    assert_true(void_contacts(tr) <= 2);
}

/** Taken or passed, the same whatever queue and cells do: as the twin has it, which cuts the time
 * elsewhere. */
static void check_encounter(const graze *g, double wait, double drift)
{
    const hd_scene_def def = scene_in_box(2, LX, LY, P, P, 1);
    double q[4], p[4];
    prepare(g, wait, drift, q, p);
    check_passage(&def, q, p, wait, g->impact);
    if (drift <= 1.0)
        twin_compare(started(&def, q, p), &def, 3); /* else it tries a thousand images */
    OWNED(hd_event_log) *log = log_of(&def, q, p, wait + 0.5);
    if (log->count > 0) check_symplectic_map(log, 2);
}

/** From far, and touching from the start; below 1e-15 rounding alone decides. */
TEST(contacts_are_taken_or_passed_for_good)
{
    const double wait[] = {0.0, 1.25}, drift[] = {0.0, 1.0, 1000.0};
    for (double impact = 0.1; impact > 1e-19; impact *= 0.1)
        for (int a = 0; a < ANGLES; a++)
            for (int k = 0; k < 2 * 2 * 3; k++) {
                const graze g = {impact, 2.0 * PI * (a + 0.1) / ANGLES, k % 2 ? -1.0 : 1.0};
                check_encounter(&g, wait[k / 2 % 2], drift[k / 4]);
            }
}

/** The same for disks that overlap as deep as a start may: the root in their contact is then no
 * rounding. */
TEST(a_deep_pair_does_not_meet_for_ever)
{
    const hd_scene_def def = scene_in_box(2, LX, LY, P, P, 1);
    for (double impact = 1e-3; impact > 1e-22; impact *= 0.1)
        for (int a = 0; a < 8 * ANGLES; a++) {
            const graze g = {impact, 2.0 * PI * a / (8 * ANGLES), a % 2 ? -1.0 : 1.0};
            double q[4], p[4], n[2], t[2];
            prepare(&g, 0.0, 1.0, q, p);
            unit_vectors(&g, n, t);
            for (int d = 0; d < 2; d++) q[2 + d] -= 0.9e-9 * n[d];
            OWNED(hd_trajectory) *tr = started(&def, q, p);
            CHECK_OK(hd_trajectory_extend(tr, NULL, 0.5));
            assert_true(hd_trajectory_collisions(tr) <= 1 && void_contacts(tr) <= 2);
            CHECK_CLOSE(hd_trajectory_overlap(tr), 0.0, 0.0);
        }
}
