/** A place -> Bessel functions and their gradients [T21]. */
#define _XOPEN_SOURCE 700 /* jn */

#include "modes/circle_fields.h"

#include <complex.h>
#include <math.h>
#include <stdbool.h>

/** A radial function, its derivative, and m times its quotient by r. */
typedef struct radial {
    double value, along, across;
} radial;

/** By J_(m-1) and J_(m+1), which need no quotient by r: J_m' is half their difference, m J_m(x) / x
 * half their sum. */
static radial bessel(int m, double k, double r)
{
    const double below = m > 0 ? jn(m - 1, k * r) : -jn(1, k * r), above = jn(m + 1, k * r);
    return (radial){jn(m, k * r), 0.5 * k * (below - above), 0.5 * k * (below + above)};
}

hd_circle_wave hd_circle_wave_of(const hd_wave *wave, double reach)
{
    const int m = wave->n[0];
    const double k = wave->number;
    return (hd_circle_wave){m, k, reach, wave->transverse.count > 0 ? jn(m, k * reach) : 0.0};
}

/** Less the harmonic function. */
static radial at(const hd_circle_wave *wave, double r)
{
    const int m = wave->m;
    radial f = bessel(m, wave->k, r);
    const double slope = m > 0 ? wave->harmonic / wave->reach * pow(r / wave->reach, m - 1) : 0.0;
    f.value -= m > 0 ? slope * r : wave->harmonic;
    f.along -= m * slope;
    f.across -= m * slope;
    return f;
}

void hd_circle_modulations(hd_circle_modulation out[2], const hd_circle_wave *wave, double x,
                           double y)
{
    const double r = hypot(x, y);
    const radial f = at(wave, r);
    const double complex direction = r > 0 ? (x + I * y) / r : 1.0;
    double complex turned = 1.0; /* e^(i m theta) */
    for (int n = 0; n < wave->m; n++) turned *= direction;
    const double part[2] = {creal(turned), cimag(turned)}, other[2] = {-part[1], part[0]};
    const double c = creal(direction), s = cimag(direction);
    for (int sine = 0; sine < 2; sine++) {
        const double u = f.along * part[sine], v = f.across * other[sine];
        out[sine] = (hd_circle_modulation){f.value * part[sine], u * c - v * s, u * s + v * c};
    }
}

void hd_circle_fields_fill(double *const *row, const hd_subspace *subspace,
                           const hd_circle_wave *round, int subspaces, double centre,
                           const double *q, const double *p)
{
    double *x = row[0], *y = row[1];
    hd_circle_modulation at[2];
    for (int k = 0; k < subspaces; k++) {
        const hd_subspace *s = &subspace[k];
        const int count = s->modulations.count;
        hd_circle_modulations(at, &round[k], q[0] - centre, q[1] - centre);
        for (int c = 0, column = s->column; c < count; c++, column++) {
            const bool t = s->kind == HD_MODE_T;
            x[column] = t ? at[c].y : at[c].x, y[column] = t ? -at[c].x : at[c].y;
            if (!t) x[column + count] = p[0] * at[c].a, y[column + count] = p[1] * at[c].a;
        }
    }
}
