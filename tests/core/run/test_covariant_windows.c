/** Windows of covariant vectors: what is made of them is what is made of the same vectors by hand.
 */
#include <float.h>

#include "base/memory.h"
#include "passage.h"
#include "windows.h"

static const double PI = 3.14159265358979323846;

enum {
    WARMUP = 400,
    DISKS = 12,
    ROWS = 4 * DISKS,
    LOOKS = 5,
    PER_LOOK = 8,
    LAST = LOOKS * PER_LOOK,
    END = 120
};

/* ---- a window by hand ---------------------------------------------------------------------- */

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
    hd_trajectory *trajectory;
    hd_scene_box(scene, box);
    CHECK_OK(hd_trajectory_create(&trajectory, scene));
    CHECK_OK(hd_trajectory_extend(trajectory, NULL, WINDOWS_INTERVAL * (WARMUP + at)));
    hd_trajectory_state(trajectory, q, p);
    hd_trajectory_free(trajectory);
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
    hd_backward *c = passage_back(x, END, LAST, 0), *other = passage_back(x, END, LAST, 1);
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
    hd_backward_free(c);
    hd_backward_free(other);
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
    const hd_splitting *s = hd_covariant_splitting(c);
    for (int col = 0; col < ROWS; col++) {
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_spectrum(c), col), t->exponent[col],
                    ROUNDING);
        CHECK_CLOSE(hd_spectrum_local(hd_covariant_spectrum(c), col), t->local[col], ROUNDING);
        CHECK_CLOSE(hd_covariant_widths(c)[col], exp(t->entropy[col]) / DISKS, ROUNDING);
        CHECK_CLOSE(hd_covariant_cosines(c)[col], t->cosine[col], ROUNDING);
        CHECK_CLOSE(hd_covariant_start_mismatch_each(c)[col], t->met[col], ROUNDING);
        if (col + 1 == ROWS) break;
        CHECK_CLOSE(hd_splitting_neighbours(s)[col], t->neighbours[col],
                    1e-7); /* small ones by their cosine */
        CHECK_CLOSE(hd_splitting_violations(s)[col], t->violations[col], 1e-14);
    }
    const hd_modes *const sets[] = {hd_covariant_half(c, 0), hd_covariant_half(c, 1),
                                    hd_covariant_of_frame(c)};
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

static void a_window_is_what_is_computed_by_hand(void **state)
{
    (void)state;
    const hd_scene_def scene = windows_scene(DISKS, HD_PERIODIC, HD_PERIODIC);
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    passage x = passage_of(&scene, 1, WARMUP, END, WINDOWS_INTERVAL);
    const twin t = twin_of(&scene, &x);
    const double begin = hd_trajectory_time(w.f.trajectory);
    int count = 1;
    while (!windows_forward(&w)) count++;
    assert_int_equal(count, END);
    windows_back(&w);
    assert_int_equal(hd_covariant_windows(w.c), 1);
    assert_int_equal(hd_splitting_samples(hd_covariant_splitting(w.c)), LOOKS);
    CHECK_CLOSE(hd_spectrum_time(hd_covariant_spectrum(w.c)), 10.0, 1e-12);
    CHECK_CLOSE(hd_covariant_window_end(w.c), begin + 10.0, 1e-12);
    check_means(w.c, &t);
    double halves = 0.0, kinds = 0.0; /* what would not be seen if they were the same */
    for (int col = 0; col < ROWS; col++) {
        halves = fmax(halves, fabs(t.weight[0][0][col] - t.weight[0][1][col]));
        kinds = fmax(kinds, fabs(t.weight[0][0][col] - t.weight[0][2][col]));
    }
    assert_true(halves > 0.01 && kinds > 0.01);
    passage_free(&x);
    windows_free(&w);
}

/* ---- windows one after the other ----------------------------------------------------------- */

/** Without gaps; each look is one of exactly one window. */
static void windows_follow_each_other(void **state)
{
    (void)state;
    const hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    const double begin = hd_trajectory_time(w.f.trajectory);
    for (int count = 1; count <= 8; count++) {
        windows_finish(&w, count);
        CHECK_CLOSE(hd_covariant_window_end(w.c), begin + 10.0 * count, 1e-9);
        CHECK_CLOSE(hd_trajectory_time(w.f.trajectory), begin + 10.0 * count + 20.0, 1e-9);
        CHECK_CLOSE(hd_spectrum_time(hd_covariant_spectrum(w.c)), 10.0 * count, 1e-9);
        assert_int_equal(hd_splitting_samples(hd_covariant_splitting(w.c)), LOOKS * count);
    }
    assert_int_equal(hd_covariant_lost(w.c), 0);
    windows_free(&w);
}

