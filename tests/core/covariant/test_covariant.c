/** Covariant vectors are what they are called: by the tangent flow, by sums that must hold, by
 * another way to them. */
#include "exact.h"
#include "passage.h"

OWNABLE(hd_backward)

static hd_scene_def few(int disks, hd_boundary x, hd_boundary y)
{
    return scene(.number = disks, .density = 0.5, .aspect = 0.9, .boundary[0] = x, .boundary[1] = y,
                 .seed = 3, .exponents = HD_EXPONENTS_ALL_INDEPENDENT);
}

/** Row-major vectors of point `from`, carried to point `to` by the logged events, in place. */
static void carry(const passage *x, double *v, int n, int from, int to)
{
    MADE(hd_frame, frame, PARTICLES(x->rows / 4), n, 1, 1);
    const size_t stride = (size_t)hd_frame_stride(frame), width = (size_t)n * sizeof *v;
    for (int row = 0; row < x->rows; row++)
        memcpy(hd_frame_data(frame) + (size_t)row * stride, v + row * n, width);
    for (int k = from; k < to; k++)
        CHECK_OK(hd_frame_replay(frame, &x->log[k], 0.0, x->log[k].duration));
    for (int row = 0; row < x->rows; row++)
        memcpy(v + row * n, hd_frame_read(frame) + (size_t)row * stride, width);
}

/** Frobenius norm of the tangent map between two points. */
static double map_size(const passage *x, int from, int to)
{
    const int n = x->rows;
    double size = 0.0, *v = calloc((size_t)(n * n), sizeof *v);
    for (int k = 0; k < n; k++) v[k * n + k] = 1.0;
    carry(x, v, n, from, to);
    for (int k = 0; k < n * n; k++) size = hypot(size, v[k]);
    free(v);
    return size;
}

/** Vectors of one passage carried from point `from` to point `to` are those that another one finds
 * there. What lies between both at first, by their transients and by rounding, can grow as much as
 * anything can while the vector grows as it does. Returns how many of them say something. */
static int check_covariance(const passage *one, const passage *other, int from, int to)
{
    const int n = one->vectors, rows = one->rows;
    const double size = map_size(one, from, to),
                 rounding = 16.0 * DBL_EPSILON * (one->condition + other->condition);
    hd_backward *c[3] = {passage_back(one, one->count, from, 1),
                         passage_back(other, other->count - 37, from, 2),
                         passage_back(other, other->count - 37, to, 2)};
    HEAP double *v = passage_vectors(one, c[0], from), *same = passage_vectors(other, c[1], from);
    double *later = passage_vectors(other, c[2], to), apart[64];
    int good = 0;
    for (int col = 0; col < n; col++) apart[col] = column_sine(v, same, rows, n, col);
    carry(one, v, n, from, to);
    for (int col = 0; col < n; col++) {
        const double tolerance = size * (apart[col] + rounding) / column_length(v, rows, n, col);
        assert_true(column_sine(v, later, rows, n, col) <= tolerance);
        good += tolerance < 1e-6;
    }
    free(later);
    for (int k = 0; k < 3; k++) hd_backward_free(c[k]);
    return good;
}

TEST(vectors_are_carried_into_vectors)
{
    const hd_boundary boundary[][2] = {{P, P}, {P, R}, {R, R}};
    for (int k = 0; k < 3; k++) {
        const hd_scene_def scene = few(4, boundary[k][0], boundary[k][1]);
        HELD(passage) one = passage_of(scene, 1, 600, 640, 0.25);
        HELD(passage) other = passage_of(scene, 2, 600, 640, 0.25);
        const int good = check_covariance(&one, &other, 12, 16);
        assert_true(good >= one.vectors - hd_scene_zero_exponents(&scene) - 2);
    }
}

/** The first l vectors span what those of Q do, and det C is the product of its diagonal: over any
 * time their growth sums to that of their volume, sum ln R_kk, but for what their own volume in
 * that span changes. */
