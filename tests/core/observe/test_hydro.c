/** Responses against differences of the sums that they respond with, and the paper's table. */
#include "synthetic.h"

enum { DISKS = 60, ROWS = 2 * DISKS, SUMS = 4 };

/** Sums over the disks, as hd_hydro_response names them. */
enum { DENSITY, ALONG, ACROSS, ENERGY };

/** Bits of A'. */
static unsigned behind_walls(const world *w, unsigned bits)
{
    return bits | (w->scene.boundary[0] == R ? HD_SIN_X : 0) |
           (w->scene.boundary[1] == R ? HD_SIN_Y : 0);
}

/** The sums themselves, from their definition in hydro.h; p is weighted [T26]. */
static void sums_of(const world *w, double out[SUMS], const hd_wave *wave, unsigned bits,
                    const double *q, const double *p)
{
    memset(out, 0, SUMS * sizeof *out);
    for (int j = 0; j < DISKS; j++) {
        double a[3], b[3];
        const double mass = pow(hd_scene_root_mass(&w->scene, j), 2.0), px = sqrt(mass) * p[2 * j],
                     py = sqrt(mass) * p[2 * j + 1];
        modulation_at(&w->scene, a, wave, bits, q + 2 * j);
        modulation_at(&w->scene, b, wave, behind_walls(w, bits), q + 2 * j);
        out[DENSITY] += a[0] / wave->number;
        out[ALONG] += (px * a[1] + py * a[2]) / wave->number;
        out[ACROSS] += (px * b[2] - py * b[1]) / wave->number;
        out[ENERGY] += (px * px + py * py) / mass * a[0];
    }
    for (int k = 0; k < SUMS; k++) out[k] /= sqrt(DISKS / 2.0);
}

static void numbers_of(double out[SUMS], const hd_hydro_response *r)
{
    out[DENSITY] = r->density;
    out[ALONG] = r->along;
    out[ACROSS] = r->across;
    out[ENERGY] = r->energy;
}

/* ---- against differences ------------------------------------------------------------------- */

/** The sums in the state displaced by h times a column. */
static void displaced(const world *w, double out[SUMS], const hd_hydro_response *r, double h)
{
    double q[ROWS], p[ROWS], dq[ROWS], dp[ROWS];
    world_read(w, r->col, dq, dp);
    for (int row = 0; row < ROWS; row++) {
        q[row] = w->q[row] + h * dq[row] / hd_scene_root_mass(&w->scene, row / 2);
        p[row] = w->p[row] + h * dp[row];
    }
    sums_of(w, out, &hd_steps_step(w->steps, r->step)->wave, r->modulation, q, p);
}

static void check_response(const world *w, const hd_hydro_response *r)
{
    /* third derivatives k^3 p^2 / 6 below 10, of a vector whose entries are 1 / sqrt(4N); sums of
       order 10 with rounding eps each */
    const double H = 1e-4, DIFFERENCE = 10.0 * H * H + 10.0 * DISKS * DBL_EPSILON / H;
    double ahead[SUMS], behind[SUMS], got[SUMS];
    displaced(w, ahead, r, H);
    displaced(w, behind, r, -H);
    numbers_of(got, r);
    for (int k = 0; k < SUMS; k++)
        CHECK_CLOSE(got[k], (ahead[k] - behind[k]) / (2.0 * H), DIFFERENCE);
}

/** All steps of one node at the end of the frame; dp at random; half of the disks of this mass. */
static world all_steps(hd_boundary x, hd_boundary y, double mass, double *exponents, int vectors)
{
    const hd_scene_def def = scene(.number = DISKS, .density = 0.5, .aspect = 0.8, .boundary[0] = x,
                                   .boundary[1] = y, .seed = 5, .max_mode_number = 1);
    world w = world_create(mass == 1 ? def : with_second(def, 0.5, 1.0, mass), vectors, 1);
    exponents_falling(&w, exponents);
    for (int s = 0, col = vectors; s < hd_fields_subspaces(w.fields); s++) {
        col -= world_dimension(&w, s);
        world_span(&w, col, &s, 1, 0.1);
        exponents_flat(exponents, col, world_dimension(&w, s), 0.3 + 0.05 * s);
    }
    for (int col = 0; col < vectors; col++) {
        double dq[ROWS], dp[ROWS];
        world_read(&w, col, dq, dp);
        for (int row = 0; row < ROWS; row++) dp[row] = random_normal(&w.random) / sqrt(ROWS);
        world_write(&w, col, dq, dp);
    }
    world_find(&w, exponents);
    return w;
}

