#include "synthetic.h"

enum { VECTORS_MAX = 64 };

static void take_state(world *w)
{
    hd_trajectory_state(w->trajectory, w->q, w->p);
    hd_fields_sample(w->fields, w->q, w->p);
}

world world_create(hd_scene_def scene, int vectors, int threads)
{
    world w = {.scene = scene, .random = hd_random_seeded(scene.seed, 77)};
    const size_t size = 2 * (size_t)scene.number * sizeof(double);
    hd_blas_use_threads(threads); /* more would only wait for each other */
    w.q = malloc(size);
    w.p = malloc(size);
    CHECK_OK(hd_trajectory_create(&w.trajectory, &scene));
    CHECK_OK(hd_fields_create(&w.fields, &scene));
    CHECK_OK(hd_frame_create(&w.frame, PARTICLES(scene.number), vectors, scene.seed, threads));
    CHECK_OK(hd_modes_create(&w.modes, &scene, vectors, threads));
    CHECK_OK(hd_steps_create(&w.steps, &scene, w.modes));
    CHECK_OK(hd_spectrum_create(&w.spectrum, 4 * scene.number, vectors,
                                hd_scene_positive_exponents(&scene), 0.0));
    CHECK_OK(hd_trajectory_extend(w.trajectory, NULL, 20.0));
    take_state(&w);
    world_noise(&w);
    return w;
}

void world_free(world *w)
{
    hd_trajectory_free(w->trajectory);
    hd_fields_free(w->fields);
    hd_frame_free(w->frame);
    hd_steps_free(w->steps);
    hd_modes_free(w->modes);
    hd_spectrum_free(w->spectrum);
    free(w->q);
    free(w->p);
}

void world_move(world *w, double time)
{
    CHECK_OK(hd_trajectory_extend(w->trajectory, NULL, hd_trajectory_time(w->trajectory) + time));
    take_state(w);
}

void world_place(world *w, const double *q, const double *p)
{
    memcpy(w->q, q, (size_t)world_rows(w) * sizeof *q);
    memcpy(w->p, p, (size_t)world_rows(w) * sizeof *p);
    hd_fields_sample(w->fields, w->q, w->p);
}