/** A window goes on to a look, its transient from there to another one. */
static void looks_that_fall_elsewhere_shorten_nothing(void **state)
{
    (void)state;
    hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    scene.covariant_window = 5.0;
    scene.covariant_transient = 3.0;
    scene.covariant_sampling = 4.0;
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    const double begin = hd_trajectory_time(w.f.trajectory);
    for (int count = 1; count <= 4; count++) {
        windows_finish(&w, count);
        CHECK_CLOSE(hd_covariant_window_end(w.c), begin + 8.0 * count, 1e-9);
        CHECK_CLOSE(hd_trajectory_time(w.f.trajectory), begin + 8.0 * count + 4.0, 1e-9);
    }
    assert_int_equal(hd_covariant_lost(w.c), 0);
    windows_free(&w);
}

/** Both give the growth of the same spaces over nearly the same time. In the centre pairs of
 * vectors shear: on the way back a start grows with the time since, so over a window it has
 * ln((window + transient) / transient) to lose; the first three do not turn. */
static void check_exponent(const hd_spectrum *back, const hd_spectrum *forward, int col,
                           int positive)
{
    const double one = hd_spectrum_std_error(forward, col),
                 other = hd_spectrum_std_error(back, col);
    const double exponent = hd_spectrum_exponent(back, col);
    const bool central = col >= positive && col < positive + 6; /* decays: no error may be known */
    assert_true(central || (one > 0 && other > 0 && one < 0.08 && other < 0.08));
    if (col >= positive + 3 && col < positive + 6)
        CHECK_CLOSE(exponent, -log(30.0 / 20.0) / 10.0,
                    0.003); /* the shear's own start is 1 time unit or so */
    else
        CHECK_CLOSE(exponent, hd_spectrum_exponent(forward, col),
                    central ? 1e-3 : 4.0 * hypot(one, other));
}

static void exponents_are_those_of_the_frame(void **state)
{
    (void)state;
    const hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    hd_spectrum *forward;
    CHECK_OK(hd_spectrum_create(&forward, 16, 16, 0.0));
    for (int k = 1; hd_covariant_windows(w.c) < 30; k++) {
        if (windows_forward(&w)) windows_back(&w);
        hd_spectrum_add(forward, hd_ortho_log_stretch(w.f.ortho), WINDOWS_INTERVAL);
        if (k % PER_LOOK == 0) hd_spectrum_sample(forward);
    }
    for (int col = 0; col < 16; col++) check_exponent(hd_covariant_spectrum(w.c), forward, col, 5);
    hd_spectrum_free(forward);
    windows_free(&w);
}

/* ---- where triangles wait ------------------------------------------------------------------ */

static void check_same(const hd_covariant *c, const hd_covariant *want, double tolerance)
{
    const int n = hd_covariant_vectors(want);
    assert_int_equal(hd_covariant_windows(c), hd_covariant_windows(want));
    for (int col = 0; col < n; col++) {
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_spectrum(c), col),
                    hd_spectrum_exponent(hd_covariant_spectrum(want), col), tolerance);
        CHECK_CLOSE(hd_covariant_widths(c)[col], hd_covariant_widths(want)[col], tolerance);
        CHECK_CLOSE(hd_covariant_cosines(c)[col], hd_covariant_cosines(want)[col], tolerance);
    }
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++)
        CHECK_CLOSE(hd_splitting_angle(hd_covariant_splitting(c), (hd_pair_of_spaces)pair)->mean,
                    hd_splitting_angle(hd_covariant_splitting(want), (hd_pair_of_spaces)pair)->mean,
                    tolerance);
}

/** Triangles that are computed again are the same to rounding of Q,
 * eps condition, which a vector that leans little out of those before it feels the more. */
static void both_storages_give_the_same(void **state)
{
    (void)state;
    hd_scene_def scene = windows_scene(6, HD_PERIODIC, HD_PERIODIC);
    windows w[2];
    for (int storage = 0; storage < 2; storage++) {
        scene.covariant_storage = (hd_storage)storage;
        w[storage] = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
        windows_finish(&w[storage], 20);
    }
    check_same(w[HD_STORAGE_RECOMPUTE].c, w[HD_STORAGE_MEMORY].c,
               64.0 * DBL_EPSILON * w[0].f.worst);
    for (int storage = 0; storage < 2; storage++) windows_free(&w[storage]);
}

/** In memory a ring grows as it is needed, once. */
static void later_windows_take_no_memory(void **state)
{
    (void)state;
    const hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    windows_finish(&w, 8); /* 80 + 20 time units: the ring has gone round */
    const size_t before = hd_memory_allocations();
    windows_finish(&w, 20);
    assert_int_equal(hd_memory_allocations(), before);
    windows_free(&w);
}

