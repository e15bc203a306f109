/** Widths and angles of the halves of vectors whose answers are known. */
#include "testing.h"

enum { DISKS = 5, ROWS = 4 * DISKS, VECTORS = 3, STRIDE = 8 };

static hd_localization *created(void)
{
    hd_localization *shape;
    CHECK_OK(hd_localization_create(&shape, DISKS, DIM, VECTORS, 1));
    hd_localization_clear(shape);
    return shape;
}

static void add(hd_localization *shape, double v[ROWS][STRIDE])
{
    hd_localization_measure(shape, (hd_columns){&v[0][0], STRIDE, 0, VECTORS});
    hd_localization_add(shape);
}

/** Column 0 on one disk, column 1 on all alike, column 2 on two with parts 0.2 and 0.8. */
static void fill(double v[ROWS][STRIDE])
{
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < STRIDE; col++)
            v[row][col] = col < VECTORS ? 0.0 : NAN; /* padding */
    v[4 * 3 + 1][0] = 0.6;
    v[4 * 3 + 2][0] = -0.8;
    for (int row = 0; row < ROWS; row++) v[row][1] = sqrt(1.0 / ROWS) * (row % 3 ? 1.0 : -1.0);
    v[0][2] = sqrt(0.2);
    v[4 * 4 + 3][2] = -sqrt(0.8);
}

TEST(widths_are_those_of_known_vectors)
{
    double v[ROWS][STRIDE];
    OWNED(hd_localization) *shape = created();
    fill(v);
    add(shape, v);
    const double *width = hd_localization_widths(shape);
    CHECK_CLOSE(width[0], 1.0 / DISKS, 8 * DBL_EPSILON);
    CHECK_CLOSE(width[1], 1.0, 32 * DBL_EPSILON);
    CHECK_CLOSE(width[2], pow(0.2, -0.2) * pow(0.8, -0.8) / DISKS, 16 * DBL_EPSILON);
}

/** exp of the mean entropy, not the mean of the widths. */
TEST(entropies_are_averaged)
{
    double one[ROWS][STRIDE], other[ROWS][STRIDE];
    OWNED(hd_localization) *shape = created();
    fill(one);
    fill(other);
    for (int row = 0; row < ROWS; row++) other[row][0] = one[row][1];
    add(shape, one);
    add(shape, other);
    add(shape, other);
    CHECK_CLOSE(hd_localization_widths(shape)[0], pow(DISKS, 2.0 / 3.0) / DISKS, 64 * DBL_EPSILON);
    for (int k = 0; k < HD_SPECTRUM_BLOCKS_MIN; k++) add(shape, k % 3 ? one : other);
    assert_true(hd_localization_width_error(shape, 0) > 0);
    hd_localization_clear(shape);
    add(shape, one);
    CHECK_CLOSE(hd_localization_widths(shape)[0], 1.0 / DISKS, 8 * DBL_EPSILON);
    CHECK_CLOSE(hd_localization_width_error(shape, 0), -1.0, 0.0);
}

/** dq along one direction of all rows, dp turned out of it by an angle, of any length. */
static void halves(double v[ROWS][STRIDE], int col, double angle, double length)
{
    const double q = sqrt(1.0 - length * length);
    for (int row = 0; row < ROWS; row++) v[row][col] = 0.0;
    v[0][col] = 0.6 * q; /* dq = q (0.6, 0, ..; disk 2: y 0.8) */
    v[4 * 2 + 1][col] = 0.8 * q;
    v[2][col] = 0.6 * length * cos(angle);
    v[4 * 2 + 3][col] = 0.8 * length * cos(angle);
    v[4 * 1 + 2][col] = length * sin(angle);
}

TEST(cosines_are_those_of_known_angles)
{
    double v[ROWS][STRIDE];
    OWNED(hd_localization) *shape = created();
    fill(v);
    halves(v, 0, 1.0, 0.3);
    halves(v, 1, 3.0, 0.9); /* an obtuse angle counts as the acute one beside it */
    halves(v, 2, 1.0, 0.0); /* a half that vanishes has none */
    add(shape, v);
    CHECK_CLOSE(hd_localization_cosines(shape)[0], cos(1.0), 8 * DBL_EPSILON);
    CHECK_CLOSE(hd_localization_cosines(shape)[1], -cos(3.0), 8 * DBL_EPSILON);
    CHECK_CLOSE(hd_localization_cosines(shape)[2], 0.0, 0.0);
    halves(v, 0, 0.0, 0.3);
    halves(v, 2, 1.2, 1e-12);
    add(shape, v);
    CHECK_CLOSE(hd_localization_cosines(shape)[0], 0.5 * (cos(1.0) + 1.0), 8 * DBL_EPSILON);
    CHECK_CLOSE(hd_localization_cosines(shape)[2], 0.5 * cos(1.2), 8 * DBL_EPSILON);
}
