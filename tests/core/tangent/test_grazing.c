/** Grazing collisions, one at a time: |p.n| from a tenth of |p| down to 1e-14 of it. The tangent
 * map stays finite and symplectic; the trajectory takes the contact or passes, the same each time,
 * and ends. Of disks and of spheres. */
#include "draw.h"
#include "prepared.h"
#include "tangent.h"
#include "twin.h"

static const double LENGTH = 8.0;
static const double TAKEN_MIN = 1e-14; /* least |p.n| / |p| */
enum { ANGLES = HD_SANITIZED ? 8 : 24 };

/** |p.n| / |p| = impact: disk 1 lies along n of disk 0 and passes along t. */
typedef struct graze {
    double impact, n[DIM], t[DIM];
} graze;

static graze graze_of(double impact, int direction)
{
    graze g = {.impact = impact};
    hd_random random = hd_random_seeded(2, (uint64_t)direction);
    draw_direction(&random, g.n);
    draw_across(&random, g.t, g.n);
    return g;
}

/** Momentum of disk 1 relative to disk 0, of length 1. */
static void relative_momentum(const graze *g, double p[DIM])
{
    for (int d = 0; d < DIM; d++)
        p[d] = sqrt(1.0 - g->impact * g->impact) * g->t[d] - g->impact * g->n[d];
}

/** The largest entry of S is 2 p_t^2 / (R b), from dq along n to dp along n. */
static void check_round_wall(double impact, double angle, double radius)
{
    const double n[2] = {cos(angle), sin(angle)}, pt = sqrt(1.0 - impact * impact);
    hd_event event = {.t = 0.25,
                      .j = HD_WALL_ROUND,
                      .n = {radius * n[0], radius * n[1]},
                      .p = {impact * n[0] - pt * n[1], impact * n[1] + pt * n[0]}};
    const hd_record log = record_of(&event, 1, 0.5);
    const double size = check_symplectic_map(&log, 1), stretch = 2.0 / (radius * impact);
    if (stretch > 1e3) assert_true(size > 0.9 * stretch && size < 1.6 * stretch);
}

TEST(a_round_wall_is_finite_and_symplectic)
{
    if (DIM == 3) skip();
    for (double impact = 1.0; impact > 0.5 * TAKEN_MIN; impact *= 0.1)
        for (int a = 0; a < ANGLES; a++)
            for (double radius = 0.01; radius < 200.0; radius *= 10.0)
                check_round_wall(impact, 2.0 * PI * a / ANGLES, radius);
}

static const double DRIFT[3] = {0.3125, -0.1875, 0.25}; /* of both disks */

/** Two disks that meet at `wait`, drifting together `drift` times DRIFT. */
static void prepare(const graze *g, double wait, double drift, double *q, double *p)
{
    double r[DIM];
    relative_momentum(g, r);
    for (int d = 0; d < DIM; d++) {
        p[d] = drift * DRIFT[d] - 0.5 * r[d];
        p[DIM + d] = drift * DRIFT[d] + 0.5 * r[d];
        q[d] = 4.0 - 0.5 * g->n[d] + 0.5 * wait * r[d];
        q[DIM + d] = q[d] + g->n[d] - wait * r[d];
    }
}

/** A contact that is not taken is one within rounding: while they pass, the two are no deeper in
 * each other than rounding of their coordinates, 4 eps (L + |p| t). That decides below |p.n| =
 * 1e-7: the depth is its square, halved. */
static void check_passage(const hd_scene_def *def, const double *q, const double *p, double meets,
                          double impact)
{
    enum { LOOKS = 32 };
    double square[2] = {0, 0};
    for (int k = 0; k < 2 * DIM; k++) square[k / DIM] += p[k] * p[k];
    const double speed = sqrt(fmax(square[0], square[1]));
    const double reach = LENGTH + speed * (meets + 2.0 * impact);
    OWNED(hd_trajectory) *tr = started(def, q, p);
    for (int k = 0; k <= LOOKS; k++) {
        const double t = meets + 2.0 * impact * (2.0 * k / LOOKS - 1.0);
        if (t < 0) continue;
        CHECK_OK(hd_trajectory_extend(tr, NULL, t));
        CHECK_CLOSE(hd_trajectory_examined(tr).overlap, 0.0, 4.0 * DBL_EPSILON * reach);
    }
    assert_true(hd_trajectory_totals(tr).collisions <= 1);
    if (impact > 2e-7) assert_true(hd_trajectory_totals(tr).collisions == 1);
    assert_true(void_contacts(tr) <= 2);
}

/** Taken or passed, the same whatever queue and cells do: as the twin has it, which cuts the time
 * elsewhere. */
static void check_encounter(const graze *g, double wait, double drift)
{
    const hd_scene_def def = box_with(2, LENGTH, LENGTH, LENGTH, 0, 1);
    double q[2 * DIM], p[2 * DIM];
    prepare(g, wait, drift, q, p);
    check_passage(&def, q, p, wait, g->impact);
    if (drift <= 1.0)
        twin_compare(started(&def, q, p), &def, 3); /* else it tries a thousand images */
    OWNED(hd_record) *log = log_of(&def, q, p, wait + 0.5);
    if (log->count > 0) check_symplectic_map(log, 2);
}

/** From far, and touching from the start; below 1e-15 rounding alone decides. */
TEST(contacts_are_taken_or_passed_for_good)
{
    const double wait[] = {0.0, 1.25}, drift[] = {0.0, 1.0, 1000.0};
    for (double impact = 0.1; impact > 1e-19; impact *= 0.1)
        for (int a = 0; a < 2 * ANGLES; a++)
            for (int k = 0; k < 2 * 3; k++) {
                const graze g = graze_of(impact, a);
                check_encounter(&g, wait[k % 2], drift[k / 2]);
            }
}

/** The same for disks that overlap as deep as a start may: the root in their contact is then no
 * rounding. */
TEST(a_deep_pair_does_not_meet_for_ever)
{
    const hd_scene_def def = box_with(2, LENGTH, LENGTH, LENGTH, 0, 1);
    for (double impact = 1e-3; impact > 1e-22; impact *= 0.1)
        for (int a = 0; a < 8 * ANGLES; a++) {
            const graze g = graze_of(impact, a);
            double q[2 * DIM], p[2 * DIM];
            prepare(&g, 0.0, 1.0, q, p);
            for (int d = 0; d < DIM; d++) q[DIM + d] -= 0.9e-9 * g.n[d];
            OWNED(hd_trajectory) *tr = started(&def, q, p);
            CHECK_OK(hd_trajectory_extend(tr, NULL, 0.5));
            assert_true(hd_trajectory_totals(tr).collisions <= 1 && void_contacts(tr) <= 2);
            CHECK_CLOSE(hd_trajectory_examined(tr).overlap, 0.0, 0.0);
        }
}