/** Intervals a quarter as long as expected: the first window finds no room, the next ones do. */
static void a_window_without_room_is_lost_and_the_next_is_not(void **state)
{
    (void)state;
    hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    const size_t triangles = 8 * 16 * 17 / 2; /* bytes of one */
    windows w = windows_begun(&scene, WARMUP, 4.0 * WINDOWS_INTERVAL);
    windows_finish(&w, 5);
    assert_int_equal(hd_covariant_lost(w.c), 1);
    hd_covariant_clear(w.c);
    assert_int_equal(hd_covariant_lost(w.c), 0);
    windows_free(&w);
    /* and its snapshots */
    scene.covariant_memory = 1e-9 * (80.0 * (double)triangles + 21.0 * 8 * 16 * 17);
    w = windows_begun(&scene, WARMUP, 4.0 * WINDOWS_INTERVAL);
    for (int k = 0; k < 1000; k++) assert_false(windows_forward(&w));
    assert_true(hd_covariant_lost(w.c) > 10);
    windows_free(&w);
}

static void too_little_room_is_refused_with_the_numbers(void **state)
{
    (void)state;
    char message[400] = "";
    hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    CHECK_OK(hd_covariant_check_room(&scene, 0.25, message, sizeof message));
    scene.covariant_memory = 1e-4;
    assert_int_equal(hd_covariant_check_room(&scene, 0.25, message, sizeof message), HD_REFUSED);
    const char *numbers[] = {"covariant_window = 10", "covariant_transient = 20", "16 vectors",
                             "covariant_memory = 0.0001 GB"};
    for (int k = 0; k < 4; k++) assert_non_null(strstr(message, numbers[k]));
    hd_covariant *c;
    forward_pass f = forward_started(&scene, 1);
    CHECK_OK(hd_covariant_create(&c, &scene, 1));
    assert_int_equal(hd_covariant_begin(c, hd_frame_columns(f.frame), 0.0, 0.25), HD_NO_ROOM);
    hd_covariant_free(c);
    forward_free(&f);
}

/* ---- the centre, transients, parts of the spectrum ----------------------------------------- */

/** Rounding turns a vector by eps condition. */
static void the_centre_is_the_null_space(void **state)
{
    (void)state;
    const hd_boundary boundary[][2] = {{HD_PERIODIC, HD_PERIODIC},
                                       {HD_PERIODIC, HD_REFLECTING},
                                       {HD_REFLECTING, HD_PERIODIC},
                                       {HD_REFLECTING, HD_REFLECTING}};
    for (int k = 0; k < 4; k++) {
        hd_scene_def scene = windows_scene(6, boundary[k][0], boundary[k][1]);
        scene.covariant_transient = 60.0;
        windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
        windows_finish(&w, 10);
        const double rounding = 16.0 * DBL_EPSILON * w.f.worst;
        CHECK_CLOSE(hd_covariant_null_most(w.c), 0.0, rounding);
        CHECK_CLOSE(hd_covariant_start_mismatch(w.c).centre, 0.0, rounding);
        CHECK_CLOSE(hd_covariant_start_mismatch(w.c).stable, 0.0, rounding);
        assert_true(hd_covariant_null(w.c) >= 0 &&
                    hd_covariant_null(w.c) <= hd_covariant_null_most(w.c));
        windows_free(&w);
    }
}

static windows after_transient(double transient)
{
    hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    scene.covariant_sampling = 0.5;
    scene.covariant_transient = transient;
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    windows_finish(&w, 3);
    return w;
}

/** exp(-gap t): the gap is 1.6 around the centre, and 0.3 to 0.6 between the unstable ones. */
static void too_short_a_transient_is_seen(void **state)
{
    (void)state;
    const double transient[] = {0.5, 4.0, 16.0, 100.0};
    windows w[4];
    for (int k = 0; k < 4; k++) w[k] = after_transient(transient[k]);
    for (int k = 0; k + 1 < 4; k++) {
        const hd_covariant_mismatch met = hd_covariant_start_mismatch(w[k].c),
                                    longer = hd_covariant_start_mismatch(w[k + 1].c);
        const double rounding = 16.0 * DBL_EPSILON * w[k + 1].f.worst; /* where both have met */
        assert_true(longer.stable < fmax(met.stable, rounding) &&
                    longer.centre < fmax(met.centre, rounding));
        for (int col = 1; k > 0 && col < 5; col++) /* two random starts may lie near each other */
            assert_true(hd_covariant_start_mismatch_each(w[k + 1].c)[col] <
                        hd_covariant_start_mismatch_each(w[k].c)[col]);
    }
    const hd_covariant_mismatch none = hd_covariant_start_mismatch(w[0].c),
                                met = hd_covariant_start_mismatch(w[3].c);
    assert_true(none.most > 0.1 && none.centre > 0.1 && none.stable > 0.1);
    assert_true(hd_covariant_null_most(w[0].c) > 0.1);
    CHECK_CLOSE(met.centre, 0.0, 16.0 * DBL_EPSILON * w[3].f.worst);
    CHECK_CLOSE(met.stable, 0.0, 16.0 * DBL_EPSILON * w[3].f.worst);
    for (int col = 0; col < 16; col++) {
        const double apart = hd_covariant_start_mismatch_each(w[3].c)[col];
        assert_true(apart <= met.most);
        if (col < 5 || col > 10) CHECK_CLOSE(apart, 0.0, 16.0 * DBL_EPSILON * w[3].f.worst);
    }
    assert_true(met.most > 0.1); /* vectors of equal exponents do not meet */
    for (int k = 0; k < 4; k++) windows_free(&w[k]);
}

