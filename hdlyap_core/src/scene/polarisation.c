/** A wave -> directions of its transverse fields [T22]. */
#include "scene/polarisation.h"
#include "scene/ends.h"

#include <math.h>

static void cross(double *out, const double *a, const double *b)
{
    for (int d = 0; d < 3; d++)
        out[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

/** Scales a to length 1; a zero vector stays zero. */
static double normalise(double *a)
{
    const double length = hypot(hypot(a[0], a[1]), a[2]);
    for (int d = 0; d < 3 && length > 0; d++) a[d] /= length;
    return length;
}

/** No transverse field goes through a wall. If the wave has no nodes along a direction with walls,
 * the only field is across that direction; else there are two, and the first is across z. */
void hd_polarisations(double e[2][3], const hd_wave *wave, const hd_scene_def *def)
{
    double unit[3] = {0.0};
    int axis = 2, forbidden = 0;
    for (int d = 0; d < 3; d++)
        if (wave->n[d] == 0 && hd_is_wall(def->boundary[d])) axis = d, forbidden++;
    unit[axis] = 1.0;
    cross(e[0], unit, wave->k);
    if (normalise(e[0]) == 0) e[0][0] = 1.0;
    cross(e[1], wave->k, e[0]);
    normalise(e[1]);
    for (int d = 0; d < 3; d++) {
        if (forbidden > 0) e[1][d] = 0.0;
        if (forbidden > 1) e[0][d] = 0.0;
    }
}
