/** A place -> Bessel functions and their gradients [T21]. */
#define _XOPEN_SOURCE 700 /* jn */

#include "modes/circle_fields.h"

#include <complex.h>
#include <math.h>

/** By J_(m-1) and J_(m+1), which need no quotient by r: J_m' is half their difference, m J_m(x) / x
 * half their sum. */
void hd_circle_modulations(hd_circle_modulation out[2], const hd_wave *wave, double x, double y)
{
    const int m = wave->n[0];
    const double k = wave->number, r = hypot(x, y);
    const double below = m > 0 ? jn(m - 1, k * r) : -jn(1, k * r), above = jn(m + 1, k * r);
    const double along = 0.5 * k * (below - above), across = 0.5 * k * (below + above);
    const double complex direction = r > 0 ? (x + I * y) / r : 1.0;
    double complex turned = 1.0; /* e^(i m theta) */
    for (int n = 0; n < m; n++) turned *= direction;
    const double part[2] = {creal(turned), cimag(turned)}, other[2] = {-part[1], part[0]};
    const double c = creal(direction), s = cimag(direction);
    for (int sine = 0; sine < 2; sine++) {
        const double radial = along * part[sine], angular = across * other[sine];
        out[sine] = (hd_circle_modulation){jn(m, k * r) * part[sine], radial * c - angular * s,
                                           radial * s + angular * c};
    }
}
