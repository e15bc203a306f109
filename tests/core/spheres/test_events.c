/** Events of spheres against a slow search in extended precision that shares nothing with the core:
 * every pair through every image, and every wall; the first of all. It begins anew from the
 * core's state after each event, so that both differ by no more than rounding. */
#include "prepared.h"
#include "scene/container.h"

enum { MAX = 100 };

typedef long double real;

typedef struct twin {
    int n;
    bool walls[3];
    real box[3], q[3 * MAX], p[3 * MAX];
} twin;

typedef struct meeting {
    real t;
    int i, j;
    real r[3], p[3]; /**< from i to j, and so moving; of a wall r is its axis */
} meeting;

static real dot(const real *a, const real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void load(twin *w, const hd_scene_def *def, const hd_trajectory *tr)
{
    double q[3 * MAX], p[3 * MAX], box[3];
    w->n = def->disks;
    hd_trajectory_state(tr, q, p);
    hd_trajectory_box(tr, box);
    for (int d = 0; d < 3; d++) w->box[d] = box[d], w->walls[d] = def->boundary[d] == R;
    for (int k = 0; k < 3 * w->n; k++) w->q[k] = q[k], w->p[k] = p[k];
}

/** INFINITY if they do not meet. */
static real wait_of(const real *r, const real *p)
{
    const real rp = dot(r, p), pp = dot(p, p), c = dot(r, r) - 1, square = rp * rp - pp * c;
    if (rp >= 0 || square <= 0) return INFINITY;
    return fmaxl(0, c / (sqrtl(square) - rp));
}

/** Images along d that may touch within the time. */
static void reach(int range[2], const twin *w, int d, real r, real p, real time)
{
    const real far = 1 + fabsl(p) * time;
    range[0] = w->walls[d] ? 0 : (int)ceill((-far - r) / w->box[d]);
    range[1] = w->walls[d] ? 0 : (int)floorl((far - r) / w->box[d]);
}

static void try_pair(meeting *best, const twin *w, int i, int j, real time)
{
    meeting m = {.i = i, .j = j};
    real r[3];
    int x[2], y[2], z[2];
    for (int d = 0; d < 3; d++) {
        r[d] = w->q[3 * j + d] - w->q[3 * i + d];
        m.p[d] = w->p[3 * j + d] - w->p[3 * i + d];
    }
    reach(x, w, 0, r[0], m.p[0], time);
    reach(y, w, 1, r[1], m.p[1], time);
    reach(z, w, 2, r[2], m.p[2], time);
    for (int a = x[0]; a <= x[1]; a++)
        for (int b = y[0]; b <= y[1]; b++)
            for (int c = z[0]; c <= z[1]; c++) {
                const int image[3] = {a, b, c};
                for (int d = 0; d < 3; d++) m.r[d] = r[d] + image[d] * w->box[d];
                m.t = wait_of(m.r, m.p);
                if (m.t < best->t) *best = m;
            }
}

static void try_walls(meeting *best, const twin *w, int i)
{
    for (int d = 0; d < 3; d++) {
        const real p = w->p[3 * i + d], q = w->q[3 * i + d];
        if (!w->walls[d] || p == 0) continue;
        const real t = fmaxl(0, ((p > 0 ? w->box[d] - 0.5L : 0.5L) - q) / p);
        if (t >= best->t) continue;
        *best = (meeting){.t = t, .i = i, .j = -1 - d};
        best->r[d] = 1;
        memcpy(best->p, w->p + 3 * i, sizeof best->p);
    }
}

static void fly(twin *w, real time)
{
    for (int k = 0; k < 3 * w->n; k++) {
        w->q[k] += w->p[k] * time;
        if (!w->walls[k % 3]) w->q[k] -= floorl(w->q[k] / w->box[k % 3]) * w->box[k % 3];
    }
}

/** While nothing moves by more than an edge. */
static real patience(const twin *w)
{
    real fastest = 0;
    for (int i = 0; i < w->n; i++) fastest = fmaxl(fastest, sqrtl(dot(w->p + 3 * i, w->p + 3 * i)));
    return fminl(w->box[0], fminl(w->box[1], w->box[2])) / fastest;
}

/** Goes on to the next event, its time from now. */
static meeting next(twin *w)
{
    real passed = 0;
    for (;;) {
        const real time = patience(w);
        meeting best = {.t = time};
        for (int i = 0; i < w->n; i++) {
            for (int j = i + 1; j < w->n; j++) try_pair(&best, w, i, j, time);
            try_walls(&best, w, i);
        }
        fly(w, best.t);
        passed += best.t;
        if (best.t == time) continue;
        for (int d = 0; d < 3 && best.j >= 0; d++) best.r[d] += best.p[d] * best.t;
        best.t = passed;
        return best;
    }
}

static void exchange(twin *w, const meeting *m)
{
    const real b = dot(m->r, m->p) / dot(m->r, m->r);
    for (int d = 0; d < 3; d++) {
        w->p[3 * m->i + d] += (m->j < 0 ? -2 : 1) * b * m->r[d];
        if (m->j >= 0) w->p[3 * m->j + d] -= b * m->r[d];
    }
}

/** One event of both. Positions are known to some eps of the box and of the way in an epoch, which
 * is 2 (32 collisions) at most; contacts by as much over the normal part of the velocity. */
static void compare_next(hd_trajectory *tr, hd_event_log *log, twin *w)
{
    const meeting m = next(w);
    real speed = sqrtl(dot(m.p, m.p));
    const real normal = fabsl(dot(m.r, m.p)),
               longest = fmaxl(w->box[0], fmaxl(w->box[1], w->box[2]));
    const double rounding = (double)(16 * DBL_EPSILON * (longest + 8 * tr->epoch_length));
    const double late = rounding / (double)normal, turned = rounding * (double)(speed / normal + 1);
    CHECK_OK(trajectory_to(tr, log, hd_trajectory_time(tr) + (double)m.t + late));
    assert_int_equal(log->count, 1);
    const hd_event *e = log->event;
    assert_int_equal(e->i, m.i);
    assert_int_equal(e->j, m.j);
    CHECK_CLOSE(e->t, (double)m.t, late + 4 * DBL_EPSILON * hd_trajectory_time(tr));
    exchange(w, &m);
    double p[3 * MAX];
    hd_trajectory_state(tr, NULL, p);
    for (int d = 0; d < 3; d++) {
        CHECK_CLOSE(e->n[d], (double)m.r[d], turned);
        CHECK_CLOSE(e->p[d], (double)m.p[d], 4 * DBL_EPSILON * (double)speed);
    }
    for (int k = 0; k < 3 * w->n; k++)
        CHECK_CLOSE(p[k], (double)w->p[k], 4 * turned * (double)speed);
}

/** Where it touches a wall all spheres meet that at the same time. Close to the densest packing
 * events come more often than the rate says, by far. */
static void leave_the_lattice(hd_trajectory *tr)
{
    double t = 1e-9 / hd_trajectory_collision_rate(tr);
    while (hd_trajectory_collisions(tr) < 2 * (uint64_t)hd_trajectory_disks(tr)) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, hd_trajectory_time(tr) + t));
        t *= 1.5;
    }
}

