/** One particle in space -> coefficients of the functionals [T22].
 *
 * The momentum along a field F = (e_i s_i), with e = k for L and e across k for T, is sum p.F; it
 * changes by p_i d_j F_i dq_j + F_i dp_i. */
#include "observe/functionals.h"

#include <math.h>
#include <stdbool.h>

#include "scene/ends.h"

/** Functions of one coordinate, with their derivatives: the factor of A, and that of s_i. */
typedef struct factor {
    double value, slope, own, own_slope;
} factor;

static factor factor_at(double k, double u, bool sine)
{
    const double c = cos(k * u), s = sin(k * u), value = sine ? s : c, slope = k * (sine ? c : -s);
    if (k == 0) return (factor){value, 0.0, value, 0.0};
    return (factor){value, slope, slope / k, -k * value};
}

/** s_i, or A if i = 3; its derivative along j, or the value itself if j = 3. */
static double product(const factor *f, int i, int j)
{
    double all = 1.0;
    for (int d = 0; d < 3; d++)
        all *= d == i ? (d == j ? f[d].own_slope : f[d].own) : (d == j ? f[d].slope : f[d].value);
    return all;
}

/** Fills in the coefficients of the momentum along (e_i s_i). */
static void fill_momentum(double *out, const factor *f, const double *e, const double *p)
{
    for (int j = 0; j < 3; j++) {
        out[j] = 0.0;
        for (int i = 0; i < 3; i++) out[j] += p[i] * e[i] * product(f, i, j);
        out[3 + j] = e[j] * product(f, j, 3);
    }
}

void hd_functionals_in_space(hd_functionals out, const hd_wave *wave, unsigned bits,
                             const hd_boundary *boundary, const double *q, const double *p)
{
    enum { DENSITY, ALONG, ACROSS, ENERGY = ACROSS + 2 };
    factor f[3];
    double along[3];
    double p2 = 0.0;
    for (int d = 0; d < 3; d++) {
        const bool wall = hd_is_wall(boundary[d]);
        f[d] = factor_at(wave->k[d], q[d] - (wall ? 0.5 : 0.0), bits >> d & 1);
        along[d] = wave->k[d] / wave->number;
        p2 += p[d] * p[d];
    }
    fill_momentum(out[ALONG], f, along, p);
    fill_momentum(out[ACROSS], f, wave->across[0], p);
    fill_momentum(out[ACROSS + 1], f, wave->across[1], p);
    for (int d = 0; d < 3; d++) {
        const double slope = product(f, 3, d);
        out[DENSITY][d] = slope / wave->number;
        out[DENSITY][3 + d] = 0.0;
        out[ENERGY][d] = p2 * slope;
        out[ENERGY][3 + d] = 2.0 * p[d] * product(f, 3, 3);
    }
}
