/** Square u of a distance -> V = f(u), b = 2 f'(u), c = 4 f''(u). A new potential takes a function
 * and a row. They use + - * / only, so that all machines give the same bits. */
#include "dynamics/soft/potential.h"

/** V = 100 (1 - r^2)^4. */
static hd_pull power(double u)
{
    const double x = 1.0 - u, square = x * x;
    return (hd_pull){100.0 * square * square, -800.0 * square * x, 4800.0 * square};
}

/** V = 4 (r^-12 - r^-6). */
static hd_pull twelve_six(double u)
{
    const double per = 1.0 / u, w = per * per * per;
    return (hd_pull){4.0 * w * (w - 1.0), -24.0 * w * (2.0 * w - 1.0) * per,
                     96.0 * w * (7.0 * w - 2.0) * per * per};
}

static hd_pull weeks_chandler_andersen(double u)
{
    hd_pull pull = twelve_six(u);
    pull.v += 1.0;
    return pull;
}

/** twelve_six, from r = 2 on times s = 1 - 10 x^3 + 15 x^4 - 6 x^5, which is 0 at r = 2.5. */
static hd_pull lennard_jones(double u)
{
    const double from = 4.0, per = 1.0 / 2.25;
    const hd_pull f = twelve_six(u);
    if (u <= from) return f;
    const double x = (u - from) * per, y = 1.0 - x;
    const double s = 1.0 - x * x * x * (10.0 - x * (15.0 - 6.0 * x));
    const double s1 = -60.0 * per * x * x * y * y;
    const double s2 = -240.0 * per * per * x * y * (1.0 - 2.0 * x);
    return (hd_pull){f.v * s, f.b * s + f.v * s1, f.c * s + 2.0 * f.b * s1 + f.v * s2};
}

const hd_potential hd_potentials[HD_POTENTIALS] = {
    [HD_POWER] = {"power", 1.0, 3, 38400.0, 1e-6, 0.0, power},
    /* 2^(1/6), 36 2^(2/3) */
    [HD_WCA] = {"wca", 1.1224620483093730, 1, 57.1464, 5e-5, 0.0, weeks_chandler_andersen},
    [HD_LENNARD_JONES] = {"lennard_jones", 2.5, 2, 23.3, 1e-6, 1.0, lennard_jones}};