static void compare(hd_scene_def def, int events)
{
    twin w;
    char line[256] = "";
    if (hd_scene_check(&def, line, sizeof line) != HD_OK) fail_msg("%s", line);
    MADE(hd_trajectory, tr, &def);
    OWNED(hd_event_log) *log = new_log();
    leave_the_lattice(tr);
    for (int k = 0; k < events; k++) {
        load(&w, &def, tr);
        compare_next(tr, log, &w);
    }
}

/** From thin gas to a part of the densest lattice, behind all walls. */
static void sweep(int disks, double aspect, double aspect_z, int events)
{
    static const double fraction[] = {0.005, 0.3, 0.7, 0.95, 0.999, 1.0 - 1e-6};
    for (int walls = 0; walls < 8; walls++)
        for (size_t k = 0; k < sizeof fraction / sizeof *fraction; k++) {
            hd_scene_def def = spheres_of(disks, 1.0, aspect, aspect_z, walls, 10 + k);
            def.density = fraction[k] * hd_container_of(&def)->density_max(&def);
            compare(def, HD_SANITIZED ? events / 4 : events);
        }
}

TEST(two_spheres) { sweep(2, 0.9, 1.1, 300); }
TEST(four_spheres) { sweep(4, 1.2, 0.8, 300); }
TEST(twelve_spheres) { sweep(12, 0.7, 1.3, 200); }

