/** Waves of a circle -> wave numbers; a place -> Bessel functions and their gradients [T21]. */
#define _XOPEN_SOURCE 700 /* jn */

#include <complex.h>
#include <math.h>

#include "scene/circle.h"

static const double PI = 3.14159265358979323846;

/* ---- wave numbers --------------------------------------------------------------------------- */

/** The function whose roots are the wave numbers, up to a factor. T: the tangential stress at the
 * wall of the flow of hd_circle_modulations. LP: J_m', the flow through the wall. */
static double at_wall(bool transverse, int m, double x)
{
    if (transverse) return m > 0 ? m * jn(m, x) - jn(m + 2, x) : jn(2, x);
    return m > 0 ? jn(m - 1, x) - jn(m + 1, x) : jn(1, x);
}

/** The next root above x, by the Illinois method; roots are more than pi / 2 apart. */
static double next_root(bool transverse, int m, double x)
{
    const double STEP = 0.5, CLOSE = 1e-14;
    double low = x + 1e-3, high = low + STEP;
    double below = at_wall(transverse, m, low), above = at_wall(transverse, m, high);
    while (below * above > 0) {
        low = high, below = above;
        above = at_wall(transverse, m, high += STEP);
    }
    for (int stays = 0; high - low > CLOSE * high && above != 0;) {
        const double at = (low * above - high * below) / (above - below);
        if (!(at > low && at < high)) break;
        const double here = at_wall(transverse, m, at);
        const int moves = here * below > 0 ? -1 : 1; /* the low end, or the high one */
        *(moves < 0 ? &low : &high) = at;
        *(moves < 0 ? &below : &above) = here;
        if (stays == -moves) *(moves < 0 ? &above : &below) *= 0.5;
        stays = -moves;
    }
    return fabs(below) < fabs(above) ? low : high;
}

/** Where the search begins. The first root of J_m' is above m, the first one of T above m + 1. The
 * root of J_0' = -J_1 at 0 does not count. T of m = 1 has the roots of LP of m = 2, to the last
 * bit. */
static double before_roots(bool transverse, int m) { return transverse ? m + 1 : fmax(m, 0.1); }

static hd_modulations modulations_of(int m)
{
    return (hd_modulations){m > 0 ? 2 : 1, {HD_COS_M, HD_SIN_M}};
}

/** A wave with fields of one kind; n[0] = m, n[1]: the number of the root, from 1. */
static hd_wave wave_of(double reach, bool transverse, int m, int n, double root)
{
    const double k = root / reach;
    hd_wave wave = {.n = {m, n}, .k = {k, 0.0}, .number = k};
    *(transverse ? &wave.transverse : &wave.pairs) = modulations_of(m);
    return wave;
}

/** Among the waves with m nodes the longest one is an LP wave. */
hd_wave_limits hd_circle_limits(const hd_scene_def *def)
{
    hd_wave_limits limits = {INFINITY, PI * sqrt(def->density), 0};
    const double reach = hd_circle_reach(def), most = limits.largest * reach;
    limits.node = (int)fmin(most, 1e6);
    while (limits.node > 0 &&
           next_root(false, limits.node, before_roots(false, limits.node)) > most)
        limits.node--;
    if (limits.node > 0) limits.smallest = next_root(false, 1, before_roots(false, 1)) / reach;
    return limits;
}

void hd_circle_waves(const hd_scene_def *def, hd_wave_taker take, void *to)
{
    const double reach = hd_circle_reach(def), limit = hd_wave_limit(def) * (1.0 + 1e-12);
    const int nodes = hd_wave_nodes(def, hd_circle_limits(def).node);
    for (int transverse = 0; transverse < 2; transverse++)
        for (int m = 0; m <= nodes; m++) {
            double root = before_roots(transverse, m);
            for (int n = 1; n <= nodes; n++) {
                root = next_root(transverse, m, root);
                if (root > limit * reach) break;
                const hd_wave wave = wave_of(reach, transverse, m, n, root);
                take(to, &wave);
            }
        }
}

int hd_circle_waves_usual(const hd_scene_def *def)
{
    (void)def;
    return 12;
}

/* ---- modulations ---------------------------------------------------------------------------- */

/** Entries of own[HD_WAVE_OWN]. HARMONIC is 0 for L and P fields, and J_m(k reach) for T fields, so
 * that their A vanishes at the wall. */
enum { M, K, CENTRE, REACH, HARMONIC };

/** A radial function, its derivative, and m times its quotient by r. */
typedef struct radial {
    double value, along, across;
} radial;

/** Computed from J_(m-1) and J_(m+1) without division by r: J_m' is half their difference, and
 * m J_m(x) / x half their sum. */
static radial bessel(int m, double k, double r)
{
    const double below = m > 0 ? jn(m - 1, k * r) : -jn(1, k * r), above = jn(m + 1, k * r);
    return (radial){jn(m, k * r), 0.5 * k * (below - above), 0.5 * k * (below + above)};
}

void hd_circle_of_wave(const hd_scene_def *def, const hd_wave *wave, double *own)
{
    const double reach = hd_circle_reach(def), k = wave->number;
    own[M] = wave->n[0];
    own[K] = k;
    own[CENTRE] = hd_circle_radius(def);
    own[REACH] = reach;
    own[HARMONIC] = wave->transverse.count > 0 ? jn(wave->n[0], k * reach) : 0.0;
}

/** The Bessel function minus the harmonic one. */
static radial at(const double *own, double r)
{
    const int m = (int)own[M];
    const double part = m > 0 ? pow(r / own[REACH], m - 1) : 0.0;
    radial f = bessel(m, own[K], r);
    const double slope = m > 0 ? own[HARMONIC] / own[REACH] * part : 0.0;
    f.value -= m > 0 ? slope * r : own[HARMONIC];
    f.along -= m * slope;
    f.across -= m * slope;
    return f;
}

void hd_circle_modulations(hd_modulation *out, const double *own, const double *q)
{
    const double x = q[0] - own[CENTRE], y = q[1] - own[CENTRE], r = hypot(x, y);
    const radial f = at(own, r);
    const double complex direction = r > 0 ? (x + I * y) / r : 1.0;
    double complex turned = 1.0; /* e^(i m theta) */
    for (int n = 0; n < (int)own[M]; n++) turned *= direction;
    const double part[2] = {creal(turned), cimag(turned)}, other[2] = {-part[1], part[0]};
    const double c = creal(direction), s = cimag(direction);
    for (int sine = 0; sine < 2; sine++) {
        const double u = f.along * part[sine], v = f.across * other[sine];
        out[sine] = (hd_modulation){f.value * part[sine], u * c - v * s, u * s + v * c};
    }
}
