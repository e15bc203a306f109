/** Of disks: measured in long and wide boxes at densities from 0.2 to 0.8. In a thin gas k l
 * decides, l the mean free path, else k sigma. */
#include "modes/curvature.h"

/** Of c3 / c: how far densities lie off the formula. */
static const double OFF = 0.1;

hd_relation hd_curvature_of(hd_mode_kind kind, double l)
{
    const bool t = kind == HD_MODE_T;
    hd_relation r = {
        .c2 = t ? 0.02 : 0.11 + 0.16 * l,
        .c2_error = t ? 0.007 : 0.02 + 0.02 * l,
        .c3 = t ? 0.05 + 1.3 * l * l : 0.55 + 2.0 * l * l,
        .scatter = t ? 0.001 : 0.002,
    };
    r.c3_error = OFF * r.c3 + (t ? 0.01 : 0.0);
    return r;
}
