/** Covariant vectors of all 4N on the way back through triangles of half of them: those of the way
 * back through triangles of all. */
#include "conjugates.h"
#include "covariant/backward.h"
#include "covariant/coupling.h"
#include "covariant/backward_pair.h"
#include "triangles.h"

OWNABLE(hd_coupling)
OWNABLE(hd_backward_pair)

enum { DISKS = 8, ALL = 4 * DISKS, HALVES = 2 * DISKS, WARMUP = 200, COUNT = 800, LOOK = 40 };

/** Of each interval, of both. */
typedef struct history {
    double *factor[2][COUNT], *coupling[COUNT];
} history;

static history *passed(const hd_scene_def *scene)
{
    history *h = calloc(1, sizeof *h);
    HELD(conjugates) x = conjugates_of(*scene);
    MADE(hd_coupling, coupling, PARTICLES(DISKS), 1);
    for (int k = -WARMUP; k < COUNT; k++) {
        conjugates_interval(&x, 0.25);
        if (k < 0) continue;
        CHECK_OK(hd_coupling_measure(coupling, x.frame[HALF], hd_ortho_factor(x.ortho[HALF]), x.log,
                                     0.0, x.log->duration));
        h->factor[HALF][k] = triangle_copy(hd_ortho_factor(x.ortho[HALF]), HALVES);
        h->factor[WHOLE][k] = triangle_copy(hd_ortho_factor(x.ortho[WHOLE]), ALL);
        h->coupling[k] = triangle_copy(hd_coupling_read(coupling), HALVES);
    }
    return h;
}

static void freed(history *h)
{
    for (int k = 0; k < COUNT; k++) {
        free(h->factor[HALF][k]);
        free(h->factor[WHOLE][k]);
        free(h->coupling[k]);
    }
    free(h);
}

static hd_backward_pair *begun(bool conjugate)
{
    hd_backward_pair *s;
    CHECK_OK(hd_backward_pair_create(&s, ALL, conjugate));
    hd_backward_pair_begin(s, 9, 0);
    return s;
}

static void back(hd_backward_pair *s, const history *h, int from, int to, int which)
{
    for (int k = from - 1; k >= to; k--)
        CHECK_OK(hd_backward_pair_step(s, h->factor[which][k],
                                       which == HALF ? h->coupling[k] : NULL, true));
}

/** Sine between columns of the same index. */
static double apart(const double *one, const double *other, int col)
{
    return hd_vectors_apart(one + col * ALL, other + col * ALL, col + 1);
}

/** Both ways have come as near to the vectors as their starts have to each other, and each start
 * was of the order of 1 away; what the frames differ by is eps condition. */
static int check_vectors(hd_backward_pair *half, hd_backward_pair *whole)
{
    const double *one[2], *other[2];
    int good = 0;
    CHECK_OK(hd_backward_pair_meet(half, one));
    CHECK_OK(hd_backward_pair_meet(whole, other));
    for (int col = 0; col < ALL; col++) {
        const double met = apart(one[0], one[1], col) + apart(other[0], other[1], col);
        if (met > 1e-3) continue; /* of nearly equal exponents */
        const double off = apart(one[0], other[0], col);
        assert_true(off <= 1e3 * met + 1e-8);
        good += off < 1e-6;
    }
    return good;
}

TEST(vectors_are_those_of_all_triangles)
{
    const hd_boundary boundary[][2] = {{P, P}, {P, R}, {R, R}};
    for (int b = 0; b < 3; b++) {
        const hd_scene_def scene = scene_of(DISKS, 0.5, 0.9, boundary[b][0], boundary[b][1], 4);
        const double *c, *same;
        history *h = passed(&scene);
        OWNED(hd_backward_pair) *half = begun(true), *whole = begun(false);
        back(half, h, COUNT, LOOK, HALF);
        back(whole, h, COUNT, LOOK, WHOLE);
        const int good = check_vectors(half, whole), zero = hd_scene_zero_exponents(&scene);
        assert_true(good >= ALL - zero - 8);
        (void)hd_backward_pair_growth(half);
        (void)hd_backward_pair_growth(whole);
        back(half, h, LOOK, 0, HALF);
        back(whole, h, LOOK, 0, WHOLE);
        CHECK_OK(hd_backward_pair_look(half, &c));
        CHECK_OK(hd_backward_pair_look(whole, &same));
        double grown[ALL];
        memcpy(grown, hd_backward_pair_growth(half), sizeof grown);
        const double *want = hd_backward_pair_growth(whole);
        int agree = 0;
        for (int col = 0; col < ALL; col++)
            agree += fabs(grown[col] - want[col]) < 1e-6 && apart(c, same, col) < 1e-6;
        assert_true(agree >= good - 2);
        freed(h);
    }
}

/** C is symplectic in the coordinates (Q, J Q): each vector has a product with its conjugate alone.
 * Its columns are of length 1, and it is a triangle. */
TEST(vectors_have_products_with_their_conjugates_alone)
{
    const hd_scene_def scene = scene_of(DISKS, 0.5, 0.9, P, P, 4);
    history *h = passed(&scene);
    OWNED(hd_backward_pair) *s = begun(true);
    const double *both[2];
    back(s, h, COUNT, COUNT - 20, HALF);
    CHECK_OK(hd_backward_pair_meet(s, both));
    for (int which = 0; which < 2; which++)
        for (int a = 0; a < ALL; a++) {
            const double *x = both[which] + a * ALL;
            double length = 0.0;
            for (int row = 0; row < ALL; row++) length += x[row] * x[row];
            CHECK_CLOSE(length, 1.0, 64 * DBL_EPSILON);
            for (int row = a + 1; row < ALL; row++) assert_true(x[row] == 0.0);
            for (int b = 0; b < ALL; b++) {
                const double *y = both[which] + b * ALL;
                double product = 0.0;
                for (int row = 0; row < HALVES; row++)
                    product += x[row] * y[ALL - 1 - row] - x[ALL - 1 - row] * y[row];
                if (a + b == ALL - 1)
                    assert_true(fabs(product) > 1e-6);
                else
                    CHECK_CLOSE(product, 0.0, 1e-12);
            }
        }
    freed(h);
}
