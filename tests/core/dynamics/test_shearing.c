/** Walls that shear: the rule against its formula in long numbers, the tangent map against what it
 * does to phase space, events against those of the twin, and the sums of the flow against sums over
 * the events. */
#include "draw.h"
#include "hdlyap/dynamics_test.h"
#include "prepared.h"
#include "scene/container.h"
#include "scene/ends.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "tangent.h"
#include "twin.h"

static hd_scene_def sheared(int disks, double density, int across, double b)
{
    hd_scene_def def = scene(.number = disks, .density = density, .aspect = across == 1 ? 1.3 : 0.8,
                             .exponents = HD_EXPONENTS_ALL, .shear_b = b);
    def.boundary[across] = HD_SHEARING;
    return def;
}

/* ---- rule ---------------------------------------------------------------------------------- */

static const double B[] = {0.01, 0.3, 1.0, 10.0, 1e3, 1e6};
enum { BS = sizeof B / sizeof *B };

/** What a wall does to a velocity at the angle phi to it, whose supplement is chi. */
typedef struct formula {
    long double psi, slope, contraction;
} formula;

static formula formula_of(long double phi, long double b)
{
    const long double pi = acosl(-1.0L), root = sqrtl((pi + b) * (pi + b) - phi * (phi + 2.0L * b));
    const long double psi = phi * (phi + 2.0L * b) / (pi + b + root), slope = (phi + b) / root;
    return (formula){psi, slope, slope * sinl(psi) / sinl(phi)};
}

static const hd_ends *wall(void) { return hd_ends_of(HD_SHEARING); }

/** Of walls across d, at the high end or at the low one, in the plane that x and y exchanged. */
static void velocity_at(double p[2], double speed, double phi, int d, bool high)
{
    p[1 - d] = (high ? 1.0 : -1.0) * speed * cos(phi);
    p[d] = (high ? 1.0 : -1.0) * speed * sin(phi);
}

static void check_rule(double phi, double b, double speed, int d, bool high)
{
    const hd_scene_def def = sheared(6, 0.3, d, b);
    double p[2], before[2], told[2];
    velocity_at(p, speed, phi, d, high);
    memcpy(before, p, sizeof before);
    const double side = high ? 1.0 : -1.0;
    /* the angle that the rounded components have */
    const formula want = formula_of(atan2l(side * p[d], side * p[1 - d]), b);
    const double contraction = wall()->meet(&def, p, told, d);
    /* a dozen roundings of numbers of the order 1, in the angle and in its sine and cosine */
    const double rounding = 40.0 * DBL_EPSILON, sine = (double)sinl(want.psi);
    CHECK_CLOSE(p[1 - d], side * speed * (double)cosl(want.psi), rounding * speed);
    CHECK_CLOSE(p[d], -side * speed * sine, rounding * speed);
    CHECK_CLOSE(hypot(p[0], p[1]), speed, 4.0 * DBL_EPSILON * speed);
    CHECK_CLOSE(contraction, (double)want.contraction, 64.0 * rounding * (double)want.contraction);
    assert_true(side * p[d] < 0); /* it leaves */
    assert_null(wall()->fault(told));
    CHECK_CLOSE(hypot(told[0], told[1]), (double)want.slope, rounding * (double)want.slope);
    double back[2] = {-p[0], -p[1]}; /* the rule is reversible in time */
    (void)wall()->meet(&def, back, told, d);
    const double blown = fmax(1.0, 1.0 / (double)want.slope);
    CHECK_CLOSE(back[0], -before[0], 4.0 * rounding * blown * speed);
    CHECK_CLOSE(back[1], -before[1], 4.0 * rounding * blown * speed);
}

TEST(the_rule_is_its_formula)
{
    for (int k = 0; k < BS; k++)
        for (int a = 1; a < 64; a++)
            for (int d = 0; d < 2; d++) {
                check_rule(PI * a / 64.0, B[k], 1.0, d, true);
                check_rule(PI * a / 64.0, B[k], 3.7, d, false);
            }
}