/** Vectors outside, modulations inside, one step after the other. */
static void check_entries(const world *w, const hd_hydro *hydro)
{
    int index = 0;
    for (int k = 0; k < hd_steps_count(w->steps); k++) {
        const hd_step *step = hd_steps_step(w->steps, k);
        if (step->kind == HD_MODE_ZERO) continue;
        assert_true(step->resolved && step->members == 1);
        const hd_modulations m = step->wave.pairs;
        for (int v = 0; v < step->expected; v++)
            for (int c = 0; c < m.count; c++) {
                const hd_hydro_response *r = hd_hydro_at(hydro, index++);
                assert_int_equal(r->step, k);
                assert_int_equal(r->col, step->col + v);
                assert_int_equal(r->modulation, m.bits[c]);
                check_response(w, r);
            }
    }
    assert_int_equal(hd_hydro_count(hydro), index);
}

TEST(responses_are_derivatives)
{
    for (int k = 0; k < 8; k++) {
        double exponents[30];
        HELD(world) w = all_steps(k & 1 ? R : P, k & 2 ? R : P, k & 4 ? 4.0 : 1.0, exponents, 30);
        MADE(hd_hydro, hydro, &w.scene, w.steps);
        hd_hydro_measure(hydro, w.steps, hd_frame_columns(w.frame), w.q, w.p);
        check_entries(&w, hydro);
        world_move(&w, 3.0); /* the same vectors elsewhere */
        hd_hydro_measure(hydro, w.steps, hd_frame_columns(w.frame), w.q, w.p);
        check_entries(&w, hydro);
    }
}

/** What is not resolved has no responses; a vector that belongs to nobody neither. */
TEST(only_vectors_of_resolved_steps_respond)
{
    double exponents[30];
    HELD(world) w = all_steps(P, P, 1.0, exponents, 30);
    MADE(hd_hydro, hydro, &w.scene, w.steps);
    const hd_step *t = world_step(&w, HD_MODE_T, 1, 0), *lp = world_step(&w, HD_MODE_LP, 1, 0);
    world_turn(&w, lp->col + 1, 0, 1.3); /* keeps cos^2 = 0.07 of it */
    exponents[t->col] *= 3.0;
    hd_modes_clear(w.modes);
    hd_spectrum_clear(w.spectrum);
    world_find(&w, exponents);
    hd_hydro_measure(hydro, w.steps, hd_frame_columns(w.frame), w.q, w.p);
    assert_true(lp->resolved && !t->resolved);
    int named = 0, seen = 0;
    for (int e = 0; e < hd_hydro_count(hydro); e++) {
        const hd_hydro_response *r = hd_hydro_at(hydro, e);
        if (r->step == lp->subspace && seen++ < 6) {
            const int cols[] = {lp->col, lp->col + 2, lp->col + 3};
            assert_int_equal(r->col, cols[named++ / 2]);
            check_response(&w, r);
        } else if (r->step == lp->subspace || r->step == t->subspace) {
            double numbers[SUMS];
            numbers_of(numbers, r);
            assert_int_equal(r->col, -1);
            for (int k = 0; k < SUMS; k++) CHECK_CLOSE(numbers[k], 0.0, 0.0);
        }
    }
    assert_int_equal(named, 6);
}

/** Of a set that two steps share each has the vectors that are most of it. */
TEST(vectors_of_a_shared_set_respond_once)
{
    enum { VECTORS = 30, DIMENSIONS = 6, FIRST = VECTORS - DIMENSIONS };
    double exponents[VECTORS];
    HELD(world)
    w = world_create(
        scene(.number = DISKS, .density = 0.5, .aspect = 0.8, .seed = 5, .max_mode_number = 1),
        VECTORS, 1);
    const int shared[] = {world_subspace(&w, HD_MODE_T, 1, 0),
                          world_subspace(&w, HD_MODE_LP, 1, 0)};
    exponents_falling(&w, exponents);
    exponents_flat(exponents, FIRST, DIMENSIONS, 0.3);
    world_span(&w, FIRST, shared, 2, 0.1);
    world_find(&w, exponents);
    MADE(hd_hydro, hydro, &w.scene, w.steps);
    hd_hydro_measure(hydro, w.steps, hd_frame_columns(w.frame), w.q, w.p);
    assert_int_equal(world_step(&w, HD_MODE_T, 1, 0)->members, 2);
    int named = 0;
    for (int e = 0; e < hd_hydro_count(hydro); e++) {
        const hd_hydro_response *r = hd_hydro_at(hydro, e);
        if (r->col < 0) continue;
        assert_int_equal(hd_steps_of_vector(w.steps, r->col), r->step);
        check_response(&w, r);
        named++;
    }
    assert_true(named >= 8); /* four vectors at two modulations */
}

/* ---- the paper's table --------------------------------------------------------------------- */

enum { STATES = 300, FIELDS_MAX = 12, MODULATIONS = 4 };

/** C of dp = C dq. */
static const double RATIO = 0.8;

/** Of every field and modulation: mean and mean square over the states. */
typedef struct table {
    double mean[FIELDS_MAX][MODULATIONS][SUMS], square[FIELDS_MAX][MODULATIONS][SUMS];
} table;

