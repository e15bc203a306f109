/** Walls that shear (Chernov and Lebowitz, J. Stat. Phys. 86, 953 (1997), model II): they turn the
 * velocity of a disk and keep its speed [T27]. Angles are computed with + - * / sqrt alone, so that
 * all machines give the same bits, and to a few roundings of the smaller one of an angle and what
 * it lacks of pi, so that a disk which grazes a wall leaves it. */
#include <math.h>

#include "scene/ends.h"

static const double PI = 3.14159265358979323846;

/** An angle 0 .. pi to the wall, and what it lacks of pi. */
typedef struct angle {
    double from, to;
} angle;

/** Arc tangent of y / x, 0 .. pi / 2, of a unit vector: half of the angle has the tangent y / (1 +
 * x); three more halves leave less than 0.1, for which the series has nine terms. */
static double arc_tangent(double y, double x)
{
    double t = y / (1.0 + x), series = 0.0;
    for (int half = 0; half < 3; half++) t /= 1.0 + sqrt(1.0 + t * t);
    for (int k = 17; k >= 1; k -= 2) series = 1.0 / k - t * t * series;
    return 16.0 * t * series;
}

/** Cosine and sine of x = 0 .. pi / 2, both times nearly 1, by the series of a quarter of it, which
 * is doubled twice. */
static void cosine_sine(double out[2], double x)
{
    const double y = 0.25 * x;
    double c = 1.0, s = 1.0;
    for (int k = 14; k >= 2; k -= 2) c = 1.0 - y * y / (k * (k - 1)) * c;
    for (int k = 13; k >= 3; k -= 2) s = 1.0 - y * y / (k * (k - 1)) * s;
    s *= y;
    for (int doubled = 0; doubled < 2; doubled++) {
        const double both = 2.0 * s * c;
        c = c * c - s * s;
        s = both;
    }
    out[0] = c;
    out[1] = s;
}

/** The angle phi of the unit vector (u, v), v > 0. */
static angle angle_of(double u, double v)
{
    const double least = arc_tangent(v, fabs(u));
    return u >= 0 ? (angle){least, PI - least} : (angle){PI - least, least};
}

/** psi = pi + b - root, written without the difference of large numbers, for both ends. */
static angle turned(angle phi, double b, double root)
{
    return (angle){phi.from * (phi.from + 2.0 * b) / (PI + b + root),
                   phi.to * (2.0 * (PI + b) - phi.to) / (root + b)};
}

/** In the frame of the wall, p = side s (u, v), and side s (cos psi, -sin psi) after it. told: the
 * direction in which the disk leaves, of the length d psi / d phi. */
static double meet(const hd_scene_def *scene, double *p, double *told, int d)
{
    const int a = 1 - d;
    const double b = scene->shear_b, square = p[0] * p[0] + p[1] * p[1], speed = sqrt(square),
                 side = p[d] > 0 ? 1.0 : -1.0, v = side * p[d] / speed;
    const angle phi = angle_of(side * p[a] / speed, v);
    const double root = sqrt(b * b + phi.to * (2.0 * (PI + b) - phi.to));
    const double slope = (phi.from + b) / root;
    const angle psi = turned(phi, b, root);
    double w[2];
    cosine_sine(w, psi.from <= psi.to ? psi.from : psi.to);
    if (psi.from > psi.to) w[0] = -w[0];
    told[a] = side * slope * w[0];
    told[d] = -side * slope * w[1];
    /* not divided by the length of w: rounding near 1 has a preferred side, and energy would drift
     */
    const double along = speed * w[0], across = speed * w[1],
                 lack = (square - (along * along + across * across)) / (2.0 * square);
    p[a] = side * (along + along * lack);
    p[d] = -side * (across + across * lack);
    return slope * w[1] / v;
}

static hd_wall_map map(const double *p, const double *told, int d)
{
    const int a = 1 - d;
    const double speed = sqrt(p[0] * p[0] + p[1] * p[1]), side = p[d] > 0 ? 1.0 : -1.0,
                 slope = sqrt(told[0] * told[0] + told[1] * told[1]);
    const double u = side * p[a] / speed, v = side * p[d] / speed;
    const double c = side * told[a] / slope, s = -side * told[d] / slope;
    return (hd_wall_map){.slip = (c - u) / v,
                         .rebound = -s / v,
                         .turn = {{c * u + slope * s * v, c * v - slope * s * u},
                                  {slope * c * v - s * u, -s * v - slope * c * u}}};
}

/** d psi / d phi = (phi + b) / root is at least b / (pi + b), and at most its inverse. */
static const char *fault(const double *told)
{
    const double square = told[0] * told[0] + told[1] * told[1], least = 0.01 / (PI + 0.01);
    return square > 0.99 * least * least && square < 1.01 / (least * least)
               ? NULL
               : "a wall turns a velocity by an impossible angle";
}

const hd_ends hd_shearing_ends = {
    .word = "shearing", .is_wall = true, .drags = true, .meet = meet, .map = map, .fault = fault};
