/** Angles of spaces made so that they are known. */
#include "testing.h"
#include "averages/blocks.h"
#include "base/random.h"

enum { N = 6, UNSTABLE = 2, CENTRE = 2 };

static hd_splitting *created(int vectors, int unstable, int centre)
{
    hd_splitting *s;
    CHECK_OK(hd_splitting_create(&s, vectors, unstable, centre));
    return s;
}

/** Unstable e_1, e_2 (oblique by delta); centre e_3, e_4; stable: one alpha from e_1, one beta from
 * e_3. */
static void fill(double *c, double alpha, double beta, double delta)
{
    memset(c, 0, N * N * sizeof *c);
    c[0] = 1.0;
    c[N] = -cos(delta);
    c[N + 1] = -sin(delta);
    c[2 * N + 2] = 1.0;
    c[3 * N + 3] = -1.0;
    c[4 * N] = cos(alpha);
    c[4 * N + 4] = sin(alpha);
    c[5 * N + 2] = cos(beta);
    c[5 * N + 5] = sin(beta);
}

enum { SAMPLES = 40 };

static double alpha_of(int k) { return 0.9 + 0.6 * sin(1.7 * k); }
static double beta_of(int k) { return 0.2 + 0.03 * k; }
static double delta_of(int k) { return 0.01 + 0.035 * k; }

typedef struct truth {
    double mean[3], all[3], least[3], delta,
        delta_least; /* of unstable-stable, unstable-centre, centre-stable */
    long smallest[3][HD_ANGLE_BINS], every[3][HD_ANGLE_BINS];
} truth;

static int bin_of(double angle)
{
    return angle >= PI / 2 ? HD_ANGLE_BINS - 1 : (int)(angle * 180.0 / PI);
}

static truth truth_of(void)
{
    truth t = {.least = {PI, PI, PI}, .delta_least = PI};
    for (int k = 0; k < SAMPLES; k++) {
        const double smallest[3] = {alpha_of(k), PI / 2, beta_of(k)};
        for (int pair = 0; pair < 3; pair++) {
            t.mean[pair] += smallest[pair] / SAMPLES;
            t.all[pair] += 0.5 * (smallest[pair] + PI / 2) / SAMPLES;
            t.least[pair] = fmin(t.least[pair], smallest[pair]);
            t.smallest[pair][bin_of(smallest[pair])]++;
            t.every[pair][bin_of(smallest[pair])]++;
            t.every[pair][HD_ANGLE_BINS - 1]++;
        }
        t.delta += delta_of(k) / SAMPLES;
        t.delta_least = fmin(t.delta_least, delta_of(k));
    }
    return t;
}

/** Each angle is known to rounding: some eps, over the sine of the columns' own obliqueness. */
static const double ROUNDING = 1e-13;

static void check_pair(const hd_splitting *s, const truth *t, int pair, double last)
{
    const hd_angle_of_spaces *a = &hd_splitting_read(s).angle[pair];
    CHECK_CLOSE(a->last, last, ROUNDING);
    CHECK_CLOSE(a->mean, t->mean[pair], ROUNDING);
    CHECK_CLOSE(a->mean_of_all, t->all[pair], ROUNDING);
    CHECK_CLOSE(a->least, t->least[pair], ROUNDING);
    assert_memory_equal(a->smallest, t->smallest[pair], sizeof a->smallest);
    assert_memory_equal(a->all, t->every[pair], sizeof a->all);
}

static void check_errors(const hd_splitting *s)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 2, 0.0));
    for (int k = 0; k < SAMPLES; k++) {
        double sample[2] = {alpha_of(k), beta_of(k)};
        hd_blocks_add(&blocks, sample, 1.0);
    }
    const int pair[] = {HD_UNSTABLE_STABLE, HD_CENTRE_STABLE};
    for (int k = 0; k < 2; k++)
        CHECK_CLOSE(hd_splitting_read(s).angle[(hd_pair_of_spaces)pair[k]].std_error,
                    hd_blocks_error(&blocks, &(hd_part){k, 1.0}, 1), ROUNDING);
    hd_blocks_clear(&blocks);
}

static void add_all(hd_splitting *s)
{
    double c[N * N];
    for (int k = 0; k < SAMPLES; k++) {
        fill(c, alpha_of(k), beta_of(k), delta_of(k));
        CHECK_OK(hd_splitting_add(s, c));
        if (k < 15) assert_true(hd_splitting_read(s).angle[HD_UNSTABLE_STABLE].std_error < 0);
    }
}

TEST(known_angles_are_found)
{
    const truth t = truth_of();
    OWNED(hd_splitting) *s = created(N, UNSTABLE, CENTRE);
    const double last[3] = {alpha_of(SAMPLES - 1), PI / 2, beta_of(SAMPLES - 1)};
    assert_true(hd_splitting_read(s).has_spaces);
    for (int again = 0; again < 2; again++) { /* as if it were new */
        add_all(s);
        assert_int_equal(hd_splitting_read(s).samples, SAMPLES);
        for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++) check_pair(s, &t, pair, last[pair]);
        check_errors(s);
        for (int col = 1; col + 1 < N; col++)
            CHECK_CLOSE(hd_splitting_read(s).neighbours[col], PI / 2, ROUNDING);
        CHECK_CLOSE(hd_splitting_read(s).neighbours[0], t.delta, ROUNDING);
        CHECK_CLOSE(hd_splitting_read(s).neighbours_least[0], t.delta_least, ROUNDING);
        hd_splitting_clear(s);
        assert_int_equal(hd_splitting_read(s).samples, 0);
    }
}

/** Neighbours of length 1 a tiny angle apart: their cosine would not know it. */
TEST(small_angles_keep_their_digits)
{
    double c[4] = {1.0, 0.0, cos(1e-9), sin(1e-9)};
    OWNED(hd_splitting) *s = created(2, 2, 0);
    CHECK_OK(hd_splitting_add(s, c));
    CHECK_CLOSE(hd_splitting_read(s).neighbours[0], 1e-9, 1e-15);
    assert_false(hd_splitting_read(s).has_spaces);
}

TEST(dependent_vectors_are_refused)
{
    double c[N * N];
    OWNED(hd_splitting) *s = created(N, UNSTABLE, CENTRE);
    fill(c, 1.0, 1.0, 0.0);
    assert_int_equal(hd_splitting_add(s, c), HD_ILL_CONDITIONED);
}
