/** Sampled fields of spheres against what a T, L or P field must be, by differences of the samples
 * alone; their numbers; and weights of vectors that are known. */
#include "draw.h"
#include "testing.h"

/** A sphere at each place, and at both sides of it along each direction. */
enum { PLACES = 8, AROUND = 7, DISKS = PLACES * AROUND, Q = 3 * DISKS };
/** Step of differences; |k| < 3.2 below. */
static const double STEP = 1e-3;

typedef struct sample {
    hd_scene_def scene;
    double box[3], q[Q], p[Q];
    hd_fields *fields;
} sample;

static sample sampled(int walls)
{
    sample s = {.scene = box_of(DISKS, 0.3, 0.8, 1.3, walls, 1)};
    hd_random random = hd_random_seeded(5, 0);
    s.scene.max_mode_number = 2;
    hd_scene_box(&s.scene, s.box);
    for (int i = 0; i < DISKS; i++) {
        const int at = i % AROUND, d = (at - 1) / 2; /* 0: the middle; then -x, +x, -y .. */
        for (int e = 0; e < 3; e++) {
            s.q[3 * i + e] = at ? s.q[3 * (i - at) + e] : 1.0 + uniform(&random) * (s.box[e] - 2.0);
            s.p[3 * i + e] = 0.3 + uniform(&random);
        }
        if (at) s.q[3 * i + d] += at % 2 ? -STEP : STEP;
    }
    CHECK_OK(hd_fields_create(&s.fields, &s.scene));
    hd_fields_sample(s.fields, s.q, s.p);
    return s;
}

/** Before the column got norm 1. */
static double raw(const sample *s, int sphere, int d, int column)
{
    const size_t row = (size_t)(3 * sphere + d), stride = (size_t)hd_fields_stride(s->fields);
    return hd_fields_norm(s->fields, column) *
           hd_fields_data(s->fields)[row * stride + (size_t)column];
}

/** Component e derived along d, and the sum of all second derivatives. */
static double derived(const sample *s, int place, int e, int d, int column)
{
    const int i = AROUND * place + 2 * d + 1;
    return (raw(s, i + 1, e, column) - raw(s, i, e, column)) / (2.0 * STEP);
}

static double laplacian(const sample *s, int place, int e, int column)
{
    double sum = -6.0 * raw(s, AROUND * place, e, column);
    for (int at = 1; at < AROUND; at++) sum += raw(s, AROUND * place + at, e, column);
    return sum / (STEP * STEP);
}

/** For every field number c of every subspace, behind all walls. */
typedef void (*field_check)(const sample *s, const hd_subspace *m, int c);

static void for_all(hd_mode_kind kind, field_check check)
{
    int checked = 0;
    for (int walls = 0; walls < 8; walls++) {
        const sample s = sampled(walls);
        for (int i = 0; i < hd_fields_subspaces(s.fields); i++) {
            const hd_subspace *m = hd_fields_subspace(s.fields, i);
            for (int c = 0; m->kind == kind && c < m->modulations.count; c++) {
                check(&s, m, c);
                checked++;
            }
        }
        hd_fields_free(s.fields);
    }
    assert_true(checked > 100);
}

/** Truncation of a first difference of a field of size k^j, k^3 STEP^2 / 6, and of a second one,
 * k^4 STEP^2 / 12 each; rounding is below. */
static double truncated(double k, double size) { return size * 0.5 * pow(k, 3.0) * STEP * STEP; }
static double truncated_twice(double k, double size)
{
    return size * (0.25 * pow(k, 4.0) * STEP * STEP + 100.0 * DBL_EPSILON / (STEP * STEP));
}

/** Divergence-free, of its wave number, and not smaller than it should be. */
static void check_transverse(const sample *s, const hd_subspace *m, int c)
{
    const double k = m->wave.number;
    const int column = m->column + c;
    assert_true(hd_fields_norm(s->fields, column) > 0.1);
    for (int at = 0; at < PLACES; at++) {
        double divergence = 0.0;
        for (int d = 0; d < 3; d++) {
            divergence += derived(s, at, d, d, column);
            CHECK_CLOSE(laplacian(s, at, d, column), -k * k * raw(s, AROUND * at, d, column),
                        truncated_twice(k, 1.0));
        }
        CHECK_CLOSE(divergence, 0.0, 3 * truncated(k, 1.0));
    }
}

TEST(transverse_fields_are_free_of_divergence) { for_all(HD_MODE_T, check_transverse); }