/** Box and Muller. */
double random_normal(hd_random *random)
{
    const double u = 0.5 * (1.0 - hd_random_symmetric(random)); /* in (0, 1] */
    return sqrt(-2.0 * log(u)) * cos(PI * hd_random_symmetric(random));
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

/** Rows become orthonormal: Gram and Schmidt, twice for the sake of rounding. */
static void orthonormalise(double *rows, int count, int length)
{
    for (int a = 0; a < count; a++) {
        double *row = rows + (size_t)a * (size_t)length;
        for (int b = 0; b < 2 * a; b++) {
            const double *before = rows + (size_t)(b % a) * (size_t)length;
            const double overlap = dot(row, before, length);
            for (int k = 0; k < length; k++) row[k] -= overlap * before[k];
        }
        const double norm = sqrt(dot(row, row, length));
        assert_true(norm > 1e-6); /* the fields are independent */
        for (int k = 0; k < length; k++) row[k] /= norm;
    }
}

void random_rotation(hd_random *random, double *out, int n)
{
    for (int k = 0; k < n * n; k++) out[k] = random_normal(random);
    orthonormalise(out, n, n);
}

int world_rows(const world *w) { return 2 * w->scene.number; }

int world_subspace(const world *w, hd_mode_kind kind, int nx, int ny)
{
    for (int s = 0; s < hd_fields_subspaces(w->fields); s++) {
        const hd_subspace *x = hd_fields_subspace(w->fields, s);
        if (x->kind == kind && x->wave.n[0] == nx && x->wave.n[1] == ny) return s;
    }
    fail_msg("no fields of kind %d at (%d,%d)", (int)kind, nx, ny);
    return -1;
}

int world_dimension(const world *w, int subspace)
{
    return hd_fields_subspace(w->fields, subspace)->dimension;
}

void modulation_at(const hd_scene_def *scene, double out[3], const hd_wave *wave, unsigned bits,
                   const double *q)
{
    double f[2], df[2];
    for (int d = 0; d < 2; d++) {
        const double wall = scene->boundary[d] == R ? 0.5 : 0.0;
        const double k = wave->k[d], angle = k * (q[d] - wall);
        const bool sine = bits & (d == 0 ? HD_SIN_X : HD_SIN_Y);
        f[d] = sine ? sin(angle) : cos(angle);
        df[d] = sine ? k * cos(angle) : -k * sin(angle);
    }
    out[0] = f[0] * f[1];
    out[1] = df[0] * f[1];
    out[2] = f[0] * df[1];
}

void world_add_field(const world *w, double *out, int column, double factor)
{
    const size_t stride = (size_t)hd_fields_stride(w->fields);
    for (int row = 0; row < world_rows(w); row++)
        out[row] += factor * hd_fields_data(w->fields)[(size_t)row * stride + (size_t)column];
}

static double *element(const world *w, int row, int half, int col)
{
    const int at = 4 * (row / 2) + 2 * half + row % 2;
    return hd_frame_data(w->frame) + (size_t)at * (size_t)hd_frame_stride(w->frame) + (size_t)col;
}

void world_write(world *w, int col, const double *dq, const double *dp)
{
    const int rows = world_rows(w);
    const double norm = sqrt(dot(dq, dq, rows) + dot(dp, dp, rows));
    for (int row = 0; row < rows; row++) {
        *element(w, row, 0, col) = dq[row] / norm;
        *element(w, row, 1, col) = dp[row] / norm;
    }
}

void world_write_mode(world *w, int col, const double *dq, double c)
{
    HEAP double *dp = malloc((size_t)world_rows(w) * sizeof *dp);
    for (int row = 0; row < world_rows(w); row++) dp[row] = c * dq[row];
    world_write(w, col, dq, dp);
}

void world_read(const world *w, int col, double *dq, double *dp)
{
    for (int row = 0; row < world_rows(w); row++) {
        dq[row] = *element(w, row, 0, col);
        dp[row] = *element(w, row, 1, col);
    }
}

void world_noise(world *w)
{
    HEAP double *dq = malloc((size_t)world_rows(w) * sizeof *dq);
    for (int col = 0; col < hd_frame_vectors(w->frame); col++) {
        for (int row = 0; row < world_rows(w); row++) dq[row] = random_normal(&w->random);
        world_write_mode(w, col, dq, 1.0);
    }
}

/** [columns][2N]; returns the number of columns. */
static int fields_of(const world *w, double *out, const int *subspace, int subspaces)
{
    int count = 0;
    for (int k = 0; k < subspaces; k++) {
        const hd_subspace *s = hd_fields_subspace(w->fields, subspace[k]);
        for (int c = 0; c < s->dimension; c++, count++)
            world_add_field(w, out + (size_t)count * (size_t)world_rows(w), s->column + c, 1.0);
    }
    return count;
}

/** Row m of a rotation times the basis, and noise. */
static void write_turned(world *w, int col, const double *basis, const double *turn, int count,
                         double noise)
{
    const int rows = world_rows(w);
    HEAP double *dq = calloc((size_t)rows, sizeof *dq);
    for (int row = 0; row < rows; row++) {
        for (int b = 0; b < count; b++)
            dq[row] += turn[b] * basis[(size_t)b * (size_t)rows + (size_t)row];
        dq[row] += noise / sqrt(rows) * random_normal(&w->random);
    }
    world_write_mode(w, col, dq, 1.0);
}

void world_span(world *w, int col, const int *subspace, int subspaces, double noise)
{
    double turn[VECTORS_MAX * VECTORS_MAX];
    HEAP double *basis = calloc(VECTORS_MAX * (size_t)world_rows(w), sizeof *basis);
    const int count = fields_of(w, basis, subspace, subspaces);
    orthonormalise(basis, count, world_rows(w));
    random_rotation(&w->random, turn, count);
    for (int m = 0; m < count; m++) write_turned(w, col + m, basis, turn + m * count, count, noise);
}

void world_turn(world *w, int a, int b, double angle)
{
    for (int row = 0; row < world_rows(w); row++)
        for (int half = 0; half < 2; half++) {
            double *x = element(w, row, half, a), *y = element(w, row, half, b);
            const double turned = cos(angle) * *x - sin(angle) * *y;
            *y = sin(angle) * *x + cos(angle) * *y;
            *x = turned;
        }
}

void world_look(world *w)
{
    CHECK_OK(hd_modes_measure(w->modes, hd_frame_columns(w->frame), w->q, w->p));
    hd_modes_add(w->modes);
}

void world_stretch(world *w, const double *exponents)
{
    hd_spectrum_add(w->spectrum, exponents, 1.0);
    hd_spectrum_sample(w->spectrum);
}

void world_find(world *w, const double *exponents)
{
    world_look(w);
    world_stretch(w, exponents);
    hd_steps_find(w->steps, w->spectrum);
}

const hd_step *world_step(const world *w, hd_mode_kind kind, int nx, int ny)
{
    return hd_steps_step(w->steps, world_subspace(w, kind, nx, ny));
}

void exponents_falling(const world *w, double *out)
{
    const int n = hd_frame_vectors(w->frame);
    for (int col = 0; col < n; col++) out[col] = 3.0 - 2.9 * col / n;
}

void exponents_flat(double *out, int col, int count, double value)
{
    for (int k = col; k < col + count; k++) out[k] = value;
}
