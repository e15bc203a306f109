/** One sphere -> coefficients of the functionals [T22].
 *
 * With a field F = (e_i s_i), e = k for L, across k for T, the momentum along it is sum p.F: it
 * changes by p_i d_j F_i dq_j + F_i dp_i. */
#include "observe/functionals.h"

#include <math.h>
#include <stdbool.h>

/** Functions of one coordinate: A's, and as s of its component has it; each with its derivative. */
typedef struct factor {
    double value, slope, own, own_slope;
} factor;

static factor factor_at(double k, double u, bool sine)
{
    const double c = cos(k * u), s = sin(k * u), value = sine ? s : c, slope = k * (sine ? c : -s);
    if (k == 0) return (factor){value, 0.0, value, 0.0};
    return (factor){value, slope, slope / k, -k * value};
}

/** A, or s_i, or their derivative along j; i = HD_DIM: A; j = HD_DIM: none. */
static double product(const factor f[HD_DIM], int i, int j)
{
    double all = 1.0;
    for (int d = 0; d < HD_DIM; d++)
        all *= d == i ? (d == j ? f[d].own_slope : f[d].own) : (d == j ? f[d].slope : f[d].value);
    return all;
}

/** Of the momentum along (e_i s_i). */
static void fill_momentum(double out[HD_ROWS], const factor f[HD_DIM], const double e[HD_DIM],
                          const double *p)
{
    for (int j = 0; j < HD_DIM; j++) {
        out[j] = 0.0;
        for (int i = 0; i < HD_DIM; i++) out[j] += p[i] * e[i] * product(f, i, j);
        out[HD_DIM + j] = e[j] * product(f, j, HD_DIM);
    }
}

void hd_functionals_at(double out[HD_FUNCTIONALS][HD_ROWS], const hd_wave *wave, unsigned bits,
                       const hd_boundary boundary[HD_DIM], const double *q, const double *p)
{
    enum { DENSITY, ALONG, ACROSS, ENERGY = ACROSS + 2 };
    factor f[HD_DIM];
    double along[HD_DIM];
    double p2 = 0.0;
    for (int d = 0; d < HD_DIM; d++) {
        const bool wall = boundary[d] == HD_REFLECTING;
        f[d] = factor_at(wave->k[d], q[d] - (wall ? 0.5 : 0.0), bits >> d & 1);
        along[d] = wave->k[d] / wave->number;
        p2 += p[d] * p[d];
    }
    fill_momentum(out[ALONG], f, along, p);
    fill_momentum(out[ACROSS], f, wave->across[0], p);
    fill_momentum(out[ACROSS + 1], f, wave->across[1], p);
    for (int d = 0; d < HD_DIM; d++) {
        const double slope = product(f, HD_DIM, d);
        out[DENSITY][d] = slope / wave->number;
        out[DENSITY][HD_DIM + d] = 0.0;
        out[ENERGY][d] = p2 * slope;
        out[ENERGY][HD_DIM + d] = 2.0 * p[d] * product(f, HD_DIM, HD_DIM);
    }
}