TEST(growth_sums_to_that_of_the_volume)
{
    HELD(passage) x = passage_of(few(6, P, P), 1, 100, 300, 0.3);
    OWNED(hd_backward) *c = passage_back(&x, 300, 200, 1);
    const int n = x.vectors;
    double grown[64] = {0}, stretched[64] = {0}, volume[64], growth[64], sum = 0.0;
    for (int col = 0; col < n; col++) volume[col] = log(fabs(hd_backward_read(c)[col * (n + 1)]));
    for (int k = 199; k >= 0; k--) {
        CHECK_OK(hd_backward_step(c, growth, x.factor[k]));
        for (int col = 0; col < n; col++) {
            grown[col] += growth[col];
            stretched[col] += x.stretch[k][col];
        }
    }
    for (int col = 0; col < n; col++) {
        const double changed = log(fabs(hd_backward_read(c)[col * (n + 1)])) - volume[col];
        sum += grown[col] - stretched[col] - changed;
        /* each step rounds a column, and the logarithms of a length and of a diagonal, by some eps
         */
        CHECK_CLOSE(sum, 0.0, 200.0 * (col + 1) * 16.0 * DBL_EPSILON * sqrt(n));
    }
}

/** What two starts differ by in the second vector shrinks, on the way back, just as its growth
 * stays behind the first one's: by exp -sum (ln R_11 - ln R_22). */
TEST(starts_meet_as_their_exponents_say)
{
    HELD(passage) x = passage_of(few(4, P, P), 1, 100, 400, 0.25);
    const int transient[] = {4, 20, 40, 80, 120};
    const int n = x.vectors;
    double before = INFINITY;
    for (size_t k = 0; k < sizeof transient / sizeof *transient; k++) {
        const int end = transient[k];
        double ratio[2][2], gap = 0.0;
        for (int stream = 0; stream < 2; stream++) {
            OWNED(hd_backward) *c = passage_back(&x, end, end, (uint64_t)stream);
            OWNED(hd_backward) *met = passage_back(&x, end, 0, (uint64_t)stream);
            ratio[0][stream] = hd_backward_read(c)[n] / hd_backward_read(c)[n + 1];
            ratio[1][stream] = hd_backward_read(met)[n] / hd_backward_read(met)[n + 1];
        }
        for (int i = 0; i < end; i++) gap += x.stretch[i][0] - x.stretch[i][1];
        const double apart = ratio[1][0] - ratio[1][1], first = ratio[0][0] - ratio[0][1];
        CHECK_CLOSE(apart, first * exp(-gap), 64.0 * DBL_EPSILON * end * (1.0 + fabs(ratio[1][0])));
        assert_true(gap > 0 || end < 40);
        if (end >= 20) assert_true(fabs(apart) < before);
        before = fabs(apart);
    }
}

/** The log backwards in time: all momenta reversed, those of a contact as they were after it. */
static void reverse(hd_record *into, const hd_record *log)
{
    *into = *log;
    into->entry = malloc((log->count + 1) * sizeof(hd_event));
    for (size_t k = 0; k < log->count; k++) {
        hd_event event = events_in(log)[log->count - 1 - k];
        const double normal = event.p[0] * event.n[0] + event.p[1] * event.n[1];
        event.t = log->duration - event.t;
        for (int d = 0; d < 2; d++) event.p[d] = 2.0 * normal * event.n[d] - event.p[d];
        events_in(into)[k] = event;
    }
}

/** Vectors that random ones become, in extended precision: from point 0 on forwards to `at`, or
 * from the last point backwards in time. */
static exact_frame *converged(const passage *x, int at, bool backwards)
{
    MADE(hd_frame, frame, PARTICLES(x->rows / 4), x->rows, backwards ? 11 : 12, 1);
    exact_frame *v = exact_create(frame);
    if (!backwards)
        for (int k = 0; k < at; k++) exact_replay(v, &x->log[k]);
    for (int k = x->count - 1; backwards && k >= at; k--) {
        hd_record log;
        reverse(&log, &x->log[k]);
        exact_replay(v, &log);
        free(log.entry);
    }
    return v;
}

