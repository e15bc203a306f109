/** Of spheres: measured in boxes of 8 : 1 : 1 at densities from 0.3 to 0.9, doc/findings.md. */
#include "modes/curvature.h"

/** Of c3 / c: how far densities lie off the formulae. */
static const double OFF = 0.15;

hd_relation hd_curvature_of(hd_mode_kind kind, double l)
{
    const bool t = kind == HD_MODE_T;
    hd_relation r = {
        .c2 = t ? 0.02 : 0.05 + 0.17 * l,
        .c2_error = t ? 0.015 : 0.03 + 0.04 * l,
        .c3 = t ? 0.01 + 0.87 * l * l : 0.18 + 0.8 * l * l,
        .scatter = t ? 0.001 : 0.002,
    };
    r.c3_error = OFF * r.c3 + (t ? 0.02 : 0.05);
    return r;
}