/** Curl-free, with the divergence -k^2 A; P = p A with the same A at each sphere; L = grad A. */
static void check_pair(const sample *s, const hd_subspace *m, int c)
{
    const double k = m->wave.number;
    const int column = m->column + c, of_p = column + m->modulations.count;
    for (int at = 0; at < PLACES; at++) {
        const int i = AROUND * at;
        const double a = raw(s, i, 0, of_p) / s->p[3 * i];
        double divergence = 0.0;
        for (int d = 0; d < 3; d++) {
            const int e = (d + 1) % 3, low = i + 2 * d + 1;
            const double slope = (raw(s, low + 1, 1, of_p) / s->p[3 * low + 4] -
                                  raw(s, low, 1, of_p) / s->p[3 * low + 1]) /
                                 (2.0 * STEP);
            divergence += derived(s, at, d, d, column);
            CHECK_CLOSE(derived(s, at, e, d, column), derived(s, at, d, e, column),
                        2 * truncated(k, k));
            CHECK_CLOSE(raw(s, i, d, of_p), s->p[3 * i + d] * a, 100 * DBL_EPSILON);
            CHECK_CLOSE(raw(s, i, d, column), slope, truncated(k, 1.0) + 1e-12);
        }
        CHECK_CLOSE(divergence, -k * k * a, 3 * truncated(k, k));
    }
}

TEST(pairs_are_a_gradient_and_its_modulation) { for_all(HD_MODE_LP, check_pair); }

/** Neither T nor L goes through a wall; across a period both are the same. */
TEST(fields_fit_their_ends)
{
    for (int walls = 0; walls < 8; walls++) {
        sample s = sampled(walls);
        for (int i = 0; i < DISKS; i++) { /* pairs at both ends along one direction */
            const int d = i / 2 % 3;
            const double margin = s.scene.boundary[d] == R ? 0.5 : 0.0;
            if (i % 2) memcpy(s.q + 3 * i, s.q + 3 * (i - 1), 3 * sizeof(double));
            s.q[3 * i + d] = i % 2 ? s.box[d] - margin : margin;
        }
        hd_fields_sample(s.fields, s.q, s.p);
        for (int n = 0; n < hd_fields_subspaces(s.fields); n++) {
            const hd_subspace *m = hd_fields_subspace(s.fields, n);
            for (int c = 0; c < m->modulations.count; c++)
                for (int i = 0; i < DISKS; i++) {
                    const int d = i / 2 % 3, column = m->column + c;
                    if (s.scene.boundary[d] == R)
                        CHECK_CLOSE(raw(&s, i, d, column), 0.0, 64 * DBL_EPSILON);
                    for (int e = 0; i % 2 && e < 3; e++)
                        if (s.scene.boundary[d] == P)
                            CHECK_CLOSE(raw(&s, i, e, column), raw(&s, i - 1, e, column),
                                        64 * DBL_EPSILON);
                }
        }
        hd_fields_free(s.fields);
    }
}

/* ---- numbers -------------------------------------------------------------------------------- */

/** Numbers of T and LP fields at these nodes, from the rules: m modulations, and of T for each as
 * many fields as components that are allowed, less one. */
static const struct {
    int walls, n[3], t, lp;
} NUMBERS[] = {{0, {1, 0, 0}, 4, 4}, {0, {0, 1, 1}, 8, 8}, {0, {1, 1, 1}, 16, 16},
               {1, {1, 0, 0}, 2, 2}, {1, {0, 1, 0}, 2, 4}, {1, {1, 1, 0}, 4, 4},
               {1, {0, 1, 1}, 4, 8}, {6, {1, 0, 0}, 0, 4}, {6, {0, 1, 0}, 1, 2},
               {6, {1, 0, 1}, 2, 4}, {6, {1, 1, 1}, 4, 4}, {7, {1, 0, 0}, 0, 2},
               {7, {0, 1, 1}, 1, 2}, {7, {1, 1, 1}, 2, 2}};

static int dimension_of(const hd_fields *fields, hd_mode_kind kind, const int n[3])
{
    for (int s = 0; s < hd_fields_subspaces(fields); s++) {
        const hd_subspace *m = hd_fields_subspace(fields, s);
        if (m->kind == kind && memcmp(m->wave.n, n, sizeof m->wave.n) == 0) return m->dimension;
    }
    return 0;
}

TEST(there_are_as_many_fields_as_boundaries_allow)
{
    for (size_t k = 0; k < sizeof NUMBERS / sizeof *NUMBERS; k++) {
        const sample s = sampled(NUMBERS[k].walls);
        assert_int_equal(dimension_of(s.fields, HD_MODE_T, NUMBERS[k].n), NUMBERS[k].t);
        assert_int_equal(dimension_of(s.fields, HD_MODE_LP, NUMBERS[k].n), NUMBERS[k].lp);
        hd_fields_free(s.fields);
    }
}

/* ---- weights -------------------------------------------------------------------------------- */

enum { MANY = 128, ROWS = 6 * MANY };

typedef struct world {
    hd_scene_def scene;
    double q[3 * MANY], p[3 * MANY];
    hd_modes *modes;
    hd_frame *frame;
} world;

