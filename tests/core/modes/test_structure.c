/** Structure factors against sums over disks and their images, and against vectors that are known.
 */
#include <complex.h>
#include "rotating.h"

enum { VECTORS = 5 };
/** Sums of 2N products, squared: S up to N / 2. */
static const double ROUNDED = 1e-12;

typedef struct looked {
    world w;
    hd_structure *s;
} looked;

static looked looked_of(hd_scene_def def, int threads)
{
    looked x = {.w = world_create(def, VECTORS, threads)};
    CHECK_OK(hd_structure_create(&x.s, &def, VECTORS, threads));
    return x;
}

static void looked_free(looked *x)
{
    hd_structure_free(x->s);
    world_free(&x->w);
}

static void measure_columns(looked *x, int first, int count)
{
    hd_columns all = hd_frame_columns(x->w.frame);
    all.data += first - all.first;
    all.first = first;
    all.count = count;
    CHECK_OK(hd_modes_measure(x->w.modes, all, x->w.q, x->w.p));
    CHECK_OK(hd_structure_measure(x->s, all, x->w.q, hd_modes_dq_norms(x->w.modes)));
}

static void measure(looked *x) { measure_columns(x, 0, VECTORS); }

/** |sum e.dq exp(-i k.q)|^2 for one sign of k_y over disks and, where walls see nodes, their
 * images; per norm of dq and number of images. */
static double with_images(const world *w, const double *dq, const hd_wave *wave, double sign,
                          hd_direction e)
{
    const double k[2] = {wave->k[0], sign * wave->k[1]}, number = wave->number;
    const double unit[2][2] = {{k[0] / number, k[1] / number}, {-k[1] / number, k[0] / number}};
    int images[2], disks = w->scene.number;
    double norm = 0.0;
    double complex sum = 0.0;
    for (int d = 0; d < 2; d++) images[d] = w->scene.boundary[d] == R && wave->n[d] > 0 ? 2 : 1;
    for (int j = 0; j < 2 * disks; j++) norm += dq[j] * dq[j];
    for (int j = 0; j < disks; j++)
        for (int a = 0; a < images[0]; a++)
            for (int b = 0; b < images[1]; b++) {
                const double x = (a ? -1.0 : 1.0) * (w->q[2 * j] - 0.5) + 0.5;
                const double y = (b ? -1.0 : 1.0) * (w->q[2 * j + 1] - 0.5) + 0.5;
                const double part = unit[e][0] * (a ? -1.0 : 1.0) * dq[2 * j] +
                                    unit[e][1] * (b ? -1.0 : 1.0) * dq[2 * j + 1];
                sum += part * cexp(-I * (k[0] * x + k[1] * y));
            }
    return creal(sum * conj(sum)) / (norm * images[0] * images[1]);
}

/** Where a direction without nodes has walls, across it has no wave: its displacements would be
 * normal to them. */
static bool has_none(const hd_wave *wave, hd_direction e)
{
    return e == HD_ACROSS && wave->transverse.count == 0;
}

static void check_twin(hd_boundary bx, hd_boundary by)
{
    HELD(looked) x = looked_of(scene_of(70, 0.6, 0.8, bx, by, 11), 1);
    double dq[ROWS_MAX], dp[ROWS_MAX];
    int checked = 0;
    measure(&x);
    for (int w = 0; w < hd_structure_waves(x.s); w++)
        for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++)
            for (int col = 0; col < VECTORS; col++) {
                const hd_wave *wave = hd_structure_wave(x.s, w);
                world_read(&x.w, col, dq, dp);
                double want = 0.5 * (with_images(&x.w, dq, wave, 1.0, e) +
                                     with_images(&x.w, dq, wave, -1.0, e));
                if (has_none(wave, e)) want = 0.0;
                CHECK_CLOSE(hd_structure_snapshot(x.s, w, e)[col], want, 70 * ROUNDED);
                checked += want > 0.1;
            }
    assert_true(checked > 100);
}

TEST(they_are_the_sums_over_disks_and_images)
{
    check_twin(P, P);
    check_twin(P, R);
    check_twin(R, P);
    check_twin(R, R);
}

/** All that are sampled, in ascending k: more than those that are classified. */
TEST(waves_are_all_that_disks_sample)
{
    hd_scene_def def = scene(.number = 70, .density = 0.6, .aspect = 0.8, .boundary[1] = R,
                             .seed = 11, .max_mode_number = 1);
    HELD(looked) x = looked_of(def, 1);
    double box[2];
    hd_scene_box(&def, box);
    const double largest = 3.14159265358979323846 * sqrt(0.6);
    int count = 0;
    for (int nx = 0; nx < 100; nx++)
        for (int ny = nx == 0; ny < 100; ny++)
            count += hypot(nx * 2.0 / box[0], ny / (box[1] - 1.0)) * 3.14159265358979323846 <=
                     largest;
    assert_int_equal(hd_structure_waves(x.s), count);
    assert_int_equal(hd_structure_waves_of(&def), count);
    assert_int_equal(hd_structure_vectors(x.s), VECTORS);
    for (int w = 1; w < count; w++)
        assert_true(hd_structure_wave(x.s, w)->number >= hd_structure_wave(x.s, w - 1)->number);
}

/** A vector in a T or an L field: its wave is the peak, along or across; N over the number of
 * modulations but for how evenly disks sample it. */
