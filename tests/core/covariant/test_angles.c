/** Principal angles of spaces made so that they are known. */
#include "testing.h"
#include "covariant/angles.h"
#include "base/random.h"

OWNABLE(hd_angles)

enum { ROWS = 40, A = 12, B = 7 };

/** All columns take part in `count` reflections of random directions: a rotation of everything. */
static void turn(double *c, int columns, hd_random *random)
{
    for (int k = 0; k < ROWS; k++) {
        double v[ROWS], norm = 0.0;
        for (int row = 0; row < ROWS; row++) {
            v[row] = hd_random_symmetric(random);
            norm += v[row] * v[row];
        }
        for (int col = 0; col < columns; col++) {
            double dot = 0.0;
            for (int row = 0; row < ROWS; row++) dot += v[row] * c[col * ROWS + row];
            for (int row = 0; row < ROWS; row++) c[col * ROWS + row] -= 2.0 * dot / norm * v[row];
        }
    }
}

/** Each column takes up a part of the one before: the same span, oblique. */
static void mix(double *c, int columns, double part)
{
    for (int col = 1; col < columns; col++)
        for (int row = 0; row < ROWS; row++)
            c[col * ROWS + row] = (1 - part) * c[col * ROWS + row] +
                                  part * c[(col - 1) * ROWS + row];
}

/** A columns e_1 .. e_A, then B columns turned out of the first of them by the angles. */
static double *made(const double *angle, double part)
{
    hd_random random = hd_random_seeded(4, 0);
    double *c = calloc((A + B) * ROWS, sizeof *c);
    for (int col = 0; col < A; col++) c[col * ROWS + col] = 1.0;
    for (int col = 0; col < B; col++) {
        c[(A + col) * ROWS + col] = cos(angle[col]);
        c[(A + col) * ROWS + A + col] = sin(angle[col]);
    }
    mix(c, A, part);
    mix(c + A * ROWS, B, part);
    turn(c, A + B, &random);
    return c;
}

TEST(known_angles_are_found)
{
    const double angle[B] = {1e-9, 1e-4, 0.01, PI / 4 - 1e-6, PI / 4 + 1e-6, 1.5, PI / 2};
    const double parts[] = {0.0, 0.5, 0.9};
    MADE(hd_angles, angles, ROWS, A);
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        double *c = made(angle, parts[k]), found[A];
        const hd_span a = {0, A}, b = {A, B};
        const double rounding = parts[k] > 0.8 ? 1e-7 : 1e-13; /* oblique columns: (1 - part)^-B */
        CHECK_OK(hd_angles_between(angles, found, c, a, b));
        for (int col = 0; col < B; col++) CHECK_CLOSE(found[col], angle[col], rounding);
        CHECK_OK(hd_angles_between(angles, found, c, b, a));
        for (int col = 0; col < B; col++) CHECK_CLOSE(found[col], angle[col], rounding);
        free(c);
    }
}

TEST(one_vector_and_another)
{
    double c[2 * ROWS] = {0}, found;
    MADE(hd_angles, angles, ROWS, 1);
    c[3] = 2.0;
    c[ROWS + 3] = -5.0;
    c[ROWS + 7] = 5.0;
    const hd_span a = {0, 1}, b = {1, 1};
    CHECK_OK(hd_angles_between(angles, &found, c, a, b));
    CHECK_CLOSE(found, PI / 4, 4 * DBL_EPSILON);
    CHECK_OK(hd_angles_between(angles, &found, c, a, a));
    CHECK_CLOSE(found, 0.0, 4 * DBL_EPSILON);
}

/** The first columns of a triangle: as if nobody knew what they span. */
TEST(first_columns_of_a_triangle_span_coordinates)
{
    hd_random random = hd_random_seeded(3, 1);
    double c[ROWS * ROWS] = {0}, found[ROWS], want[ROWS];
    MADE(hd_angles, angles, ROWS, ROWS / 2);
    for (int col = 0; col < ROWS; col++)
        for (int row = 0; row <= col; row++)
            c[col * ROWS + row] = hd_random_symmetric(&random) + (row == col);
    const hd_span first = {0, ROWS / 2}, others[] = {{ROWS / 2, ROWS / 2}, {ROWS / 2, 2}};
    for (int k = 0; k < 2; k++) {
        CHECK_OK(hd_angles_leading(angles, found, c, first.count, others[k]));
        CHECK_OK(hd_angles_between(angles, want, c, first, others[k]));
        for (int col = 0; col < others[k].count; col++) CHECK_CLOSE(found[col], want[col], 1e-11);
    }
}

TEST(dependent_columns_are_refused)
{
    const double angle[B] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, wrong[] = {NAN, INFINITY};
    MADE(hd_angles, angles, ROWS, A);
    const hd_span a = {0, A}, b = {A, B};
    for (size_t k = 0; k < 4; k++) {
        double *c = made(angle, 0.3), found[A];
        if (k < 2) c[(A + 2) * ROWS + 5] = wrong[k];
        if (k == 2) memset(c + 3 * ROWS, 0, ROWS * sizeof *c);
        if (k == 3) memcpy(c + (A + 4) * ROWS, c + (A + 1) * ROWS, ROWS * sizeof *c);
        assert_int_equal(hd_angles_between(angles, found, c, a, b), HD_ILL_CONDITIONED);
        free(c);
    }
}
