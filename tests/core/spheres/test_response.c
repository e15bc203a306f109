/** Response and structure factors of spheres against their definitions: differences of sums, and
 * sums of exponentials over spheres and their mirror images [T22]. */
#include <complex.h>
#include <string.h>
#include "draw.h"
#include "hdlyap/hdlyap.h"
#include "observe/functionals.h"
#include "testing.h"

enum { SPHERES = 40, VECTORS = 6 };
static const double STEP = 1e-5;

typedef struct state {
    hd_scene_def scene;
    double q[3 * SPHERES], p[3 * SPHERES];
} state;

static state drawn(int walls)
{
    state s = {.scene = box_of(SPHERES, 0.3, 0.8, 1.3, walls, 1)};
    hd_random random = hd_random_seeded(7, (uint64_t)walls);
    double box[3];
    s.scene.max_mode_number = 2;
    hd_scene_box(&s.scene, box);
    for (int k = 0; k < 3 * SPHERES; k++) {
        s.q[k] = 0.5 + uniform(&random) * (box[k % 3] - 1.0);
        s.p[k] = hd_random_symmetric(&random);
    }
    return s;
}

/* ---- response ------------------------------------------------------------------------------ */

/** A at q, and with derived = d its derivative along d. */
static double modulation(const state *s, const hd_wave *wave, unsigned bits, const double *q,
                         int derived)
{
    double product = 1.0;
    for (int d = 0; d < 3; d++) {
        const double k = wave->k[d], u = q[d] - (s->scene.boundary[d] == HD_REFLECTING ? 0.5 : 0.0);
        const bool sine = bits >> d & 1;
        if (derived == d)
            product *= k * (sine ? cos(k * u) : -sin(k * u));
        else
            product *= sine ? sin(k * u) : cos(k * u);
    }
    return product;
}

/** What one sphere adds to the sums, in their order. */
static void sums(double *out, const state *s, const hd_wave *wave, unsigned bits, const double x[6])
{
    const double *q = x, *p = x + 3, a = modulation(s, wave, bits, q, -1);
    for (int f = 0; f < HD_FUNCTIONALS_IN(3); f++) out[f] = 0.0;
    out[0] = a / wave->number;
    for (int d = 0; d < 3; d++) {
        const double slope = modulation(s, wave, bits, q, d);
        const double of = wave->n[d] > 0 ? slope / wave->k[d] : a;
        out[1] += p[d] * slope / wave->number;
        out[2] += p[d] * wave->across[0][d] * of;
        out[3] += p[d] * wave->across[1][d] * of;
        out[4] += p[d] * p[d] * a;
    }
}

static void check_functionals(const state *s, const hd_wave *wave, unsigned bits, int sphere)
{
    hd_functionals got;
    double x[6], up[HD_FUNCTIONALS_MAX], down[HD_FUNCTIONALS_MAX];
    memcpy(x, s->q + 3 * sphere, 3 * sizeof *x);
    memcpy(x + 3, s->p + 3 * sphere, 3 * sizeof *x);
    hd_functionals_at(got, 3, wave, bits, s->scene.boundary, x, x + 3);
    for (int row = 0; row < ROWS_OF_ONE; row++) {
        const double at = x[row];
        x[row] = at + STEP, sums(up, s, wave, bits, x);
        x[row] = at - STEP, sums(down, s, wave, bits, x);
        x[row] = at;
        for (int f = 0; f < HD_FUNCTIONALS_IN(3);
             f++) /* third derivatives are below k^3, k < 2.2 */
            CHECK_CLOSE(got[f][row], (up[f] - down[f]) / (2.0 * STEP), 100.0 * STEP * STEP);
    }
}