static void check_peak(hd_boundary bx, hd_boundary by, hd_mode_kind kind, int nx, int ny)
{
    const double EVEN = 0.35;
    HELD(looked) x = looked_of(scene_of(70, 0.6, 0.8, bx, by, 11), 1);
    const int s = world_subspace(&x.w, kind, nx, ny);
    const hd_subspace *subspace = hd_fields_subspace(x.w.fields, s);
    const hd_direction e = kind == HD_MODE_T ? HD_ACROSS : HD_ALONG;
    const int m = subspace->modulations.count;
    double dq[ROWS_MAX] = {0.0}, sum = 0.0;
    for (int c = 0; c < m; c++) world_add_field(&x.w, dq, subspace->column + c, 1.0 + 0.3 * c);
    world_write_mode(&x.w, 2, dq, 1.5);
    measure(&x);
    assert_int_equal(hd_structure_peak(x.s, 2), -1);
    hd_structure_add(x.s);
    assert_int_equal(hd_structure_peak(x.s, 2), -1); /* that of the amplitudes that are there */
    measure(&x);
    const int peak = hd_structure_peak(x.s, 2);
    assert_int_equal(hd_structure_wave(x.s, peak)->n[0], nx);
    assert_int_equal(hd_structure_wave(x.s, peak)->n[1], ny);
    const double value = hd_structure_snapshot(x.s, peak, e)[2];
    CHECK_CLOSE(value, 70.0 / m, EVEN * 70.0 / m);
    assert_true(hd_structure_snapshot(x.s, peak, (hd_direction)(1 - e))[2] < 0.1 * value);
    for (unsigned bits = 0; bits < 4; bits++)
        sum += pow(hd_structure_amplitude(x.s, e, bits)[2], 2.0);
    CHECK_CLOSE(sum, value, 70 * ROUNDED);
    const double first = hd_structure_amplitude(x.s, e, subspace->modulations.bits[0])[2];
    assert_true(first > 0.0); /* the sign is that of the field */
}

TEST(the_peak_is_the_wave_of_the_vector)
{
    static const int nodes[][2] = {{1, 0}, {0, 1}, {1, 1}, {2, 1}};
    for (int k = 0; k < 4; k++) {
        check_peak(P, P, HD_MODE_T, nodes[k][0], nodes[k][1]);
        check_peak(P, P, HD_MODE_LP, nodes[k][0], nodes[k][1]);
        check_peak(R, P, HD_MODE_LP, nodes[k][0], nodes[k][1]);
        check_peak(R, R, HD_MODE_LP, nodes[k][0], nodes[k][1]);
    }
    check_peak(R, R, HD_MODE_T, 1, 1);
    check_peak(R, P, HD_MODE_T, 1, 1);
    check_peak(R, P, HD_MODE_T, 1, 0);
}

TEST(means_are_means)
{
    HELD(looked) x = looked_of(scene_of(70, 0.6, 0.8, P, P, 11), 1);
    double want[VECTORS] = {0.0};
    for (int k = 0; k < 3; k++) {
        world_move(&x.w, 1.0);
        world_noise(&x.w);
        measure(&x);
        for (int col = 0; col < VECTORS; col++)
            want[col] += hd_structure_snapshot(x.s, 7, HD_ACROSS)[col] / 3.0;
        assert_int_equal(hd_structure_samples(x.s), k);
        hd_structure_add(x.s);
    }
    for (int col = 0; col < VECTORS; col++)
        CHECK_CLOSE(hd_structure_mean(x.s, 7, HD_ACROSS)[col], want[col], ROUNDED);
    hd_structure_clear(x.s);
    assert_int_equal(hd_structure_samples(x.s), 0);
    CHECK_CLOSE(hd_structure_mean(x.s, 7, HD_ACROSS)[0], 0.0, 0.0);
    measure(&x);
    assert_int_equal(hd_structure_peak(x.s, 0), -1);
    CHECK_CLOSE(hd_structure_amplitude(x.s, HD_ALONG, 0)[0], 0.0, 0.0);
}

/** As ranks and threads have them. */
TEST(columns_and_threads_change_nothing)
{
    const hd_scene_def def = scene_of(70, 0.6, 0.8, P, R, 11);
    HELD(looked) a = looked_of(def, 1), b = looked_of(def, 2);
    for (int k = 0; k < 2; k++) {
        measure(&a);
        measure_columns(&b, 0, 2);
        measure_columns(&b, 2, 3);
        hd_structure_add(a.s);
        hd_structure_add(b.s);
    }
    for (int w = 0; w < hd_structure_waves(a.s); w++)
        for (int col = 0; col < VECTORS; col++)
            CHECK_CLOSE(hd_structure_mean(a.s, w, HD_ALONG)[col],
                        hd_structure_mean(b.s, w, HD_ALONG)[col], 70 * ROUNDED);
    for (int col = 0; col < VECTORS; col++) {
        assert_int_equal(hd_structure_peak(a.s, col), hd_structure_peak(b.s, col));
        for (unsigned bits = 0; bits < 4; bits++)
            CHECK_CLOSE(hd_structure_amplitude(a.s, HD_ACROSS, bits)[col],
                        hd_structure_amplitude(b.s, HD_ACROSS, bits)[col], 70 * ROUNDED);
    }
}

/** Without a dq half there is none; what is no number is refused. */
TEST(degenerate_vectors)
{
    HELD(looked) x = looked_of(scene_of(70, 0.6, 0.8, P, P, 11), 1);
    double dq[ROWS_MAX] = {0.0}, dp[ROWS_MAX];
    for (int row = 0; row < world_rows(&x.w); row++) dp[row] = 1.0;
    world_write(&x.w, 1, dq, dp);
    measure(&x);
    for (int w = 0; w < hd_structure_waves(x.s); w++)
        CHECK_CLOSE(hd_structure_snapshot(x.s, w, HD_ALONG)[1], 0.0, 0.0);
    x.w.q[3] = NAN;
    assert_int_equal(
        hd_structure_measure(x.s, hd_frame_columns(x.w.frame), x.w.q, hd_modes_dq_norms(x.w.modes)),
        HD_NOT_FINITE);
}
