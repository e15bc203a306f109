/** Covariant vectors through triangles: against substitution by hand, eigenvectors, and what they
 * must map into. */
#include "testing.h"
#include "covariant/backward.h"
#include "base/random.h"

OWNABLE(hd_backward)

/** Row-major upper triangle, its diagonal exp(-decay * l); below it what must not be read. */
static double *triangle(int n, double decay, uint64_t stream)
{
    hd_random random = hd_random_seeded(5, stream);
    double *r = malloc((size_t)(n * n) * sizeof *r);
    for (int row = 0; row < n; row++)
        for (int col = 0; col < n; col++) {
            const double size = exp(-decay * row);
            r[row * n + col] = col < row    ? NAN
                               : col == row ? size
                                            : size * hd_random_symmetric(&random);
        }
    return r;
}

static hd_backward *started(int n, uint64_t stream)
{
    hd_backward *backward;
    CHECK_OK(hd_backward_create(&backward, n));
    hd_backward_start(backward, 3, stream);
    return backward;
}

static double *copied(const hd_backward *backward, int n)
{
    const size_t size = (size_t)n * (size_t)n * sizeof(double);
    double *c = malloc(size);
    memcpy(c, hd_backward_read(backward), size);
    return c;
}

/** Tolerance: with u = DBL_EPSILON / 2 and n terms that are all positive, the length has n u / 2 of
 * its sum and 4 u of its terms and its root, whichever way BLAS goes; inverse and product add u
 * each. The square has all of it twice, and the sum here n u and u more: (2 n + 13) u at the worst.
 */
static void check_upper_with_length_1(const double *c, int n)
{
    const double tolerance = (n + 8) * DBL_EPSILON;
    for (int col = 0; col < n; col++) {
        double sum = 0.0;
        for (int row = 0; row < n; row++) {
            if (row > col) assert_true(c[col * n + row] == 0.0);
            sum += c[col * n + row] * c[col * n + row];
        }
        CHECK_CLOSE(sum, 1.0, tolerance);
    }
}

/** |C^-1 b| for some b: a triangle of equally random entries makes it grow by powers of two with
 * each row. */
static void check_well_conditioned(const double *c, int n)
{
    double *x = calloc((size_t)n, sizeof *x), sum = 0.0;
    for (int row = n - 1; row >= 0; row--) {
        double left = row % 2 ? 1.0 : -1.0;
        for (int col = row + 1; col < n; col++) left -= c[col * n + row] * x[col];
        x[row] = left / c[row * n + row];
        sum += x[row] * x[row];
    }
    assert_true(sqrt(sum / n) < 10.0);
    free(x);
}

TEST(a_start_leans_out_of_each_span)
{
    enum { N = 300 };
    OWNED(hd_backward) *one = started(N, 1), *same = started(N, 1), *other = started(N, 2);
    check_upper_with_length_1(hd_backward_read(one), N);
    for (int col = 0; col < N; col++) assert_true(hd_backward_read(one)[col * N + col] >= 0.5);
    check_well_conditioned(hd_backward_read(one), N);
    assert_memory_equal(hd_backward_read(one), hd_backward_read(same), N * N * sizeof(double));
    assert_true(hd_backward_apart(one, other, N - 1) > 0.5);
}

/** R c = c' exp(growth), for sizes on both sides of a panel's width; nothing below the diagonal is
 * read. */
TEST(each_vector_is_mapped_onto_the_later_one)
{
    const int sizes[] = {1, 2, 17, 95, 96, 97, 250};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const int n = sizes[k];
        OWNED(hd_backward) *backward = started(n, 1);
        HEAP double *later = copied(backward, n), *r = triangle(n, 4.0 / n, k),
                    *growth = malloc((size_t)n * sizeof *growth);
        CHECK_OK(hd_backward_step(backward, growth, r));
        const double *c = hd_backward_read(backward);
        check_upper_with_length_1(c, n);
        for (int col = 0; col < n; col++)
            for (int row = 0; row < n; row++) {
                double mapped = 0.0, size = 0.0;
                for (int m = row; m <= col; m++) {
                    mapped += r[row * n + m] * c[col * n + m];
                    size += fabs(r[row * n + m] * c[col * n + m]);
                }
                CHECK_CLOSE(mapped * exp(-growth[col]), later[col * n + row],
                            64 * DBL_EPSILON * (1.0 + size * exp(-growth[col])));
            }
    }
}

/** The same triangle again and again: C converges to its eigenvectors as the ratio of neighbouring
 * eigenvalues, the growth to their logarithms, from any start. */
TEST(converges_to_eigenvectors)
{
    enum { N = 12, STEPS = 60 };
    const double decay = 0.5;
    OWNED(hd_backward) *one = started(N, 1), *other = started(N, 2);
    double *r = triangle(N, decay, 9), growth[N], unused[N];
    double before = 0.0;
    for (int step = 0; step < STEPS; step++) {
        CHECK_OK(hd_backward_step(one, growth, r));
        CHECK_OK(hd_backward_step(other, unused, r));
        const double apart = hd_backward_apart(one, other, N - 1);
        if (step == 30) CHECK_CLOSE(apart / before, exp(-decay), 0.01);
        before = apart;
    }
    const double *c = hd_backward_read(one);
    for (int col = 0; col < N; col++) {
        CHECK_CLOSE(growth[col], -decay * col, 1e-10);
        CHECK_CLOSE(hd_backward_apart(one, other, col), 0.0, 1e-10);
        for (int row = 0; row <= col; row++) {
            double mapped = 0.0;
            for (int m = row; m <= col; m++) mapped += r[row * N + m] * c[col * N + m];
            CHECK_CLOSE(mapped, exp(-decay * col) * c[col * N + row], 1e-10);
        }
    }
    free(r);
}

TEST(apart_is_the_sine)
{
    const double angles[] = {0.0, 1e-15, 1e-9, 0.3, 1.2, 1.57};
    for (size_t k = 0; k < sizeof angles / sizeof *angles; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            OWNED(hd_backward) *one = started(2, 1), *other = started(2, 2);
            double *x = hd_backward_data(one) + 2, *y = hd_backward_data(other) + 2;
            x[0] = 0.0;
            x[1] = 1.0;
            y[0] = sign * sin(angles[k]);
            y[1] = sign * cos(angles[k]);
            CHECK_CLOSE(hd_backward_apart(one, other, 1), sin(angles[k]), 1e-7 * sin(angles[k]));
        }
}

TEST(what_is_no_number_is_refused)
{
    enum { N = 5 };
    const double wrong[] = {NAN, 0.0, INFINITY};
    for (int at = 0; at < N; at++)
        for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
            OWNED(hd_backward) *backward = started(N, 1);
            double *r = triangle(N, 0.1, 1), growth[N];
            r[at * (N + 1)] = wrong[k];
            assert_int_equal(hd_backward_step(backward, growth, r), HD_ILL_CONDITIONED);
            free(r);
        }
}

TEST(triangles_are_packed)
{
    for (int n = 1; n < 9; n++) {
        HEAP double *r = triangle(n, 0.1, 1),
                    *packed = malloc(hd_triangle_size(n) * sizeof *packed);
        HEAP double *again = malloc((size_t)(n * n) * sizeof *again);
        for (int k = 0; k < n * n; k++) again[k] = 7.0;
        hd_triangle_pack(packed, r, n);
        hd_triangle_unpack(again, packed, n);
        for (int row = 0; row < n; row++)
            for (int col = 0; col < n; col++)
                assert_true(again[row * n + col] == (col < row ? 7.0 : r[row * n + col]));
    }
}
