/** One particle in the plane -> coefficients of the functionals [T15]; functionals_in_space.c has
 * those in space. */
#include "observe/functionals.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "scene/ends.h"

/** A modulation at one place: its value, and the derivatives that are not multiples of it. */
typedef struct modulation {
    double a, x, y, xy;
} modulation;

/** cos or sin of k u, and its derivative. */
static void function_at(double *value, double *derivative, double k, double u, bool sine)
{
    *value = sine ? sin(k * u) : cos(k * u);
    *derivative = k * (sine ? cos(k * u) : -sin(k * u));
}

static modulation modulation_at(const hd_boundary *boundary, const hd_wave *wave, unsigned bits,
                                const double *q)
{
    double f, df, g, dg;
    const double u = q[0] - (hd_is_wall(boundary[0]) ? 0.5 : 0.0);
    const double v = q[1] - (hd_is_wall(boundary[1]) ? 0.5 : 0.0);
    function_at(&f, &df, wave->k[0], u, bits & HD_SIN_X);
    function_at(&g, &dg, wave->k[1], v, bits & HD_SIN_Y);
    return (modulation){f * g, df * g, f * dg, df * dg};
}

/** Fills in the coefficients of [T15], with A of the density and B of the transverse momentum; A_xx
 * = -kx^2 A, A_yy = -ky^2 A. */
static void fill(hd_functionals out, const hd_wave *wave, const modulation *A, const modulation *B,
                 const double *p)
{
    const double k = wave->number, kx2 = wave->k[0] * wave->k[0], ky2 = wave->k[1] * wave->k[1];
    const double p2 = p[0] * p[0] + p[1] * p[1];
    const double here[4][4] = {
        {A->x / k, A->y / k, 0.0, 0.0},
        {(-kx2 * p[0] * A->a + p[1] * A->xy) / k, (p[0] * A->xy - ky2 * p[1] * A->a) / k, A->x / k,
         A->y / k},
        {(p[0] * B->xy + kx2 * p[1] * B->a) / k, (-ky2 * p[0] * B->a - p[1] * B->xy) / k, B->y / k,
         -B->x / k},
        {p2 * A->x, p2 * A->y, 2.0 * p[0] * A->a, 2.0 * p[1] * A->a},
    };
    for (int r = 0; r < 4; r++) memcpy(out[r], here[r], sizeof here[r]);
}

/** The bits of the modulation with sines along reflecting directions, which transverse fields have.
 */
static unsigned transverse_bits(const hd_boundary *boundary, unsigned bits)
{
    if (hd_is_wall(boundary[0])) bits |= HD_SIN_X;
    if (hd_is_wall(boundary[1])) bits |= HD_SIN_Y;
    return bits;
}

static void in_plane(hd_functionals out, const hd_wave *wave, unsigned bits,
                     const hd_boundary *boundary, const double *q, const double *p)
{
    const modulation a = modulation_at(boundary, wave, bits, q);
    const modulation b = modulation_at(boundary, wave, transverse_bits(boundary, bits), q);
    fill(out, wave, &a, &b, p);
}

void hd_functionals_at(hd_functionals out, int dimension, const hd_wave *wave, unsigned bits,
                       const hd_boundary *boundary, const double *q, const double *p)
{
    if (dimension == 2)
        in_plane(out, wave, bits, boundary, q, p);
    else
        hd_functionals_in_space(out, wave, bits, boundary, q, p);
}
