/** Cosines and sines of x, y and z -> T, L = grad A and P = p A of A = f(x) g(y) h(z) [T22].
 *
 * With s_d = A derived along d over k_d, or A itself where there are no nodes along d, grad A is
 * (k_d s_d), and the divergence of (e_d s_d) is -A sum e_d k_d: each e across k is a transverse
 * field. */
#include "modes/plane_fields.h"

#include <math.h>
#include <string.h>

static void cross(double out[HD_DIM], const double a[HD_DIM], const double b[HD_DIM])
{
    for (int d = 0; d < HD_DIM; d++)
        out[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

static double length_of(const double a[HD_DIM]) { return hypot(hypot(a[0], a[1]), a[2]); }

/** Unit vectors across k: the first one in the plane across `axis`, along x if k is along it. */
static void across(double e[2][HD_DIM], const double k[HD_DIM], int axis)
{
    const double unit[HD_DIM] = {axis == 0, axis == 1, axis == 2},
                 along_x[HD_DIM] = {1.0, 0.0, 0.0};
    cross(e[0], unit, k);
    if (length_of(e[0]) == 0) memcpy(e[0], along_x, sizeof along_x);
    cross(e[1], k, e[0]);
    for (int field = 0; field < 2; field++) {
        const double length = length_of(e[field]);
        for (int d = 0; d < HD_DIM; d++) e[field][d] /= length;
    }
}

/** A, and s. */
static double products(double s[HD_DIM], const hd_wave *wave, const hd_harmonics along[HD_DIM],
                       unsigned bits)
{
    double value[HD_DIM];
    for (int d = 0; d < HD_DIM; d++)
        value[d] = along[d].value[2 * wave->n[d] + (int)(bits >> d & 1)];
    for (int d = 0; d < HD_DIM; d++) {
        const double derived = along[d].derivative[2 * wave->n[d] + (int)(bits >> d & 1)];
        s[d] = (wave->n[d] > 0 ? derived / wave->k[d] : value[d]) * value[(d + 1) % 3] *
               value[(d + 2) % 3];
    }
    return value[0] * value[1] * value[2];
}

static void fill_transverse(double *const row[HD_DIM], const hd_subspace *s,
                            const hd_harmonics along[HD_DIM])
{
    double e[2][HD_DIM], product[HD_DIM];
    int axis = HD_DIM - 1;
    for (int d = 0; d < HD_DIM; d++) /* nothing goes through a wall */
        if (s->wave.n[d] == 0 && along[d].offset > 0) axis = d;
    across(e, s->wave.k, axis);
    for (int c = 0; c < s->modulations.count; c++) {
        const unsigned bits = s->modulations.bits[c];
        products(product, &s->wave, along, bits & (HD_SECOND - 1));
        for (int d = 0; d < HD_DIM; d++)
            row[d][s->column + c] = e[(bits & HD_SECOND) != 0][d] * product[d];
    }
}

void hd_plane_fields_fill(double *const row[HD_DIM], const hd_subspace *s,
                          const hd_harmonics along[HD_DIM], const double *p)
{
    if (s->kind == HD_MODE_T) {
        fill_transverse(row, s, along);
        return;
    }
    for (int c = 0; c < s->modulations.count; c++) {
        double product[HD_DIM];
        const double a = products(product, &s->wave, along, s->modulations.bits[c]);
        for (int d = 0; d < HD_DIM; d++) {
            row[d][s->column + c] = s->wave.k[d] * product[d];
            row[d][s->column + c + s->modulations.count] = p[d] * a;
        }
    }
}