/** A disk that grazes a wall leaves it, at an angle that is known to rounding of itself. */
TEST(grazes_leave_the_wall)
{
    for (int k = 0; k < BS; k++)
        for (double graze = 1e-14; graze < 0.1; graze *= 10.0)
            for (int end = 0; end < 2; end++) {
                const hd_scene_def def = sheared(6, 0.3, 1, B[k]);
                double p[2] = {end == 0 ? 1.0 : -1.0, graze}, told[2];
                const long double pi = acosl(-1.0L), phi = atan2l(p[1], p[0]), b = B[k];
                const long double root = sqrtl((pi + b) * (pi + b) - phi * (phi + 2.0L * b)),
                                  chi = atan2l(graze, 1.0L);
                const long double off = end == 0 ? phi * (phi + 2.0L * b) / (pi + b + root)
                                                 : chi * (2.0L * (pi + b) - chi) / (root + b);
                (void)wall()->meet(&def, p, told, 1);
                CHECK_CLOSE(p[1], -(double)sinl(off) * hypot(1.0, graze),
                            40.0 * DBL_EPSILON * (double)sinl(off));
            }
}

/** Over a million walls the energy stays what it is but for a random walk; of speeds of all sizes,
 * as a number whose root is near 1 is always rounded to the same side. */
TEST(speeds_do_not_drift)
{
    const hd_scene_def def = sheared(6, 0.3, 1, 10.0);
    hd_random random = hd_random_seeded(3, 0);
    const int many = 1000000;
    long double sum = 0.0L;
    for (int k = 0; k < many; k++) {
        double p[2], told[2];
        draw_direction(&random, p);
        const double speed = 0.5 + uniform(&random);
        p[0] *= speed, p[1] = fabs(speed * p[1]);
        const long double before = (long double)p[0] * p[0] + (long double)p[1] * p[1];
        (void)wall()->meet(&def, p, told, 1);
        const long double after = (long double)p[0] * p[0] + (long double)p[1] * p[1];
        sum += after / before - 1.0L;
    }
    CHECK_CLOSE((double)sum, 0.0, 4.0 * sqrt(many) * DBL_EPSILON);
}

/* ---- tangent map --------------------------------------------------------------------------- */

static double determinant(double m[4][4])
{
    double all = 1.0;
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int r = k + 1; r < 4; r++) pivot = fabs(m[r][k]) > fabs(m[pivot][k]) ? r : pivot;
        for (int c = 0; c < 4; c++) {
            const double kept = m[k][c];
            m[k][c] = m[pivot][c], m[pivot][c] = kept;
        }
        all *= pivot == k ? m[k][k] : -m[k][k];
        for (int r = k + 1; r < 4; r++) {
            const double part = m[r][k] / m[k][k];
            for (int c = 0; c < 4; c++) m[r][c] -= part * m[k][c];
        }
    }
    return all;
}

/** The volume that the map of an event carries is what the rule has told; and the flow (p, 0) and
 * the speeds (0, p) are carried to those of after it. */
static void check_map(double phi, double b, int d, bool high)
{
    const hd_scene_def def = sheared(1, 0.3, d, b);
    hd_event event = {.t = 0.25, .i = 0, .j = HD_WALL_RULED(HD_SHEARING, d)};
    double p[2], m[4][4], flow[2][4];
    velocity_at(event.p, 1.4, phi, d, high);
    memcpy(p, event.p, sizeof p);
    const double contraction = wall()->meet(&def, p, event.n, d);
    const hd_record log = record_of(&event, 1, 0.5);
    assert_null(hd_events_fault(&log, &def));
    MADE(hd_frame, frame, &def, 4, 1, 1);
    frame_identity(frame);
    CHECK_OK(hd_frame_replay(frame, &log, 0.0, 0.5));
    for (int row = 0; row < 4; row++) {
        flow[0][row] = flow[1][row] = 0.0;
        for (int col = 0; col < 4; col++) m[row][col] = *frame_entry(frame, row, col);
        for (int c = 0; c < 2; c++) {
            flow[0][row] += m[row][c] * event.p[c];
            flow[1][row] += m[row][2 + c] * event.p[c];
        }
    }
    const double rounding = 1e-13 * fmax(1.0, 1.0 / sin(phi));
    for (int c = 0; c < 2; c++) {
        CHECK_CLOSE(flow[0][c], p[c], rounding);
        CHECK_CLOSE(flow[0][2 + c], 0.0, rounding);
        CHECK_CLOSE(flow[1][2 + c], p[c], rounding);
    }
    CHECK_CLOSE(fabs(determinant(m)), contraction, 1e-12 * contraction / sin(phi));
}

