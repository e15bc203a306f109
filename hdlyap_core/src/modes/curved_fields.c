/** Modulations of a container -> T = curl A, L = grad A and P = p A [T10]. */
#include "modes/curved_fields.h"

void hd_curved_fields_fill(double *const *row, const hd_subspace *s,
                           const hd_container_row *container, const double *own, const double *q,
                           const double *p)
{
    double *x = row[0], *y = row[1];
    const int count = s->modulations.count;
    hd_modulation at[HD_TRANSVERSE_MAX];
    container->modulations(at, own, q);
    for (int c = 0, column = s->column; c < count; c++, column++) {
        const bool t = s->kind == HD_MODE_T;
        x[column] = t ? at[c].y : at[c].x, y[column] = t ? -at[c].x : at[c].y;
        if (!t) x[column + count] = p[0] * at[c].a, y[column + count] = p[1] * at[c].a;
    }
}
