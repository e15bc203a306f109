/** Disks in a circle: against a search by brute force, what is conserved, and what a gas does. */
#include "dynamics/hard/round_wall.h"
#include "prepared.h"

static hd_scene_def circle(int disks, double density)
{
    return scene(.container = HD_CIRCLE, .number = disks, .density = density);
}

static double reach_of(const hd_scene_def *def)
{
    double box[2];
    hd_scene_box(def, box);
    return 0.5 * box[0] - 0.5;
}

/* ---- one meeting ---------------------------------------------------------------------------- */

/** From anywhere in any direction the place at the time is on the wall, and before it inside. */
TEST(it_is_reached_when_it_says)
{
    const hd_scene_def def = circle(50, 0.6);
    const hd_wall wall = hd_wall_of(&def, 0.5);
    const double reach = reach_of(&def), centre = reach + 0.5;
    for (int k = 0; k < 20000; k++) {
        const double r = k % 3 == 0 ? reach : reach * fmod(0.618 * k, 1.0);
        const double at = 2.4 * k, speed = pow(10.0, k % 5 - 2);
        const double inwards = k % 3 == 0 ? PI + 1.5 * sin(1.7 * k) : 0.9 * k;
        const double p[2] = {speed * cos(at + inwards), speed * sin(at + inwards)};
        const hd_disk disk = {
            {centre + r * cos(at), centre + r * sin(at)}, {p[0], p[1]}, 0.25, {0}, {0}, 0, 0};
        const double t = hd_round_wall_time(&wall, &disk) - disk.t;
        const double there[2] = {disk.q[0] + t * p[0], disk.q[1] + t * p[1]};
        const double before[2] = {disk.q[0] + 0.9 * t * p[0], disk.q[1] + 0.9 * t * p[1]};
        assert_true(t >= 0.0);
        CHECK_CLOSE(wall.excess(&wall, there), 0.0, 32.0 * DBL_EPSILON * reach);
        assert_true(wall.excess(&wall, before) <= 4.0 * DBL_EPSILON * reach);
    }
}

/** Along the wall within rounding: it goes on, with its energy, in finitely many steps. */
TEST(a_disk_that_glides_does_not_stay_for_ever)
{
    const hd_scene_def def = circle(2, 0.1);
    const hd_wall wall = hd_wall_of(&def, 0.5);
    const double reach = reach_of(&def), centre = reach + 0.5;
    for (double out = 1e-3; out > 1e-18; out *= 0.1)
        for (int sign = -1; sign < 2; sign += 2) {
            hd_disk disk = {{centre + reach, centre}, {sign * out, 1.0}, 0.0, {0}, {0}, 0, 0};
            hd_event event = {.i = 0};
            const bool outwards = hd_round_wall_reflect(&wall, &disk, &event);
            assert_int_equal(outwards, sign > 0);
            assert_true(disk.p[0] <= -0.999e-7);
            CHECK_CLOSE(hypot(disk.p[0], disk.p[1]), hypot(out, 1.0), 1e-14);
            assert_true(hd_round_wall_time(&wall, &disk) > 1e-8);
        }
}

/* ---- all of them ---------------------------------------------------------------------------- */

enum { DISKS_MAX = 40 };

/** A slow twin: everything that can happen is tried at every event. */
typedef struct slow {
    int disks;
    double radius, q[2 * DISKS_MAX], p[2 * DISKS_MAX]; /**< of the wall; q from the centre */
    double size[DISKS_MAX], mass[DISKS_MAX];           /**< a disk's radius */
} slow;

/** What moves on from the state of a trajectory; momenta over masses. */
static slow slow_of(const hd_scene_def *def, const hd_trajectory *tr)
{
    slow s = {.disks = def->number, .radius = reach_of(def) + 0.5};
    hd_kind kind[HD_KINDS_MAX];
    const int kinds = hd_scene_kinds(def, kind);
    hd_trajectory_state(tr, s.q, s.p);
    for (int i = 0; i < s.disks; i++) {
        const hd_kind *of = &kind[i >= kind[0].number && kinds > 1];
        s.size[i] = 0.5 * of->diameter;
        s.mass[i] = of->mass;
        for (int d = 0; d < 2; d++) s.q[2 * i + d] -= s.radius;
        for (int d = 0; d < 2; d++) s.p[2 * i + d] /= sqrt(of->mass); /* published: p / sqrt(m) */
    }
    return s;
}