TEST(the_map_contracts_as_the_rule_says)
{
    for (int k = 0; k < BS; k++)
        for (int a = 1; a < 16; a++)
            for (int d = 0; d < 2; d++) {
                check_map(PI * a / 16.0, B[k], d, true);
                check_map(PI * a / 16.0, B[k], d, false);
            }
}

/** Whether a record of disks between walls across y may have an event at the upper wall across d,
 * with the rule of shearing or none. */
static bool wall_may_be_met(hd_boundary y, int d, bool ruled)
{
    const hd_scene_def def = scene_from(sheared(1, 0.3, 1, 10.0), .boundary[1] = y);
    hd_event event = {.t = 0.25, .j = ruled ? HD_WALL_RULED(HD_SHEARING, d) : HD_WALL_X - d};
    double p[2];
    velocity_at(event.p, 1.4, 1.0, d, true);
    memcpy(p, event.p, sizeof p);
    event.n[d] = 1.0;
    if (ruled) (void)wall()->meet(&def, p, event.n, d);
    const hd_record log = record_of(&event, 1, 0.5);
    return !hd_events_fault(&log, &def);
}

TEST(only_the_walls_of_the_scene_are_met)
{
    for (int k = 0; k < 4; k++) {
        const int d = k / 2;
        const bool ruled = k % 2;
        assert_int_equal(wall_may_be_met(HD_SHEARING, d, ruled), d == 1 && ruled);
        assert_int_equal(wall_may_be_met(HD_REFLECTING, d, ruled), d == 1 && !ruled);
    }
}

TEST(its_functions_do_what_they_say)
{
    for (int d = 0; d < 2; d++)
        for (int k = 1; k < 4; k++) {
            char message[256] = "";
            const hd_scene_def def = sheared(6, 0.3, d, B[k]);
            const hd_status status = hd_dynamics_test(&hd_disks_row, &def, message, sizeof message);
            assert_string_equal(message, "");
            CHECK_OK(status);
        }
}

/* ---- events -------------------------------------------------------------------------------- */

TEST(events_are_those_of_the_twin)
{
    for (int d = 0; d < 2; d++) {
        hd_scene_def def = sheared(2, 0.2, d, 10.0);
        twin_compare(trajectory_of(def), &def, 2000);
        def = sheared(20, 0.3, d, 0.5);
        twin_compare(trajectory_of(def), &def, 2000);
        def = sheared(60, 0.75, d, 3.0);
        twin_compare(trajectory_of(def), &def, 1000);
    }
}

/** Of the event's particle, when it has flown on to where the event is. */
typedef struct replayed {
    double q[2 * 20], p[2 * 20], t[20];
    double kinetic[2], impulse[2], near[2], momentum[2], shrunk;
} replayed;

/** A flight by little steps: a disk is near a wall or not at each. */
static void fly(replayed *r, const hd_scene_def *def, int i, double to)
{
    enum { STEPS = 2000 };
    const int d = hd_is_wall(def->boundary[0]) ? 0 : 1;
    const double dt = (to - r->t[i]) / STEPS;
    double box[2];
    hd_scene_box(def, box);
    for (int k = 0; k < STEPS; k++) {
        const double y = r->q[2 * i + d] + (k + 0.5) * dt * r->p[2 * i + d];
        const bool near[2] = {y<1.5, y> box[d] - 1.5};
        for (int side = 0; side < 2; side++) {
            r->near[side] += near[side] * dt;
            r->momentum[side] += near[side] * dt * r->p[2 * i + 1 - d];
        }
    }
    for (int c = 0; c < 2; c++) {
        r->kinetic[c] += r->p[2 * i + c] * r->p[2 * i + c] * (to - r->t[i]);
        r->q[2 * i + c] += r->p[2 * i + c] * (to - r->t[i]);
    }
    r->t[i] = to;
}

