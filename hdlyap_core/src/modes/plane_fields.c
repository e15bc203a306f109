/** Cosines and sines of x and y -> T = curl A, L = grad A and P = p A of A = f(x) g(y) [T10]. */
#include "modes/plane_fields.h"

void hd_plane_fields_fill(double *const *row, const hd_subspace *s, const hd_harmonics *along,
                          const double *p)
{
    double *x = row[0], *y = row[1];
    for (int c = 0; c < s->modulations.count; c++) {
        const unsigned bits = s->modulations.bits[c];
        const int at_x = 2 * s->wave.n[0] + (int)(bits & HD_SIN_X);
        const int at_y = 2 * s->wave.n[1] + (int)(bits >> 1);
        const double f = along[0].value[at_x], df = along[0].derivative[at_x];
        const double g = along[1].value[at_y], dg = along[1].derivative[at_y];
        const int column = s->column + c, pair = column + s->modulations.count;
        if (s->kind == HD_MODE_T) {
            x[column] = f * dg, y[column] = -df * g;
            continue;
        }
        x[column] = df * g, y[column] = f * dg;
        x[pair] = p[0] * f * g, y[pair] = p[1] * f * g;
    }
}