static double meeting(const slow *s, int i, int j)
{
    const double *q = s->q, *p = s->p, touching = s->size[i] + s->size[j];
    const double x = q[2 * j] - q[2 * i], y = q[2 * j + 1] - q[2 * i + 1];
    const double px = p[2 * j] - p[2 * i], py = p[2 * j + 1] - p[2 * i + 1];
    const double rp = x * px + y * py, p2 = px * px + py * py;
    const double square = rp * rp - p2 * (x * x + y * y - touching * touching);
    return rp < 0 && square > 0 ? (-rp - sqrt(square)) / p2 : INFINITY;
}

static double edge(const slow *s, int i)
{
    const double *q = s->q + 2 * i, *p = s->p + 2 * i, reach = s->radius - s->size[i];
    const double rp = q[0] * p[0] + q[1] * p[1], p2 = p[0] * p[0] + p[1] * p[1];
    const double square = rp * rp - p2 * (q[0] * q[0] + q[1] * q[1] - reach * reach);
    return (-rp + sqrt(fmax(square, 0.0))) / p2;
}

static double slow_step(slow *s, int *i, int *j)
{
    double first = INFINITY;
    for (int a = 0; a < s->disks; a++) {
        if (edge(s, a) < first) first = edge(s, a), *i = a, *j = HD_WALL_ROUND;
        for (int b = a + 1; b < s->disks; b++)
            if (meeting(s, a, b) < first) first = meeting(s, a, b), *i = a, *j = b;
    }
    for (int k = 0; k < 2 * s->disks; k++) s->q[k] += first * s->p[k];
    double n[2], along = 0.0;
    const bool wall = *j < 0;
    const double length = wall ? s->radius - s->size[*i] : s->size[*i] + s->size[*j];
    const double both = wall ? 1.0 : 0.5 * (s->mass[*i] + s->mass[*j]);
    for (int d = 0; d < 2; d++) {
        n[d] = (wall ? s->q[2 * *i + d] : s->q[2 * *j + d] - s->q[2 * *i + d]) / length;
        along += n[d] * (wall ? 2.0 * s->p[2 * *i + d] : s->p[2 * *j + d] - s->p[2 * *i + d]);
    }
    for (int d = 0; d < 2; d++) {
        s->p[2 * *i + d] += (wall ? -along : along * s->mass[*j] / both) * n[d];
        if (!wall) s->p[2 * *j + d] -= along * s->mass[*i] / both * n[d];
    }
    return first;
}

static void check_twin(hd_scene_def def)
{
    enum { EVENTS = 60 };
    char message[200] = "";
    if (hd_scene_check(&def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    OWNED(hd_record) *log = new_log();
    OWNED(hd_trajectory) *tr = trajectory_of(def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 30.0));
    slow s = slow_of(&def, tr);
    CHECK_OK(trajectory_to(tr, log, 30.0 + EVENTS / hd_trajectory_totals(tr).expected));
    double t = 0.0;
    for (size_t k = 0; k < log->count && k < EVENTS; k++) {
        const hd_event *event = &events_in(log)[k];
        int i = -1, j = -1;
        t += slow_step(&s, &i, &j);
        CHECK_CLOSE(event->i, i, 0.0);
        CHECK_CLOSE(event->j, j, 0.0);
        CHECK_CLOSE(event->t, t, 1e-6); /* chaos: 1e-16 by some 10 collisions of each */
        if (j >= 0) continue;
        CHECK_CLOSE(hypot(event->n[0], event->n[1]), s.radius - s.size[i], 1e-12);
        assert_true(event->n[0] * event->p[0] + event->n[1] * event->p[1] > 0.0);
    }
    assert_true(log->count > EVENTS / 2);
}

TEST(events_are_those_of_a_slow_twin)
{
    check_twin(circle(2, 0.2));
    check_twin(circle(4, 0.4));
    check_twin(circle(7, 0.9));
    check_twin(circle(20, 0.6));
    check_twin(circle(40, 0.75));
}

/** Of two sizes and masses, as different as can be. */
TEST(events_of_mixtures_are_those_of_a_slow_twin)
{
    static const double mass[] = {0.001, 0.1, 3.0, 1000.0}, diameter[] = {0.2, 0.7, 1.4, 4.0};
    for (int k = 0; k < 16; k++) {
        const hd_scene_def few = circle(2 + 5 * (k % 4), 0.1), all = circle(17, 0.1);
        check_twin(packed(with_second(few, 0.5, diameter[k / 4], mass[k % 4]), 0.3));
        if (k % 4 == 2) check_twin(packed(with_second(all, 1.0, diameter[k / 4], 3.0), 0.3));
    }
}

/** Energy and angular momentum stay; nobody leaves, and none overlap. */
TEST(what_is_conserved)
{
    const struct {
        int disks;
        double density;
    } cases[] = {{2, 0.3}, {10, 0.5}, {100, 0.8}, {37, 0.05}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const hd_scene_def def = circle(cases[k].disks, cases[k].density);
        const double n = cases[k].disks, reach = reach_of(&def);
        HEAP double *q = calloc(2 * (size_t)n, sizeof *q);
        MADE(hd_trajectory, tr, &def);
        for (int look = 1; look <= 50; look++) {
            CHECK_OK(hd_trajectory_extend(tr, NULL, look * 40.0));
            hd_trajectory_state(tr, q, NULL);
            CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, n,
                        n * hd_trajectory_examined(tr).energy_rounding);
            CHECK_CLOSE(hd_trajectory_examined(tr).angular_momentum, 0.0,
                        n * reach * hd_trajectory_examined(tr).energy_rounding);
            CHECK_CLOSE(hd_trajectory_examined(tr).overlap, 0.0,
                        hd_trajectory_examined(tr).overlap_rounding);
            for (int i = 0; i < n; i++)
                assert_true(hypot(q[2 * i] - reach - 0.5, q[2 * i + 1] - reach - 0.5) <=
                            reach * (1.0 + 16.0 * DBL_EPSILON));
        }
    }
}