/** The first vector alone; the positive half; into the centre; through it; all. */
static void any_number_of_vectors_will_do(void **state)
{
    (void)state;
    for (int disks = 2; disks <= 5; disks++) {
        hd_scene_def scene = windows_scene(disks, HD_PERIODIC, HD_PERIODIC);
        const int positive = 2 * disks - 3;
        for (int n = 1; n <= 4 * disks; n++) {
            scene.exponents = n;
            windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
            windows_finish(&w, 2);
            const bool centre = n >= positive + 6;
            assert_int_equal(hd_splitting_has_spaces(hd_covariant_splitting(w.c)),
                             n > positive + 6);
            assert_int_equal(hd_covariant_null_most(w.c) >= 0, centre);
            assert_int_equal(hd_covariant_start_mismatch(w.c).centre >= 0, centre);
            assert_int_equal(hd_covariant_start_mismatch(w.c).stable >= 0, n > positive + 6);
            assert_true(hd_covariant_start_mismatch(w.c).most >= 0);
            windows_free(&w);
        }
    }
}

/* ---- given up ------------------------------------------------------------------------------ */

/** A way back that was given up in the middle of its window leaves nothing: what follows is what a
 * new one finds. */
static void a_window_given_up_leaves_nothing(void **state)
{
    (void)state;
    hd_scene_def scene = windows_scene(4, HD_PERIODIC, HD_PERIODIC);
    scene.covariant_transient = 120.0;
    scene.covariant_sampling = 0.5;
    windows w = windows_begun(&scene, WARMUP, WINDOWS_INTERVAL);
    while (!windows_forward(&w)) {
    }
    for (int k = 0; k < 120 * 4 + 39; k++)
        CHECK_OK(hd_covariant_step(w.c)); /* one interval of the window is left */
    const double now = hd_trajectory_time(w.f.trajectory);
    const int done = (int)(now / WINDOWS_INTERVAL + 0.5);
    hd_covariant_clear(w.c);
    CHECK_OK(hd_covariant_begin(w.c, hd_frame_columns(w.f.frame), now, WINDOWS_INTERVAL));
    windows fresh = windows_begun(&scene, done, WINDOWS_INTERVAL);
    windows_finish(&w, 2);
    windows_finish(&fresh, 2);
    for (int col = 0; col < 16; col++) {
        if (col > 3 && col < 11)
            continue; /* between equal exponents each start has vectors of its own */
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_spectrum(w.c), col),
                    hd_spectrum_exponent(hd_covariant_spectrum(fresh.c), col), 1e-9);
        if (col == 15) break;
        CHECK_CLOSE(hd_splitting_violations(hd_covariant_splitting(w.c))[col],
                    hd_splitting_violations(hd_covariant_splitting(fresh.c))[col], 1e-12);
    }
    windows_free(&w);
    windows_free(&fresh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_window_is_what_is_computed_by_hand),
        cmocka_unit_test(windows_follow_each_other),
        cmocka_unit_test(looks_that_fall_elsewhere_shorten_nothing),
        cmocka_unit_test(exponents_are_those_of_the_frame),
        cmocka_unit_test(both_storages_give_the_same),
        cmocka_unit_test(later_windows_take_no_memory),
        cmocka_unit_test(a_window_without_room_is_lost_and_the_next_is_not),
        cmocka_unit_test(too_little_room_is_refused_with_the_numbers),
        cmocka_unit_test(the_centre_is_the_null_space),
        cmocka_unit_test(too_short_a_transient_is_seen),
        cmocka_unit_test(any_number_of_vectors_will_do),
        cmocka_unit_test(a_window_given_up_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
