/** Two states -> the time of contact. In flight the second derivative of a gap g is never below -A,
 * with A = arm (omega_a^2 + omega_b^2). So after a time h the gap is at least g + g' h - A h^2 / 2.
 * The first root of this never passes the contact, and tends to a Newton step. The search goes from
 * root to root, for all four pairs of disks at once, and misses no contact. It begins at the time
 * of the later state, or when the circles around both dumbbells meet. It uses + - * / sqrt only. */
#include "dynamics/dumbbells/dumbbells.h"

#include <math.h>
#include <stdbool.h>

#include "base/multiversion.h"

/** A gap is a contact if it closes and is at most this [sigma]. */
static const double TOUCH = 1e-15;

/** Numbers of four pairs of disks side by side. They take fewer instructions than four scalars, and
 * give the same bits. */
typedef double quad __attribute__((vector_size(32)));
typedef int64_t quad_mask __attribute__((vector_size(32)));

typedef struct gaps {
    quad gap, rate;
} gaps;

#define ALWAYS static inline __attribute__((always_inline))

/** For each of the four numbers: mask ? yes : no. */
ALWAYS void choose(quad *out, const quad_mask *mask, const quad *yes, const quad *no)
{
    *out = (quad)((*mask & (quad_mask)*yes) | (~*mask & (quad_mask)*no));
}

ALWAYS void roots(quad *x)
{
    *x = (quad){sqrt((*x)[0]), sqrt((*x)[1]), sqrt((*x)[2]), sqrt((*x)[3])};
}

/** How two dumbbells, or one between two walls, move from a moment on. */
typedef struct path {
    double arm;
    double r[2], v[2];         /**< centre of b relative to a; r[0], v[0] from the low wall */
    double angle[2], omega[2]; /**< angles and angular velocities of a and of b */
    double bend, depth;        /**< A; an overlap that rounding can cause */
    double length;             /**< room of a disk's centre between two walls */
    int d;                     /**< direction across the walls */
} path;

typedef void (*gaps_at)(gaps *out, const path *way, double h);

ALWAYS void pair_gaps(gaps *out, const path *way, double h)
{
    const quad a = {-1, 1, -1, 1}, b = {-1, -1, 1, 1};
    hd_pair c, s;
    hd_headings(&c, &s,
                (hd_pair){way->angle[0] + way->omega[0] * h, way->angle[1] + way->omega[1] * h});
    const double rx = way->r[0] + way->v[0] * h, ry = way->r[1] + way->v[1] * h;
    const double ex = way->arm * c[0], ey = way->arm * s[0], fx = way->arm * c[1],
                 fy = way->arm * s[1], eo = way->omega[0], fo = way->omega[1];
    const quad x = rx + b * fx - a * ex, y = ry + b * fy - a * ey;
    const quad vx = way->v[0] - b * (fo * fy) + a * (eo * ey),
               vy = way->v[1] + b * (fo * fx) - a * (eo * ex);
    quad distance = x * x + y * y;
    roots(&distance);
    out->gap = distance - 1.0;
    out->rate = (x * vx + y * vy) / distance;
}

ALWAYS void wall_gaps(gaps *out, const path *way, double h)
{
    double e[2];
    hd_heading(e, way->angle[0] + way->omega[0] * h);
    const double at = way->r[0] + way->v[0] * h, arm = way->arm * e[way->d],
                 turns = way->arm * way->omega[0] * (way->d == 0 ? -e[1] : e[0]), v = way->v[0],
                 low = at - arm, high = at + arm;
    out->gap = (quad){low, high, way->length - low, way->length - high};
    out->rate = (quad){v - turns, v + turns, turns - v, -(v + turns)};
}

/** A time for which each gap stays open. A gap that opens counts as at least its rounding;
 * otherwise the search would not get beyond it. */
ALWAYS void open_for(quad *out, const gaps *now, const path *way)
{
    const quad rate = now->rate, depth = way->depth - (quad){0}, bend = way->bend - (quad){0};
    const quad_mask opens = rate >= 0, tiny = opens & ~(now->gap > depth);
    quad gap, over, under;
    choose(&gap, &tiny, &depth, &now->gap);
    quad root = rate * rate + 2.0 * bend * gap;
    roots(&root);
    const quad sum = rate + root, less = root - rate, twice = 2.0 * gap;
    choose(&over, &opens, &sum, &twice);
    choose(&under, &opens, &bend, &less);
    *out = over / under;
}