TEST(functionals_are_derivatives)
{
    for (int walls = 0; walls < 8; walls++) {
        const state s = drawn(walls);
        hd_wave wave[64];
        const int waves = hd_waves(&s.scene, wave, 64);
        assert_in_range(waves, 5, 64);
        for (int w = 0; w < waves; w++)
            for (int c = 0; c < wave[w].pairs.count; c++)
                check_functionals(&s, &wave[w], wave[w].pairs.bits[c], (w + c) % SPHERES);
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Across k, each other and the walls that they would go through; as many as T fields of each A. */
TEST(directions_across)
{
    for (int walls = 0; walls < 8; walls++) {
        const state s = drawn(walls);
        hd_wave wave[64];
        const int waves = hd_waves(&s.scene, wave, 64);
        for (int w = 0; w < waves; w++) {
            double(*e)[3] = wave[w].across;
            int count = 0;
            for (int f = 0; f < 2; f++) {
                const double length = dot(e[f], e[f]);
                CHECK_CLOSE(length * (1.0 - length), 0.0, 8 * DBL_EPSILON);
                CHECK_CLOSE(dot(e[f], wave[w].k), 0.0, 8 * DBL_EPSILON * wave[w].number);
                for (int d = 0; d < 3; d++)
                    if (wave[w].n[d] == 0 && walls >> d & 1) CHECK_CLOSE(e[f][d], 0.0, 0.0);
                count += length > 0.5;
            }
            CHECK_CLOSE(dot(e[0], e[1]), 0.0, 8 * DBL_EPSILON);
            assert_int_equal(count * wave[w].pairs.count, wave[w].transverse.count);
        }
    }
}

/* ---- structure ----------------------------------------------------------------------------- */

/** Over spheres and images, |sum dq exp(-i k.q)|^2 along k and in all, for one choice of signs of
 * k. */
static void with_images(double out[2], const state *s, const hd_wave *wave, int signs,
                        const double *dq)
{
    double k[3];
    double complex sum[3] = {0.0};
    int images = 1;
    for (int d = 0; d < 3; d++) {
        k[d] = signs >> d & 1 ? -wave->k[d] : wave->k[d];
        if (s->scene.boundary[d] == HD_REFLECTING && wave->n[d] > 0) images <<= 1;
    }
    for (int j = 0; j < SPHERES; j++)
        for (int mirrored = 0; mirrored < 8; mirrored++) {
            double phase = 0.0;
            bool is_image = true;
            for (int d = 0; d < 3; d++) {
                const bool walls = s->scene.boundary[d] == HD_REFLECTING,
                           turned = mirrored >> d & 1;
                const double u = s->q[3 * j + d] - (walls ? 0.5 : 0.0);
                is_image &= !turned || (walls && wave->n[d] > 0);
                phase += k[d] * (turned ? -u : u);
            }
            for (int d = 0; d < 3 && is_image; d++)
                sum[d] += (mirrored >> d & 1 ? -1.0 : 1.0) * dq[3 * j + d] * cexp(-I * phase);
        }
    const double complex along = (k[0] * sum[0] + k[1] * sum[1] + k[2] * sum[2]) / wave->number;
    out[0] = creal(along * conj(along)) / images;
    out[1] = 0.0;
    for (int d = 0; d < 3; d++) /* what a wall forbids is none */
        if (wave->n[d] > 0 || s->scene.boundary[d] != HD_REFLECTING)
            out[1] += creal(sum[d] * conj(sum[d])) / images;
}

static void check_wave(const state *s, const hd_structure *structure, int w, const double *dq,
                       int col)
{
    const hd_wave *wave = hd_structure_wave(structure, w);
    double along = 0.0, all = 0.0;
    int choices = 0;
    for (int signs = 0; signs < 8; signs++) {
        double one[2];
        bool is_other = true;
        for (int d = 0; d < 3; d++) is_other &= !(signs >> d & 1) || wave->n[d] > 0;
        if (!is_other) continue;
        with_images(one, s, wave, signs, dq);
        along += one[0], all += one[1];
        choices++;
    }
    const double size = DBL_EPSILON * 64 * SPHERES;
    CHECK_CLOSE(hd_structure_snapshot(structure, w, HD_ALONG)[col], along / choices, size);
    CHECK_CLOSE(hd_structure_snapshot(structure, w, HD_ACROSS)[col], (all - along) / choices, size);
}

/** dq of a column, with norm 1; *norm: as it was. */
static void unit_dq(double *dq, const hd_frame *frame, int col, double *norm)
{
    const double *data = hd_frame_read(frame);
    double square = 0.0;
    for (int j = 0; j < SPHERES; j++)
        for (int d = 0; d < 3; d++) {
            const size_t row = (size_t)(ROWS_OF_ONE * j + d);
            dq[3 * j + d] = data[row * (size_t)hd_frame_stride(frame) + (size_t)col];
            square += dq[3 * j + d] * dq[3 * j + d];
        }
    *norm = sqrt(square);
    for (int k = 0; k < 3 * SPHERES; k++) dq[k] /= *norm;
}

/** Amplitudes at the strongest wave, along k and in both directions across it: sums of what is
 * above, of dq in place of p. */
static void check_peak(const state *s, const hd_structure *structure, const double *dq, int col)
{
    const hd_wave *wave = hd_structure_wave(structure, hd_structure_peak(structure, col));
    const double size = DBL_EPSILON * 64 * SPHERES;
    double scale = 1.0;
    for (int d = 0; d < 3; d++)
        if (s->scene.boundary[d] == HD_REFLECTING && wave->n[d] > 0) scale *= sqrt(2.0);
    for (int c = 0; c < wave->pairs.count; c++) {
        const unsigned bits = wave->pairs.bits[c];
        double sum[3] = {0.0};
        for (int j = 0; j < SPHERES; j++) {
            double one[HD_FUNCTIONALS_MAX], x[6];
            memcpy(x, s->q + 3 * j, 3 * sizeof *x);
            memcpy(x + 3, dq + 3 * j, 3 * sizeof *x);
            sums(one, s, wave, bits, x);
            for (int f = 0; f < 3; f++) sum[f] += scale * one[1 + f];
        }
        CHECK_CLOSE(hd_structure_amplitude(structure, HD_ALONG, bits)[col], sum[0], size);
        CHECK_CLOSE(hd_structure_amplitude(structure, HD_ACROSS, bits)[col], sum[1], size);
        CHECK_CLOSE(hd_structure_amplitude(structure, HD_ACROSS, bits | HD_SECOND)[col], sum[2],
                    size);
    }
}

TEST(structure_factors_are_sums_of_exponentials)
{
    for (int walls = 0; walls < 8; walls++) {
        const state s = drawn(walls);
        double dq[VECTORS][3 * SPHERES], norm[VECTORS];
        hd_frame *frame;
        hd_structure *structure;
        CHECK_OK(hd_frame_create(&frame, PARTICLES(SPHERES), VECTORS, 3, 1));
        CHECK_OK(hd_structure_create(&structure, &s.scene, VECTORS, 1));
        for (int col = 0; col < VECTORS; col++) unit_dq(dq[col], frame, col, &norm[col]);
        CHECK_OK(hd_structure_measure(structure, hd_frame_columns(frame), s.q, norm));
        assert_true(hd_structure_waves(structure) > 4);
        for (int w = 0; w < hd_structure_waves(structure); w++)
            for (int col = 0; col < VECTORS; col++) check_wave(&s, structure, w, dq[col], col);
        hd_structure_add(structure);
        CHECK_OK(hd_structure_measure(structure, hd_frame_columns(frame), s.q, norm));
        for (int col = 0; col < VECTORS; col++) check_peak(&s, structure, dq[col], col);
        hd_structure_free(structure);
        hd_frame_free(frame);
    }
}
