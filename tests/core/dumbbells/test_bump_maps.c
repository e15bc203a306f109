/** Tangent maps of dumbbells: against shadow trajectories, and exact invariants. */
#include "create_from.h"
#include "dumbbell.h"
#include "base/random.h"
#include "dynamics/dynamics.h"

enum { WIDTH = 4, WIDE = 64, COUNT = 5, ROWS_OF_ALL = DUMBBELL_ROWS * COUNT };

static hd_scene_def fluid(int walls, double inertia)
{
    return dumbbells_in_box(COUNT, 4.5, 3.6, 0.4, inertia, walls, 5);
}

static hd_trajectory *from(const hd_scene_def *def, const molecules *s)
{
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create_from(&tr, def, s->q, s->p));
    return tr;
}

static molecules later(const hd_scene_def *def, const molecules *s, double time, hd_record *log)
{
    OWNED(hd_trajectory) *tr = from(def, s);
    CHECK_OK(hd_trajectory_extend(tr, log, time));
    return molecules_now(tr);
}

static molecules equilibrated(const hd_scene_def *def)
{
    MADE(hd_trajectory, tr, def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 10.0));
    return molecules_now(tr);
}

/** Carries block[particle][6][width] through all of the record. */
static void carry(double *block, const hd_scene_def *def, const hd_record *log, int width)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    void *maps;
    CHECK_OK(of->maps_create(&maps, def));
    CHECK_OK(of->maps_fill(maps, log, 0.0, hd_record_duration(log)));
    of->carry(maps, block, width);
    of->maps_free(maps);
}

static int row_of(int k) { return DUMBBELL_ROWS * (k / D) + k % D; }

static void fill_randomly(double *v, int count)
{
    hd_random random = hd_random_seeded(11, 1);
    for (int k = 0; k < count; k++) v[k] = hd_random_symmetric(&random);
}

/** Difference of two angles or places, whatever their turns. */
static double apart(const hd_scene_def *def, double a, double b, int d)
{
    double box[2];
    hd_scene_box(def, box);
    return remainder(a - b, d < 2 ? box[d] : 2.0 * PI * root_of(def));
}

/** Relative deviation of central differences of shadows from what is carried. */
static double shadow_error(const hd_scene_def *def, const molecules *s, double time, double epsilon,
                           size_t *events)
{
    double v[ROWS_OF_ALL], block[ROWS_OF_ALL], off = 0.0, size = 0.0;
    OWNED(hd_record) *log = new_dumbbell_log(def);
    molecules shadow[2] = {*s, *s};
    (void)later(def, s, time, log);
    *events = hd_record_count(log);
    fill_randomly(v, ROWS_OF_ALL);
    memcpy(block, v, sizeof v);
    carry(block, def, log, 1);
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < D * COUNT; k++) {
            shadow[side].q[k] += (1 - 2 * side) * epsilon * v[row_of(k)];
            shadow[side].p[k] += (1 - 2 * side) * epsilon * v[row_of(k) + D];
        }
        shadow[side] = later(def, &shadow[side], time, NULL);
    }
    for (int k = 0; k < D * COUNT; k++) {
        const double dq = apart(def, shadow[0].q[k], shadow[1].q[k], k % D) / (2.0 * epsilon);
        const double dp = (shadow[0].p[k] - shadow[1].p[k]) / (2.0 * epsilon);
        off = hypot(off, hypot(dq - block[row_of(k)], dp - block[row_of(k) + D]));
        size = hypot(size, hypot(dq, dp));
    }
    return off / size;
}

TEST(shadows_follow_what_is_carried)
{
    for (int walls = 0; walls < 4; walls++)
        for (int points = 0; points < 2; points++) {
            const hd_scene_def def = fluid(walls, points ? -1.0 : 0.0);
            const molecules s = equilibrated(&def);
            size_t events;
            const double coarse = shadow_error(&def, &s, 1.2, 4e-6, &events),
                         fine = shadow_error(&def, &s, 1.2, 1e-6, &events);
            assert_true(events > 2);
            CHECK_WITHIN(fine, 0.0, 1e-5);
            CHECK_WITHIN(fine, 0.0, fmax(0.25 * coarse, 2e-9)); /* second order, or rounding */
        }
}

/** dp_a.dq_b - dq_a.dp_b of columns a and b. */
static double product(const double *block, int a, int b, int width)
{
    double sum = 0.0;
    for (int k = 0; k < D * COUNT; k++) {
        const double *q = block + row_of(k) * width, *p = q + D * width;
        sum += p[a] * q[b] - q[a] * p[b];
    }
    return sum;
}