/** The first contact from time h up to `until`; INFINITY if there is none. which: of the four
 * pairs. */
ALWAYS double march(const path *way, gaps_at at, double h, double until, int32_t *which)
{
    while (h <= until) {
        gaps now;
        quad open, met = (quad){0} - 1.0;
        double step = INFINITY;
        int32_t first = 0;
        at(&now, way, h);
        open_for(&open, &now, way);
        const quad_mask apart = (now.gap > TOUCH) | (now.rate >= 0);
        choose(&open, &apart, &open, &met);
        for (int k = HD_MEETS - 1; k >= 0; k--) {
            const bool is_first = (open[k] < step) | (open[k] < 0);
            step = is_first ? open[k] : step;
            first = is_first ? k : first;
        }
        *which = first;
        step = step > 0 ? step : 0.0;
        if (h + step == h) return h;
        h += step;
    }
    return INFINITY;
}

/** Finds when the circles around both dumbbells meet and part. Returns false if they never meet. */
static bool within_reach(double *from, double *to, const path *way)
{
    const double reach = (1.0 + 2.0 * way->arm) * (1.0 + 1e-9), *r = way->r, *v = way->v;
    const double far = r[0] * r[0] + r[1] * r[1] - reach * reach, rv = r[0] * v[0] + r[1] * v[1],
                 vv = v[0] * v[0] + v[1] * v[1], cross = r[0] * v[1] - r[1] * v[0],
                 square = vv * reach * reach - cross * cross;
    *from = 0.0;
    *to = INFINITY;
    if (far > 0 && !(rv < 0 && square > 0)) return false;
    const double root = sqrt(square > 0 ? square : 0.0);
    if (far > 0) *from = far / (root - rv);
    if (vv > 0) *to = (root - rv) / vv;
    return true;
}

static double turning(const path *way) { return fabs(way->omega[0]) + fabs(way->omega[1]); }

static void turn_to(path *way, const hd_molecules *m, int k, int32_t i, double t)
{
    way->omega[k] = m->spin[i].p / m->shape.root;
    way->angle[k] = m->spin[i].q / m->shape.root + way->omega[k] * (t - m->hard.motion.disk[i].t);
    way->bend += way->arm * way->omega[k] * way->omega[k];
}

HD_MULTIVERSION
static double march_pair(const path *way, double from, double until, int32_t *which)
{
    return march(way, pair_gaps, from, until, which);
}

double hd_meeting_of_pair(const hd_molecules *m, int32_t a, int32_t b, const int32_t image[2],
                          double until, int32_t *which)
{
    const hd_disk *at = &m->hard.motion.disk[a], *to = &m->hard.motion.disk[b];
    const double t = at->t > to->t ? at->t : to->t;
    path way = {.arm = m->shape.arm};
    double from, end;
    for (int d = 0; d < 2; d++) {
        way.v[d] = to->p[d] - at->p[d];
        way.r[d] = to->q[d] + to->p[d] * (t - to->t) - (at->q[d] + at->p[d] * (t - at->t)) +
                   image[d] * m->hard.motion.cells.box[d];
    }
    if (!within_reach(&from, &end, &way) || from > until - t) return INFINITY;
    turn_to(&way, m, 0, a, t);
    turn_to(&way, m, 1, b, t);
    way.depth = hd_meeting_depth(m, turning(&way));
    return t + march_pair(&way, from, until - t < end ? until - t : end, which);
}

double hd_meeting_of_wall(const hd_molecules *m, int32_t i, int d, double until, int32_t *which)
{
    const hd_disk *at = &m->hard.motion.disk[i];
    path way = {.arm = m->shape.arm, .d = d, .length = m->hard.motion.cells.box[d] - 1.0};
    way.v[0] = at->p[d];
    way.r[0] = at->q[d] - 0.5;
    turn_to(&way, m, 0, i, at->t);
    way.depth = hd_meeting_depth(m, turning(&way));
    const double reach = way.arm * (1.0 + 1e-9), ahead = way.v[0] < 0 ? reach : way.length - reach;
    const bool within = way.r[0] > reach && way.length - way.r[0] > reach;
    if (within && way.v[0] == 0) return INFINITY; /* no turn reaches a wall */
    const double from = within ? (ahead - way.r[0]) / way.v[0] : 0.0;
    return at->t + march(&way, wall_gaps, from, until - at->t, which);
}