/** Each field of T(n), then of LP(n), is one vector. */
static void write_fields(world *w, const int subspace[2])
{
    int col = 0;
    for (int s = 0; s < 2; s++)
        for (int c = 0; c < world_dimension(w, subspace[s]); c++) {
            double dq[ROWS] = {0.0};
            world_add_field(w, dq, hd_fields_subspace(w->fields, subspace[s])->column + c, 1.0);
            world_write_mode(w, col++, dq, RATIO);
        }
}

static void add_responses(table *sum, const hd_hydro *hydro, const int subspace[2], int modulations)
{
    for (int e = 0; e < hd_hydro_count(hydro); e++) {
        const hd_hydro_response *r = hd_hydro_at(hydro, e);
        double numbers[SUMS];
        if (r->step != subspace[0] && r->step != subspace[1]) continue;
        numbers_of(numbers, r);
        for (int k = 0; k < SUMS; k++) {
            sum->mean[r->col][e % modulations][k] += numbers[k] / STATES;
            sum->square[r->col][e % modulations][k] += numbers[k] * numbers[k] / STATES;
        }
    }
}

/** Averages over independent states of a periodic box at wave vector (nx, ny). */
static void average(table *sum, int nx, int ny, double *k)
{
    const int modulations = nx && ny ? 4 : 2, vectors = 3 * modulations;
    const hd_scene_def def = scene(.number = DISKS, .density = 0.5, .aspect = 0.8, .seed = 5,
                                   .max_mode_number = 1);
    HELD(world) w = world_create(def, vectors, 1);
    const int subspace[] = {world_subspace(&w, HD_MODE_T, nx, ny),
                            world_subspace(&w, HD_MODE_LP, nx, ny)};
    double exponents[FIELDS_MAX];
    *k = hd_fields_subspace(w.fields, subspace[0])->wave.number;
    exponents_flat(exponents, 0, modulations, 0.5);
    exponents_flat(exponents, modulations, 2 * modulations, 0.3);
    MADE(hd_hydro, hydro, &w.scene, w.steps);
    write_fields(&w, subspace);
    world_find(&w, exponents);
    assert_int_equal(hd_steps_step(w.steps, subspace[0])->col, 0);
    assert_int_equal(hd_steps_step(w.steps, subspace[1])->col, modulations);
    memset(sum, 0, sizeof *sum);
    for (int t = 0; t < STATES; t++, world_move(&w, 2.0)) {
        write_fields(&w, subspace);
        hd_hydro_measure(hydro, w.steps, hd_frame_columns(w.frame), w.q, w.p);
        add_responses(sum, hydro, subspace, modulations);
    }
}

/** Mean responses of field m (T, L, P in turn) at its own modulation, with alpha = <A^2> (1/2, or
 * 1/4), <p^2> = 2: |curl A| = |grad A| = k sqrt(alpha N), |p A| = sqrt(2 alpha N); the sums go over
 * sqrt(N/2), the vectors over sqrt(1 + C^2). */
static void expected(double out[SUMS], int kind, double k, double alpha)
{
    const double norm = 1.0 / sqrt(1.0 + RATIO * RATIO);
    const double of_kind[3][SUMS] = {
        {0.0, 0.0, RATIO * sqrt(2.0 * alpha), 0.0},                                       /* T */
        {sqrt(2.0 * alpha), RATIO * sqrt(2.0 * alpha), 0.0, 2.0 * k * sqrt(2.0 * alpha)}, /* L */
        {0.0, -k * sqrt(alpha), 0.0, 4.0 * RATIO * sqrt(alpha)},                          /* P */
    };
    for (int s = 0; s < SUMS; s++) out[s] = norm * of_kind[kind][s];
}

/** 5 standard errors of 384 numbers; norms fluctuate, which costs 1 / 8 of their variance, some 1 /
 * N. */
static void check_table(const table *sum, int modulations, double k)
{
    const double SIGMAS = 5.0, BIAS = 1.0 / DISKS;
    for (int field = 0; field < 3 * modulations; field++)
        for (int c = 0; c < modulations; c++) {
            double want[SUMS];
            expected(want, field / modulations, k, modulations == 4 ? 0.25 : 0.5);
            for (int s = 0; s < SUMS; s++) {
                const double mean = sum->mean[field][c][s];
                const double variance = sum->square[field][c][s] - mean * mean;
                const double own = field % modulations == c ? want[s] : 0.0;
                CHECK_CLOSE(mean, own,
                            SIGMAS * sqrt(fmax(variance, 0.0) / STATES) + BIAS * fabs(own) +
                                100.0 * DBL_EPSILON);
                if (own != 0.0) assert_true(fabs(mean) > 0.8 * fabs(own));
            }
        }
}

TEST(the_table_of_the_paper)
{
    const int nodes[][2] = {{1, 0}, {0, 1}, {1, 1}};
    static table sum;
    for (int n = 0; n < 3; n++) {
        double k;
        const int modulations = n == 2 ? 4 : 2;
        average(&sum, nodes[n][0], nodes[n][1], &k);
        check_table(&sum, modulations, k);
    }
}
