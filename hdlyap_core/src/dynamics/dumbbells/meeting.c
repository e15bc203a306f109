/** Two states -> the time of contact. In flight the second derivative of a gap g is nowhere below
 * -A, with A = arm (omega_a^2 + omega_b^2): so g is above g + g' h - A h^2 / 2, whose first root
 * never passes the contact, and tends to a Newton step. By it the search goes on, of all four pairs
 * of disks at once: none is missed. It begins at the later of both states, or where the circles
 * around both molecules meet. One thread; + - * / sqrt alone. */
#include "dynamics/dumbbells/meeting.h"

#include <math.h>
#include <stdbool.h>

#include "base/multiversion.h"

/** A gap as small as this, that closes, is a contact [sigma]. */
static const double TOUCH = 1e-15;

typedef struct gaps {
    double gap[HD_MEETS], rate[HD_MEETS];
} gaps;

/** Two molecules, or one at a wall, from a moment on. */
typedef struct path {
    double arm;
    double r[2], v[2];         /**< of the centres: b seen from a; at a wall its distance */
    double angle[2], omega[2]; /**< of a, of b */
    double bend, depth;        /**< A; what rounding is */
    double length;             /**< between walls, of centres */
    int d;                     /**< across the wall */
} path;

typedef void (*gaps_at)(gaps *out, const path *way, double h);

static inline __attribute__((always_inline)) void pair_gaps(gaps *out, const path *way, double h)
{
    static const double a[HD_MEETS] = {-1, 1, -1, 1}, b[HD_MEETS] = {-1, -1, 1, 1};
    double e[2], f[2];
    hd_direction(e, way->angle[0] + way->omega[0] * h);
    hd_direction(f, way->angle[1] + way->omega[1] * h);
    const double rx = way->r[0] + way->v[0] * h, ry = way->r[1] + way->v[1] * h;
    const double ex = way->arm * e[0], ey = way->arm * e[1], fx = way->arm * f[0],
                 fy = way->arm * f[1], eo = way->omega[0], fo = way->omega[1];
    for (int k = 0; k < HD_MEETS; k++) {
        const double x = rx + b[k] * fx - a[k] * ex, y = ry + b[k] * fy - a[k] * ey;
        const double vx = way->v[0] - b[k] * fo * fy + a[k] * eo * ey,
                     vy = way->v[1] + b[k] * fo * fx - a[k] * eo * ex;
        const double distance = sqrt(x * x + y * y);
        out->gap[k] = distance - 1.0;
        out->rate[k] = (x * vx + y * vy) / distance;
    }
}

static inline __attribute__((always_inline)) void wall_gaps(gaps *out, const path *way, double h)
{
    double e[2];
    hd_direction(e, way->angle[0] + way->omega[0] * h);
    const double at = way->r[0] + way->v[0] * h, arm = way->arm * e[way->d],
                 turns = way->arm * way->omega[0] * (way->d == 0 ? -e[1] : e[0]);
    for (int disk = 0; disk < 2; disk++) {
        out->gap[disk] = at + hd_sign(disk) * arm;
        out->rate[disk] = way->v[0] + hd_sign(disk) * turns;
        out->gap[2 + disk] = way->length - out->gap[disk];
        out->rate[2 + disk] = -out->rate[disk];
    }
}

/** A time before which a gap stays open. One that opens has at least the size of its rounding, or
 * it would hold up the search. */
static inline double opens_for(double gap, double rate, double bend, double depth)
{
    if (rate < 0) return 2.0 * gap / (sqrt(rate * rate + 2.0 * bend * gap) - rate);
    return (rate + sqrt(rate * rate + 2.0 * bend * (gap > depth ? gap : depth))) / bend;
}

/** From h on, up to `until`; INFINITY if nothing meets. */
static inline __attribute__((always_inline)) double march(const path *way, gaps_at at, double h,
                                                          double until, int32_t *which)
{
    while (h <= until) {
        gaps now;
        double step = INFINITY;
        at(&now, way, h);
        for (int k = HD_MEETS - 1; k >= 0; k--) {
            if (!(now.gap[k] > TOUCH || now.rate[k] >= 0)) {
                step = 0.0;
                *which = k;
            } else if (step > 0.0) {
                const double open = opens_for(now.gap[k], now.rate[k], way->bend, way->depth);
                if (!(open < step)) continue;
                step = open;
                *which = k;
            }
        }
        if (h + step == h) return h;
        h += step;
    }
    return INFINITY;
}

/** When the circles around both molecules meet, and part. False: never. */
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
    way->angle[k] = m->spin[i].q / m->shape.root + way->omega[k] * (t - m->disk[i].t);
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
    const hd_disk *at = &m->disk[a], *to = &m->disk[b];
    const double t = at->t > to->t ? at->t : to->t;
    path way = {.arm = m->shape.arm};
    double from, end;
    for (int d = 0; d < 2; d++) {
        way.v[d] = to->p[d] - at->p[d];
        way.r[d] = to->q[d] + to->p[d] * (t - to->t) - (at->q[d] + at->p[d] * (t - at->t)) +
                   image[d] * m->cells.box[d];
    }
    if (!within_reach(&from, &end, &way) || from > until - t) return INFINITY;
    turn_to(&way, m, 0, a, t);
    turn_to(&way, m, 1, b, t);
    way.depth = hd_meeting_depth(m, turning(&way));
    return t + march_pair(&way, from, until - t < end ? until - t : end, which);
}

double hd_meeting_of_wall(const hd_molecules *m, int32_t i, int d, double until, int32_t *which)
{
    const hd_disk *at = &m->disk[i];
    path way = {.arm = m->shape.arm, .d = d, .length = m->cells.box[d] - 1.0};
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
