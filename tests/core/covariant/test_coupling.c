/** The triangle of all 4N vectors from that of half of them: as all of them have it. */
#include "conjugates.h"
#include "covariant/coupling.h"

OWNABLE(hd_coupling)

/** (R, X; 0, R^-T from behind) at row and column; X = R Y from behind, as its columns are. */
static double composed(const double *r, const double *y, const double *inverse, int half, int row,
                       int col)
{
    const int all = 2 * half, behind = all - 1 - col;
    double sum = 0.0;
    if (row > col) return 0.0;
    if (col < half) return r[row * half + col];
    if (row >= half) return inverse[behind * half + all - 1 - row]; /* R^-T = transposed */
    for (int k = row; k < half; k++) sum += r[row * half + k] * y[k * half + behind];
    return sum;
}

static void invert(double *inverse, const double *r, int n)
{
    for (int col = 0; col < n; col++)
        for (int row = n - 1; row >= 0; row--) {
            double sum = row == col;
            for (int k = row + 1; k <= col; k++) sum -= r[row * n + k] * inverse[k * n + col];
            inverse[row * n + col] = row > col ? 0.0 : sum / r[row * n + row];
        }
}

/** Entries of a column are known to eps times its length, times what the frames differ by. */
static void check_triangle_of_all(const conjugates *x, const double *y)
{
    const int half = x->rows / 2, all = x->rows;
    const double *r = hd_ortho_factor(x->ortho[HALF]), *want = hd_ortho_factor(x->ortho[WHOLE]);
    HEAP double *inverse = malloc((size_t)(half * half) * sizeof *inverse);
    invert(inverse, r, half);
    for (int col = 0; col < all; col++) {
        double length = 1.0;
        for (int row = 0; row <= col; row++) length = hypot(length, want[row * all + col]);
        for (int row = 0; row <= col; row++)
            CHECK_CLOSE(composed(r, y, inverse, half, row, col), want[row * all + col],
                        80.0 * DBL_EPSILON * x->condition * length);
    }
}

static void check_symmetric(const double *y, int half)
{
    for (int row = 0; row < half; row++)
        for (int col = 0; col < row; col++) assert_true(y[row * half + col] == y[col * half + row]);
}

/** Below and above the width of a panel. */
TEST(half_of_it_and_a_coupling_are_the_triangle_of_all)
{
    const int sizes[] = {3, 10, 60};
    const hd_boundary y[] = {P, R, P};
    for (int s = 0; s < 3; s++) {
        HELD(conjugates) x = conjugates_of(scene_of(sizes[s], 0.5, 0.9, P, y[s], 5));
        MADE(hd_coupling, coupling, PARTICLES(sizes[s]), 1);
        for (int k = 0; k < 12; k++) {
            conjugates_interval(&x, 0.3);
            CHECK_OK(hd_coupling_measure(coupling, x.frame[HALF], hd_ortho_factor(x.ortho[HALF]),
                                         x.log, 0.0, x.log->duration));
            check_symmetric(hd_coupling_read(coupling), 2 * sizes[s]);
            check_triangle_of_all(&x, hd_coupling_read(coupling));
        }
    }
}

/** Entries of Y stay as they are however long the interval is: those of X grow with it. */
TEST(long_intervals_keep_a_coupling_small)
{
    HELD(conjugates) x = conjugates_of(scene_of(10, 0.5, 0.9, P, P, 5));
    double most = 0.0;
    MADE(hd_coupling, coupling, PARTICLES(10), 1);
    for (int k = 0; k < 40; k++) {
        const double end = hd_trajectory_time(x.trajectory) + (k < 20 ? 0.5 : 3.0);
        CHECK_OK(trajectory_to(x.trajectory, x.log, end));
        CHECK_OK(hd_frame_replay(x.frame[HALF], x.log, 0.0, x.log->duration));
        CHECK_OK(hd_ortho_step(x.ortho[HALF], x.frame[HALF], CONJUGATES_LIMITS));
        if (k < 20) continue;
        CHECK_OK(hd_coupling_measure(coupling, x.frame[HALF], hd_ortho_factor(x.ortho[HALF]), x.log,
                                     0.0, x.log->duration));
        for (int e = 0; e < 400; e++) most = fmax(most, fabs(hd_coupling_read(coupling)[e]));
    }
    CHECK_WITHIN(most, 0.0, 100.0);
}