static void replay(replayed *r, const hd_scene_def *def, const hd_event *e)
{
    const int i = (int)e->i, j = (int)e->j;
    fly(r, def, i, e->t);
    if (j >= 0) {
        fly(r, def, j, e->t);
        const double b = e->p[0] * e->n[0] + e->p[1] * e->n[1];
        for (int c = 0; c < 2; c++) r->p[2 * i + c] += b * e->n[c], r->p[2 * j + c] -= b * e->n[c];
        return;
    }
    const int d = HD_WALL_ACROSS(j), side = e->p[d] > 0;
    const double before = r->p[2 * i + 1 - d], speed = hypot(e->p[0], e->p[1]),
                 slope = hypot(e->n[0], e->n[1]);
    r->shrunk += log(slope * fabs(e->n[d] / slope) / fabs(e->p[d] / speed));
    for (int c = 0; c < 2; c++) r->p[2 * i + c] = speed * e->n[c] / slope;
    r->impulse[side] += r->p[2 * i + 1 - d] - before;
}

/** A flight in steps is off by one of them at each border of what is near. */
TEST(sums_of_the_flow_are_sums_over_events)
{
    for (int d = 0; d < 2; d++) {
        const hd_scene_def def = sheared(20, 0.35, d, 1.0);
        OWNED(hd_trajectory) *tr = trajectory_of(def);
        OWNED(hd_record) *log = new_log();
        replayed r = {.shrunk = 0.0};
        const double time = 60.0;
        CHECK_OK(hd_trajectory_extend(tr, NULL, 10.0));
        const hd_totals a = hd_trajectory_totals(tr);
        const double shrunk = hd_trajectory_divergence(tr);
        hd_trajectory_state(tr, r.q, r.p);
        CHECK_OK(hd_trajectory_extend(tr, log, 10.0 + time));
        for (size_t k = 0; k < log->count; k++) replay(&r, &def, &events_in(log)[k]);
        for (int i = 0; i < def.number; i++) fly(&r, &def, i, time);
        const hd_totals b = hd_trajectory_totals(tr);
        CHECK_CLOSE(hd_trajectory_divergence(tr) - shrunk, r.shrunk, 1e-9);
        assert_true(r.shrunk < -1.0);
        for (int c = 0; c < 2; c++) {
            CHECK_CLOSE(b.kinetic[c] - a.kinetic[c], r.kinetic[c], 1e-7);
            CHECK_CLOSE(b.walls.impulse[c] - a.walls.impulse[c], r.impulse[c], 1e-7);
            CHECK_CLOSE(b.walls.near[c] - a.walls.near[c], r.near[c], 1e-3 * r.near[c]);
            CHECK_CLOSE(b.walls.momentum[c] - a.walls.momentum[c], r.momentum[c], 2e-3 * r.near[c]);
        }
        CHECK_WITHIN(b.walls.momentum[1] / b.walls.near[1], 0.3, 2.0); /* with the wall */
        CHECK_WITHIN(b.walls.momentum[0] / b.walls.near[0], -2.0, -0.3);
    }
}

/** Between walls that take away motion across them, disks that cannot pass each other come to rest
 * with ever more collisions: a trajectory that starts so ends, and soon. */
TEST(a_jam_ends_the_trajectory)
{
    hd_scene_def def = scene(.number = 6, .density = 0.1, .aspect = 0.2, .shear_b = 0.1,
                             .boundary[0] = HD_SHEARING, .exponents = HD_EXPONENTS_ALL);
    double q[12], p[12];
    def.density = 0.99 * hd_container_of(&def)->density_max(&def);
    assert_int_equal(hd_scene_check(&def, NULL, 0), HD_REFUSED);
    hd_container_of(&def)->start(&def, q);
    hd_null_space_momenta(&def, q, p);
    OWNED(hd_trajectory) *tr = started(&def, q, p);
    hd_status status = HD_OK;
    for (int k = 1; k <= 100 && status == HD_OK; k++)
        status = hd_trajectory_extend(tr, NULL, 10.0 * k);
    assert_int_equal(status, HD_JAMMED);
    CHECK_WITHIN((double)hd_trajectory_totals(tr).wall_events, 1600.0, 1e6);
}