/** More cells than three along an edge. */
TEST(a_hundred_spheres)
{
    for (int walls = 0; walls < 8; walls++)
        compare(spheres_of(100, 0.2, 0.6, 0.5, walls, 5), HD_SANITIZED ? 10 : 100);
}

/** Edges below two diameters: two spheres meet through several images at a time. */
TEST(several_images_of_a_pair)
{
    static const double edge[][3] = {
        {1.9, 1.9, 1.9}, {1.5, 1.6, 1.7}, {1.05, 1.95, 1.6}, {3.1, 1.1, 1.4}, {1.001, 1.6, 5.0}};
    int compared = 0;
    for (size_t k = 0; k < sizeof edge / sizeof *edge; k++)
        for (int walls = 0; walls < 8; walls++)
            for (int disks = 2; disks <= 4; disks += 2) {
                const hd_scene_def def = spheres_in_box(disks, edge[k][0], edge[k][1], edge[k][2],
                                                        walls, k + 1);
                if (hd_scene_check(&def, NULL, 0) != HD_OK) continue;
                compare(def, 400);
                compared++;
            }
    assert_true(compared >= 40);
}

/** Two images at the very same time: the lower one in z first, then in y, then in x; the other one
 * if they still approach it. */
TEST(lower_images_come_first)
{
    for (int axis = 0; axis < 3; axis++) {
        double edge[3] = {4.0, 4.0, 4.0}, q[6] = {0.25, 0.25, 0.25, 0.25, 0.25, 0.25}, p[6] = {0};
        const int along = (axis + 1) % 3;
        edge[axis] = 1.5; /* its images are 0.75 away on either side */
        q[3 + axis] = 1.0;
        q[along] = 0.5;
        q[3 + along] = 2.5;
        p[along] = 0.5, p[3 + along] = -0.5;
        const hd_scene_def def = spheres_in_box(2, edge[0], edge[1], edge[2], 0, 1);
        OWNED(hd_event_log) *log = log_of(&def, q, p, 1.9);
        const double wait = 2.0 - sqrt(1.0 - 0.75 * 0.75);
        assert_true(log->count >= 2);
        for (int k = 0; k < 2; k++) {
            CHECK_CLOSE(log->event[k].t, wait, 16 * DBL_EPSILON);
            CHECK_CLOSE(log->event[k].n[axis], k == 0 ? -0.75 : 0.75, 16 * DBL_EPSILON);
        }
    }
}

/** Four at the same time: after the lowest, z decides before y, and y before x. */
TEST(the_last_direction_counts_most)
{
    for (int along = 0; along < 3; along++) {
        const int low = along == 0 ? 1 : 0, high = along == 2 ? 1 : 2;
        double edge[3] = {1.25, 1.25, 1.25}, q[6] = {0.25, 0.25, 0.25, 0.875, 0.875, 0.875};
        double p[6] = {0};
        edge[along] = 4.0; /* across, images are 0.625 away on either side, exactly */
        q[along] = 0.5, q[3 + along] = 2.5;
        p[along] = 0.5, p[3 + along] = -0.5;
        const hd_scene_def def = spheres_in_box(2, edge[0], edge[1], edge[2], 0, 1);
        double box[3];
        hd_scene_box(&def, box);
        for (int d = 0; d < 3; d++) CHECK_CLOSE(box[d], edge[d], 0.0); /* else they are no ties */
        OWNED(hd_event_log) *log = log_of(&def, q, p, 1.9);
        assert_true(log->count >= 2);
        CHECK_CLOSE(log->event[0].n[low], -0.625, 16 * DBL_EPSILON);
        CHECK_CLOSE(log->event[0].n[high], -0.625, 16 * DBL_EPSILON);
        CHECK_CLOSE(log->event[1].n[low], 0.625, 16 * DBL_EPSILON);
        CHECK_CLOSE(log->event[1].n[high], -0.625, 16 * DBL_EPSILON);
    }
}
