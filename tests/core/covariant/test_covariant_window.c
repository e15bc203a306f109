/** A window of covariant vectors: what is made of them is what is made of the same vectors by hand.
 */
#include "passage.h"
#include "windows.h"

OWNABLE(hd_backward)

enum {
    WARMUP = 400,
    DISKS = 12,
    ROWS = 4 * DISKS,
    LOOKS = 5,
    PER_LOOK = 8,
    LAST = LOOKS * PER_LOOK,
    END = 120
};

/** Means over the looks of one window. */
typedef struct twin {
    double exponent[ROWS], local[ROWS], entropy[ROWS], cosine[ROWS], neighbours[ROWS],
        violations[ROWS], met[ROWS];
    double weight[2][3][ROWS]; /* T(1,0), LP(1,0) of dq, of dp, of the frame's dq */
} twin;

static double half_dot(const double *v, int col, int one, int other)
{
    double sum = 0.0;
    for (int disk = 0; disk < DISKS; disk++)
        for (int d = 0; d < 2; d++)
            sum += v[(4 * disk + 2 * one + d) * ROWS + col] *
                   v[(4 * disk + 2 * other + d) * ROWS + col];
    return sum;
}

static void add_shape(twin *t, const double *v)
{
    for (int col = 0; col < ROWS; col++) {
        for (int disk = 0; disk < DISKS; disk++) {
            double part = 0.0;
            for (int d = 0; d < 4; d++)
                part += v[(4 * disk + d) * ROWS + col] * v[(4 * disk + d) * ROWS + col];
            t->entropy[col] -= part * log(part) / LOOKS;
        }
        t->cosine[col] += fabs(half_dot(v, col, 0, 1)) /
                          sqrt(half_dot(v, col, 0, 0) * half_dot(v, col, 1, 1)) / LOOKS;
    }
}

enum { FIELDS = 6, LENGTH = 2 * DISKS };

static double row_dot(const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < LENGTH; k++) sum += a[k] * b[k];
    return sum;
}

/** Row `last`, to those from `first` on: twice. */
static void orthonormalise(double field[FIELDS][LENGTH], int first, int last)
{
    for (int k = 0; k < 2 * (last - first); k++) {
        const double *before = field[first + k % (last - first)],
                     overlap = row_dot(before, field[last]);
        for (int row = 0; row < LENGTH; row++) field[last][row] -= overlap * before[row];
    }
    const double length = sqrt(row_dot(field[last], field[last]));
    for (int row = 0; row < LENGTH; row++) field[last][row] /= length;
}

/** Rows: curl of cos kx and sin kx; grad of them; p times them. Each block orthonormal in itself.
 */
static void fill_fields(double field[FIELDS][LENGTH], const double *q, const double *p, double k)
{
    for (int disk = 0; disk < DISKS; disk++)
        for (int phase = 0; phase < 2; phase++) {
            const double x = k * q[2 * disk], a = phase ? sin(x) : cos(x),
                         slope = phase ? cos(x) : -sin(x);
            field[phase][2 * disk] = field[2 + phase][2 * disk + 1] = 0.0;
            field[phase][2 * disk + 1] = -slope;
            field[2 + phase][2 * disk] = slope;
            for (int d = 0; d < 2; d++) field[4 + phase][2 * disk + d] = p[2 * disk + d] * a;
        }
    for (int one = 0; one < FIELDS; one++) orthonormalise(field, one < 2 ? 0 : 2, one);
}

static void add_weights(twin *t, int set, const double *v, int half, double field[FIELDS][LENGTH])
{
    for (int col = 0; col < ROWS; col++)
        for (int k = 0; k < FIELDS; k++) {
            double overlap = 0.0;
            for (int row = 0; row < LENGTH; row++)
                overlap += field[k][row] * v[(4 * (row / 2) + 2 * half + row % 2) * ROWS + col];
            t->weight[k >= 2][set][col] += overlap * overlap / half_dot(v, col, half, half) / LOOKS;
        }
}

static void add_look(twin *t, const hd_scene_def *scene, const passage *x, const hd_backward *c,
                     int at)
{
    double q[LENGTH], p[LENGTH], box[2], field[FIELDS][LENGTH], *v = passage_vectors(x, c, at);
    hd_scene_box(scene, box);
    MADE(hd_trajectory, trajectory, scene);
    CHECK_OK(hd_trajectory_extend(trajectory, NULL, WINDOWS_INTERVAL * (WARMUP + at)));
    hd_trajectory_state(trajectory, q, p);
    add_shape(t, v);
    fill_fields(field, q, p, 2.0 * PI / box[0]);
    add_weights(t, 0, v, 0, field);
    add_weights(t, 1, v, 1, field);
    add_weights(t, 2, x->q[at], 0, field);
    for (int col = 0; col + 1 < ROWS; col++) {
        double dot = 0.0; /* of C's columns: Q is orthonormal */
        for (int row = 0; row < ROWS; row++)
            dot += hd_backward_read(c)[col * ROWS + row] *
                   hd_backward_read(c)[(col + 1) * ROWS + row];
        t->neighbours[col] += acos(fmin(1.0, fabs(dot))) / LOOKS;
    }
    free(v);
}

