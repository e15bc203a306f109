/** Cosines and sines of x, y and z -> T, L = grad A and P = p A of A = f(x) g(y) h(z) [T22].
 *
 * With s_d = A derived along d over k_d, or A itself where there are no nodes along d, grad A is
 * (k_d s_d), and the divergence of (e_d s_d) is -A sum e_d k_d: each e across k is a transverse
 * field. */
#include "modes/plane_fields.h"

/** Returns A, and fills s. */
static double products(double *s, const hd_wave *wave, const hd_harmonics *along, unsigned bits)
{
    double value[3];
    for (int d = 0; d < 3; d++) value[d] = along[d].value[2 * wave->n[d] + (int)(bits >> d & 1)];
    for (int d = 0; d < 3; d++) {
        const double derived = along[d].derivative[2 * wave->n[d] + (int)(bits >> d & 1)];
        s[d] = (wave->n[d] > 0 ? derived / wave->k[d] : value[d]) * value[(d + 1) % 3] *
               value[(d + 2) % 3];
    }
    return value[0] * value[1] * value[2];
}

static void fill_transverse(double *const *row, const hd_subspace *s, const hd_harmonics *along)
{
    double product[3];
    for (int c = 0; c < s->modulations.count; c++) {
        const unsigned bits = s->modulations.bits[c];
        products(product, &s->wave, along, bits & (HD_SECOND - 1));
        for (int d = 0; d < 3; d++)
            row[d][s->column + c] = s->wave.across[(bits & HD_SECOND) != 0][d] * product[d];
    }
}

void hd_space_fields_fill(double *const *row, const hd_subspace *s, const hd_harmonics *along,
                          const double *p)
{
    if (s->kind == HD_MODE_T) {
        fill_transverse(row, s, along);
        return;
    }
    for (int c = 0; c < s->modulations.count; c++) {
        double product[3];
        const double a = products(product, &s->wave, along, s->modulations.bits[c]);
        for (int d = 0; d < 3; d++) {
            row[d][s->column + c] = s->wave.k[d] * product[d];
            row[d][s->column + c + s->modulations.count] = p[d] * a;
        }
    }
}