static void swap_columns(hd_exact *a, int *order, int rows, int ld, int one, int other)
{
    const int kept = order[one];
    order[one] = order[other];
    order[other] = kept;
    for (int row = 0; row < rows; row++) {
        const hd_exact entry = a[row * ld + one];
        a[row * ld + one] = a[row * ld + other];
        a[row * ld + other] = entry;
    }
}

/** x[n] != 0 with a x = 0, a of n - 1 rows (used up): elimination, the largest entry of each row
 * first. */
static void null_vector(hd_exact *a, hd_exact *x, int n)
{
    int order[64];
    for (int col = 0; col < n; col++) order[col] = col;
    for (int k = 0; k < n - 1; k++) {
        int best = k;
        for (int col = k; col < n; col++)
            if (fabsl(a[k * n + col]) > fabsl(a[k * n + best])) best = col;
        swap_columns(a, order, n - 1, n, k, best);
        for (int row = 0; row < n - 1; row++) {
            const hd_exact factor = row == k ? 0.0L : a[row * n + k] / a[k * n + k];
            for (int col = k; col < n; col++) a[row * n + col] -= factor * a[k * n + col];
        }
    }
    x[order[n - 1]] = 1.0L;
    for (int k = 0; k < n - 1; k++) x[order[k]] = -a[k * n + n - 1] / a[k * n + k];
}

/** Column `col` of v <- what lies in the span of the first col + 1 vectors forwards and of the
 * first n - col backwards, that is at right angles to the last col of those (whose momenta are
 * reversed). */
static void intersect(double *v, const hd_exact *forwards, const hd_exact *backwards, int n,
                      int col)
{
    hd_exact a[64 * 64] = {0}, x[64];
    for (int k = 0; k < col; k++)
        for (int m = 0; m <= col; m++)
            for (int row = 0; row < n; row++) {
                const hd_exact sign = row & 2 ? -1.0L : 1.0L;
                a[k * (col + 1) + m] += sign * backwards[row * n + n - 1 - k] *
                                        forwards[row * n + m];
            }
    null_vector(a, x, col + 1);
    for (int row = 0; row < n; row++) {
        hd_exact sum = 0.0L;
        for (int m = 0; m <= col; m++) sum += forwards[row * n + m] * x[m];
        v[row * n + col] = (double)sum;
    }
}

/** The Oseledec splitting by its definition: what the past has made grow, cut with what the future
 * lets grow no more. Q is known to eps condition; a vector that hardly leans out of those before it
 * is known less. */
TEST(intersections_of_past_and_future_are_the_same)
{
    enum { AT = 500, N = 16, POSITIVE = 5 };
    HELD(passage) x = passage_of(scene_from(few(4, P, P), .aspect = 1.0), 1, 0, 2 * AT, 0.25);
    exact_frame *forwards = converged(&x, AT, false), *backwards = converged(&x, AT, true);
    OWNED(hd_backward) *c = passage_back(&x, 2 * AT, AT, 1);
    HEAP double *v = passage_vectors(&x, c, AT), *twin = calloc(N * N, sizeof *twin);
    for (int col = 0; col < N; col++) {
        if (col >= POSITIVE && col < N - POSITIVE)
            continue; /* equal exponents have no directions of their own */
        const double leaning = fabs(hd_backward_read(c)[col * (N + 1)]);
        intersect(twin, exact_read(forwards), exact_read(backwards), N, col);
        CHECK_CLOSE(column_sine(v, twin, N, N, col), 0.0,
                    16.0 * DBL_EPSILON * x.condition / leaning);
    }
    exact_free(forwards);
    exact_free(backwards);
}