/** Also where two groups of disks jam, so that times of events differ by roundings: without this it
 * would go on until memory is full. */
TEST(two_jams_end_the_trajectory)
{
    const hd_scene_def def = scene(.number = 8, .density = 0.8, .aspect = 2.7190267449571,
                                   .shear_b = 0.8855081632678133, .boundary[0] = HD_SHEARING,
                                   .exponents = HD_EXPONENTS_ALL, .seed = 5986531626022113050u);
    OWNED(hd_trajectory) *tr = trajectory_of(def);
    assert_int_equal(hd_trajectory_extend(tr, NULL, 10.0), HD_JAMMED);
    CHECK_WITHIN((double)hd_trajectory_totals(tr).wall_events, 1800.0, 1e6);
}

/* ---- scenes -------------------------------------------------------------------------------- */

static void check_refused(hd_scene_def def, const char *line)
{
    char message[256] = "";
    assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, line);
}

TEST(what_cannot_be_is_refused_by_name)
{
    const hd_scene_def def = sheared(20, 0.3, 1, 10.0);
    check_refused(scene_from(def, .particles = HD_SPHERES),
                  "boundary_y = shearing: must not be given with particles = spheres");
    check_refused(scene_from(def, .boundary[0] = HD_REFLECTING),
                  "boundary_x = reflecting: must be periodic with boundary_y = shearing");
    check_refused(scene_from(def, .boundary[0] = HD_SHEARING),
                  "boundary_y = shearing: must be periodic with boundary_x = shearing");
    check_refused(scene_from(def, .container = HD_CIRCLE, .aspect = 0.867),
                  "boundary_y = shearing: must not be given with container = circle, whose wall "
                  "reflects");
    check_refused(scene_from(def, .exponents = HD_EXPONENTS_POSITIVE),
                  "exponents = positive: must be all, all_independent, none or from 1 to 80 with "
                  "boundary_y = shearing, whose exponents are not in pairs of opposite sign");
    check_refused(scene_from(def, .shear_b = 0.001), "shear_b = 0.001: must be from 0.01 to 1e6");
    check_refused(scene_from(scene_of_kind(HD_DUMBBELLS, 20, 0.2, 1.0), .boundary[1] = HD_SHEARING),
                  "boundary_y = shearing: must not be given with particles = dumbbells");
    check_refused(
        scene_from(scene_of_kind(HD_SOFT_DISKS, 20, 0.2, 1.0), .boundary[1] = HD_SHEARING),
        "boundary_y = shearing: must not be given with particles = soft_disks");
    check_refused(with_second(def, 0.5, 1.2, 1.0),
                  "boundary_y = shearing: must not be given with particles = disks of a second "
                  "kind");
    check_refused(scene_from(def, .density = 0.93),
                  "density = 0.93: must be at most 0.913462 with number = 20 and walls that shear, "
                  "between which the densest start lattice cannot flow");
    CHECK_OK(hd_scene_check(&def, NULL, 0));
}

TEST(counts_follow_from_the_walls)
{
    hd_scene_def def = sheared(6, 0.3, 1, 10.0);
    assert_int_equal(hd_scene_exponents_usual(&def), HD_EXPONENTS_ALL);
    assert_false(hd_scene_symplectic(&def));
    const hd_counts counts = hd_scene_counts(&def);
    assert_int_equal(counts.zero, 3);
    assert_int_equal(counts.positive, 10);
    assert_int_equal(counts.carried, 24);
    def.boundary[1] = HD_REFLECTING;
    assert_true(hd_scene_symplectic(&def));
    assert_int_equal(hd_scene_exponents_usual(&def), HD_EXPONENTS_POSITIVE);
    assert_int_equal(hd_scene_counts(&def).zero, 4);
}