static twin twin_of(const hd_scene_def *scene, const passage *x)
{
    twin t = {0};
    double growth[ROWS];
    OWNED(hd_backward) *c = passage_back(x, END, LAST, 0), *other = passage_back(x, END, LAST, 1);
    for (int col = 0; col < ROWS; col++) t.met[col] = hd_backward_apart(c, other, col);
    for (int at = LAST; at > 0; at--) {
        if (at % PER_LOOK == 0) {
            add_look(&t, scene, x, c, at);
            memset(t.local, 0, sizeof t.local);
        }
        CHECK_OK(hd_backward_step(c, growth, x->factor[at - 1]));
        for (int col = 0; col < ROWS; col++) {
            t.exponent[col] += growth[col] / (LAST * WINDOWS_INTERVAL);
            t.local[col] += growth[col] / (PER_LOOK * WINDOWS_INTERVAL);
        }
        for (int col = 0; at % PER_LOOK == 1 && col + 1 < ROWS; col++)
            t.violations[col] += (t.local[col] < t.local[col + 1]) / (double)LOOKS;
    }
    return t;
}

static int subspace_of(const hd_modes *modes, hd_mode_kind kind)
{
    for (int s = 0; s < hd_fields_subspaces(hd_modes_fields(modes)); s++) {
        const hd_subspace *space = hd_fields_subspace(hd_modes_fields(modes), s);
        if (space->kind == kind && space->wave.n[0] == 1 && space->wave.n[1] == 0) return s;
    }
    fail();
    return -1;
}

/** Vectors are the same up to what two ways of summing make of a few hundred products each. */
static const double ROUNDING = 1e-11;

static void check_means(const hd_covariant *c, const twin *t)
{
    const hd_splitting_results s = hd_covariant_read(c).splitting;
    for (int col = 0; col < ROWS; col++) {
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_read(c).spectrum, col), t->exponent[col],
                    ROUNDING);
        CHECK_CLOSE(hd_spectrum_local(hd_covariant_read(c).spectrum, col), t->local[col], ROUNDING);
        CHECK_CLOSE(hd_covariant_read(c).widths[col], exp(t->entropy[col]) / DISKS, ROUNDING);
        CHECK_CLOSE(hd_covariant_read(c).cosines[col], t->cosine[col], ROUNDING);
        CHECK_CLOSE(hd_covariant_read(c).start_mismatch_each[col], t->met[col], ROUNDING);
        if (col + 1 == ROWS) break;
        CHECK_CLOSE(s.neighbours[col], t->neighbours[col], 1e-7); /* small ones by their cosine */
        CHECK_CLOSE(hd_covariant_read(c).order[0].violations[col], t->violations[col], 1e-14);
    }
    const hd_modes *const sets[] = {hd_covariant_read(c).half[0], hd_covariant_read(c).half[1],
                                    hd_covariant_read(c).of_frame};
    for (int set = 0; set < 3; set++)
        for (int kind = 0; kind < 2; kind++) {
            const hd_modes *modes = sets[set];
            const int space = subspace_of(modes, kind ? HD_MODE_LP : HD_MODE_T);
            assert_int_equal(hd_modes_samples(modes), LOOKS);
            for (int col = 0; col < ROWS; col++)
                CHECK_CLOSE(hd_modes_average(modes, space, HD_WEIGHT)[col],
                            t->weight[kind][set][col], 10 * ROUNDING);
        }
}

TEST(a_window_is_what_is_computed_by_hand)
{
    const hd_scene_def scene = windows_scene(DISKS, P, P);
    HELD(windows) w = windows_begun(scene, WARMUP, WINDOWS_INTERVAL);
    HELD(passage) x = passage_of(scene, 1, WARMUP, END, WINDOWS_INTERVAL);
    const twin t = twin_of(&scene, &x);
    const double begin = hd_trajectory_time(w.f.trajectory);
    int count = 1;
    while (!windows_forward(&w)) count++;
    assert_int_equal(count, END);
    windows_back(&w);
    assert_int_equal(hd_covariant_read(w.c).windows, 1);
    assert_int_equal(hd_covariant_read(w.c).splitting.samples, LOOKS);
    CHECK_CLOSE(hd_spectrum_time(hd_covariant_read(w.c).spectrum), 10.0, 1e-12);
    CHECK_CLOSE(hd_covariant_read(w.c).window_end, begin + 10.0, 1e-12);
    check_means(w.c, &t);
    double halves = 0.0, kinds = 0.0; /* what would not be seen if they were the same */
    for (int col = 0; col < ROWS; col++) {
        halves = fmax(halves, fabs(t.weight[0][0][col] - t.weight[0][1][col]));
        kinds = fmax(kinds, fabs(t.weight[0][0][col] - t.weight[0][2][col]));
    }
    assert_true(halves > 0.01 && kinds > 0.01);
}