TEST(maps_are_symplectic)
{
    for (int walls = 0; walls < 4; walls++) {
        const hd_scene_def def = fluid(walls, 0.0);
        const molecules s = equilibrated(&def);
        OWNED(hd_record) *log = new_dumbbell_log(&def);
        double before[ROWS_OF_ALL * WIDTH], after[ROWS_OF_ALL * WIDTH], largest = 0.0;
        (void)later(&def, &s, 1.0, log);
        fill_randomly(before, ROWS_OF_ALL * WIDTH);
        memcpy(after, before, sizeof before);
        carry(after, &def, log, WIDTH);
        for (int k = 0; k < ROWS_OF_ALL * WIDTH; k++) largest = fmax(largest, fabs(after[k]));
        for (int a = 0; a < WIDTH; a++)
            for (int b = 0; b < a; b++)
                CHECK_CLOSE(product(after, a, b, WIDTH), product(before, a, b, WIDTH),
                            100.0 * ROWS_OF_ALL * DBL_EPSILON * largest * largest);
    }
}

TEST(every_width_carries_alike)
{
    const hd_scene_def def = fluid(2, 0.0);
    const molecules s = equilibrated(&def);
    OWNED(hd_record) *log = new_dumbbell_log(&def);
    static double one[ROWS_OF_ALL], many[ROWS_OF_ALL * WIDE];
    (void)later(&def, &s, 1.0, log);
    fill_randomly(one, ROWS_OF_ALL);
    for (int width = 1; width <= WIDE; width *= 2) {
        double carried[ROWS_OF_ALL];
        for (int k = 0; k < ROWS_OF_ALL; k++)
            for (int col = 0; col < width; col++) many[k * width + col] = one[k] * (1.0 + col);
        memcpy(carried, one, sizeof one);
        carry(carried, &def, log, 1);
        carry(many, &def, log, width);
        for (int k = 0; k < ROWS_OF_ALL; k++)
            CHECK_CLOSE(many[k * width + width - 1], carried[k] * width,
                        1e-9 * width * (1.0 + fabs(carried[k])));
    }
}

/** The exact null vectors at the end are those of the start, carried: dp of a direction moves its
 * dq, and dp = p flies along the flow. */
TEST(null_vectors_are_carried_into_each_other)
{
    static const int zeros[] = {6, 4, 4, 2};
    for (int walls = 0; walls < 4; walls++) {
        const hd_scene_def def = fluid(walls, 0.0);
        const hd_dynamics *of = hd_dynamics_of(&def);
        const molecules s = equilibrated(&def);
        OWNED(hd_record) *log = new_dumbbell_log(&def);
        double at[6 * ROWS_OF_ALL], then[6 * ROWS_OF_ALL];
        const molecules end = later(&def, &s, 1.0, log);
        const int count = of->null_vectors(&def, s.q, s.p, at);
        assert_int_equal(count, zeros[walls]);
        assert_int_equal(of->zero_exponents(&def), count);
        assert_int_equal(of->null_vectors(&def, end.q, end.p, then), count);
        for (int k = 0; k < count; k++) carry(at + k * ROWS_OF_ALL, &def, log, 1);
        for (int k = 0; k < count; k++)
            for (int row = 0; row < ROWS_OF_ALL; row++) {
                const double flown = k % 2 ? then[(k - 1) * ROWS_OF_ALL + row] : 0.0;
                CHECK_CLOSE(at[k * ROWS_OF_ALL + row], then[k * ROWS_OF_ALL + row] + flown, 1e-9);
            }
    }
}

/** Back with all momenta turned round, as long as rounding has not grown. */
TEST(time_can_be_reversed)
{
    for (int walls = 0; walls < 4; walls++) {
        const hd_scene_def def = fluid(walls, 0.0);
        const molecules s = equilibrated(&def);
        molecules there = later(&def, &s, 1.5, NULL);
        for (int k = 0; k < D * COUNT; k++) there.p[k] = -there.p[k];
        const molecules back = later(&def, &there, 1.5, NULL);
        for (int k = 0; k < D * COUNT; k++) {
            CHECK_CLOSE(apart(&def, back.q[k], s.q[k], k % D), 0.0, 1e-7);
            CHECK_CLOSE(back.p[k], -s.p[k], 1e-7);
        }
    }
}