/** Pressure: the momentum that the wall takes, per length and time, is that of the virial; but for
 * the angular momentum, which is held at 0. */
TEST(pressure_at_the_wall_is_that_of_the_virial)
{
    const double density[] = {0.2, 0.6};
    for (int k = 0; k < 2; k++) {
        hd_scene_def def = circle(100, density[k]);
        def.observe = HD_OBSERVE_GAS;
        const double reach = reach_of(&def), length = second_tier() ? 4000.0 : 1000.0;
        OWNED(hd_record) *log = new_log();
        OWNED(hd_trajectory) *tr = trajectory_of(def);
        CHECK_OK(hd_trajectory_extend(tr, NULL, 50.0));
        double pushed = 0.0, virial = 0.0;
        const hd_totals before = hd_trajectory_totals(tr);
        for (int piece = 1; piece <= 100; piece++) {
            CHECK_OK(trajectory_to(tr, log, 50.0 + piece * length / 100));
            for (size_t e = 0; e < log->count; e++) {
                const hd_event *event = &events_in(log)[e];
                if (event->j != HD_WALL_ROUND) continue;
                pushed += 2.0 * (event->p[0] * event->n[0] + event->p[1] * event->n[1]) / reach;
            }
        }
        const hd_totals after = hd_trajectory_totals(tr);
        for (int d = 0; d < 2; d++) virial += after.virial[d] - before.virial[d];
        /* 2 K + sum of r.F over pairs and wall is 0 on average, exactly */
        const double p = pushed / (2.0 * PI * reach * length);
        const double by_virial = (2.0 * def.number + virial / length) / (2.0 * PI * reach * reach);
        CHECK_CLOSE(p, by_virial, 0.01 * p);
    }
}

/** Bits do not depend on where the time is cut. */
TEST(events_do_not_depend_on_the_cuts)
{
    const hd_scene_def def = circle(50, 0.7);
    double one[2][100], other[2][100];
    OWNED(hd_trajectory) *whole = trajectory_of(def), *cut = trajectory_of(def);
    CHECK_OK(hd_trajectory_extend(whole, NULL, 50.0));
    for (int k = 1; k <= 500; k++) CHECK_OK(hd_trajectory_extend(cut, NULL, 0.1 * k));
    hd_trajectory_state(whole, one[0], one[1]);
    hd_trajectory_state(cut, other[0], other[1]);
    assert_int_equal(hd_trajectory_totals(whole).collisions, hd_trajectory_totals(cut).collisions);
    assert_memory_equal(one[1], other[1], sizeof one[1]);
}