/** Spheres in the fluid; the frame is random. */
static world world_of(int walls, int vectors)
{
    world w = {.scene = box_of(MANY, 0.4, 0.5, 0.5, walls, 3)};
    w.scene.max_mode_number = 1;
    MADE(hd_trajectory, tr, &w.scene);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 20.0));
    hd_trajectory_state(tr, w.q, w.p);
    CHECK_OK(hd_modes_create(&w.modes, &w.scene, vectors, 1));
    CHECK_OK(hd_frame_create(&w.frame, PARTICLES(MANY), vectors, 3, 1));
    return w;
}

static void measure(world *w)
{
    CHECK_OK(hd_modes_measure(w->modes, hd_frame_columns(w->frame), w->q, w->p));
}

static void forget(world *w)
{
    hd_modes_free(w->modes);
    hd_frame_free(w->frame);
}

static double *entry(world *w, int row, int col)
{
    return hd_frame_data(w->frame) + (size_t)row * (size_t)hd_frame_stride(w->frame) + col;
}

/** Each field by itself, as dq of a vector: all of its weight is where it belongs, and all of its L
 * or P weight; the norm is that of the samples. */
TEST(a_field_has_weight_one)
{
    for (int walls = 0; walls < 8; walls++) {
        hd_fields *fields = NULL;
        world w = world_of(walls, 1);
        CHECK_OK(hd_fields_create(&fields, &w.scene));
        hd_fields_sample(fields, w.q, w.p);
        for (int s = 0; s < hd_fields_subspaces(fields); s++) {
            const hd_subspace *m = hd_fields_subspace(fields, s);
            for (int c = 0; c < m->dimension; c++) {
                double square = 0.0;
                for (int k = 0; k < 3 * MANY; k++) {
                    const double value = hd_fields_data(
                        fields)[k * hd_fields_stride(fields) + m->column + c];
                    *entry(&w, 6 * (k / 3) + k % 3, 0) = 0.8 * value; /* of any length */
                    *entry(&w, 6 * (k / 3) + k % 3 + 3, 0) = 0.1;
                    square += value * value;
                }
                measure(&w);
                CHECK_CLOSE(square, 1.0, ROWS * DBL_EPSILON);
                CHECK_CLOSE(*hd_modes_snapshot(w.modes, s, HD_WEIGHT), 1.0, 1e-12);
                if (m->kind != HD_MODE_LP) continue;
                const hd_weight of = c < m->modulations.count ? HD_WEIGHT_L : HD_WEIGHT_P;
                CHECK_CLOSE(*hd_modes_snapshot(w.modes, s, of), 1.0, 1e-12);
            }
        }
        hd_fields_free(fields);
        forget(&w);
    }
}

/** Over a basis of all dq weights add up to the dimension: fields are independent of each other,
 * and no set of vectors can show more. */
TEST(weights_add_up_to_the_dimension)
{
    for (int walls = 0; walls < 8; walls++) {
        world w = world_of(walls, 3 * MANY);
        for (int row = 0; row < ROWS; row++)
            for (int col = 0; col < 3 * MANY; col++)
                *entry(&w, row, col) = row == 6 * (col / 3) + col % 3;
        measure(&w);
        const hd_fields *fields = hd_modes_fields(w.modes);
        for (int s = 0; s < hd_fields_subspaces(fields); s++) {
            double sum = 0.0;
            for (int col = 0; col < 3 * MANY; col++)
                sum += hd_modes_snapshot(w.modes, s, HD_WEIGHT)[col];
            CHECK_CLOSE(sum, hd_fields_subspace(fields, s)->dimension, 1e-11);
        }
        forget(&w);
    }
}

/** Random vectors have the weight of chance, dimension / 3N; of each it scatters by sqrt(2 d) / 3N.
 */
TEST(random_vectors_have_the_weight_of_chance)
{
    enum { VECTORS = 200 };
    const double z = 4.0; /* of some hundred means */
    for (int walls = 0; walls < 8; walls++) {
        world w = world_of(walls, VECTORS);
        hd_random random = hd_random_seeded(8, (uint64_t)walls);
        for (int row = 0; row < ROWS; row++)
            for (int col = 0; col < VECTORS; col++) {
                double sum = 0.0; /* all but normal: isotropic to what is seen here */
                for (int k = 0; k < 12; k++) sum += hd_random_symmetric(&random);
                *entry(&w, row, col) = sum;
            }
        measure(&w);
        const hd_fields *fields = hd_modes_fields(w.modes);
        for (int s = 0; s < hd_fields_subspaces(fields); s++) {
            const double d = hd_fields_subspace(fields, s)->dimension;
            double mean = 0.0;
            for (int col = 0; col < VECTORS; col++)
                mean += hd_modes_snapshot(w.modes, s, HD_WEIGHT)[col] / VECTORS;
            CHECK_CLOSE(mean, d / (3 * MANY), z * sqrt(2.0 * d / VECTORS) / (3 * MANY));
        }
        forget(&w);
    }
}
