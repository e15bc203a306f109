/** Potentials, and who is near whom. */
#include "soft.h"

/** By the other program's formulas, from far inside to the cut. */
TEST(potentials_are_those_of_another_program)
{
    for (int k = 0; k < HD_POTENTIALS; k++)
        for (double r = 0.75; r < hd_potentials[k].cut; r += 0.0037) {
            long double v[3];
            const hd_pull pull = hd_potentials[k].at(r * r);
            soft_twin_potential(v, k, r);
            const double scale = 1e-13 * (1.0 + fabs((double)v[0]) + fabs((double)v[2]));
            CHECK_CLOSE(pull.v, (double)v[0], scale);
            CHECK_CLOSE(pull.b * r, (double)v[1], scale);
            CHECK_CLOSE(pull.b + pull.c * r * r, (double)v[2], scale);
        }
}

/** As many derivatives as a row says have no jump at the cut, and the next one has: that of wca is
 * 57. */
TEST(potentials_are_as_smooth_as_their_rows_say)
{
    static const double jump[HD_POTENTIALS] = {0.0, 57.146, 0.0};
    for (int k = 0; k < HD_POTENTIALS; k++) {
        const double r = hd_potentials[k].cut * (1.0 - 1e-7);
        const hd_pull pull = hd_potentials[k].at(r * r);
        CHECK_CLOSE(pull.v, 0.0, 1e-10);
        CHECK_CLOSE(pull.b * r, 0.0, 1e-5);
        CHECK_CLOSE(pull.b + pull.c * r * r, jump[k], 1e-3);
        assert_int_equal(hd_potentials[k].smooth, k == HD_WCA ? 1 : k == HD_POWER ? 3 : 2);
    }
    const hd_pull inside = hd_potentials[HD_LENNARD_JONES].at(4.0 * (1 - 1e-9)),
                  outside = hd_potentials[HD_LENNARD_JONES].at(4.0 * (1 + 1e-9));
    CHECK_CLOSE(inside.c, outside.c, 1e-6);
    CHECK_CLOSE(inside.b, outside.b, 1e-6);
}

/** Jump of derivative s + 1 at r, by differences of the one before it: s - 1 of them of V''. */
static double jump_at(const hd_potential *of, double r)
{
    const double h = 1e-4; /* errors of h^2 and of rounding / h^(s - 1) are below 1e-3 */
    double side[2];
    for (int k = 0; k < 2; k++) {
        double d[3];
        for (int n = 0; n < 3; n++) {
            const double x = r + (k == 0 ? -1.0 : 1.0) * h * (n + 1e-6), u = x * x;
            const hd_pull pull = u < of->cut * of->cut ? of->at(u) : (hd_pull){0};
            d[n] = pull.b + pull.c * u;
        }
        const double sign = k == 0 ? -1.0 : 1.0;
        side[k] = of->smooth == 1   ? d[0]
                  : of->smooth == 2 ? sign * (4.0 * d[1] - 3.0 * d[0] - d[2]) / (2.0 * h)
                                    : (d[2] - 2.0 * d[1] + d[0]) / (h * h);
    }
    return side[1] - side[0];
}

/** lennard_jones jumps where its cut begins, too. */
TEST(potentials_jump_as_their_rows_say)
{
    for (int k = 0; k < HD_POTENTIALS; k++) {
        const hd_potential *of = &hd_potentials[k];
        const double begin = k == HD_LENNARD_JONES ? jump_at(of, 2.0) : 0.0;
        CHECK_CLOSE(hypot(jump_at(of, of->cut), begin) / of->jump, 1.0, 0.01);
    }
}

TEST(steps_are_symmetric_and_whole)
{
    for (int k = 0; k < HD_INTEGRATORS; k++) {
        const hd_integrator *by = &hd_integrators[k];
        double drifts = 0.0, kicks = 0.0;
        for (int n = 0; n < by->kicks; n++) {
            drifts += by->drift[n];
            kicks += by->kick[n];
            CHECK_CLOSE(by->at[n], drifts, 4e-16);
            CHECK_CLOSE(by->kick[n], by->kick[by->kicks - 1 - n], 0.0);
            CHECK_CLOSE(by->drift[n], by->drift[by->kicks - n], 1e-16);
        }
        CHECK_CLOSE(drifts + by->drift[by->kicks], 1.0, 4e-16);
        CHECK_CLOSE(kicks, 1.0, 4e-16);
    }
}

/* ---- neighbours ---------------------------------------------------------------------------- */

static double distance(const hd_neighbours *n, const double *q, int i, int j)
{
    double sum = 0.0;
    for (int d = 0; d < n->dimension; d++)
        sum = hypot(sum, remainder(q[n->dimension * i + d] - q[n->dimension * j + d], n->box[d]));
    return sum;
}

static bool is_listed(const hd_neighbours *n, int i, int j)
{
    for (size_t k = n->first[i]; k < n->first[i + 1]; k++)
        if (n->partner[k] == j) return true;
    return false;
}

/** Each pair within the cut is there; each list is in order. */
static void check_list(const hd_neighbours *n, const double *q, double cut)
{
    for (int i = 0; i < n->count; i++) {
        for (size_t k = n->first[i]; k < n->first[i + 1]; k++)
            assert_true(n->partner[k] > (k > n->first[i] ? n->partner[k - 1] : i));
        for (int j = i + 1; j < n->count; j++)
            if (distance(n, q, i, j) < cut) assert_true(is_listed(n, i, j));
    }
}

/** Boxes of any form, with one, two or more cells along an edge, or far more room than particles;
 * positions walk, and are anywhere again now and then. */
TEST(the_list_has_all_pairs)
{
    static const double edges[][3] = {{3, 3, 3}, {40, 2.3, 2.6}, {4.4, 9, 6.1}, {300, 200, 500}};
    enum { COUNT = 60, LOOKS = 300 };
    hd_random random = hd_random_seeded(3, 0);
    for (int box = 0; box < 4; box++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            const double *e = edges[box], cut = 1.12;
            hd_scene_def def = soft_box(dimension, HD_WCA, HD_VERLET, 0.0, COUNT, 1.0);
            double q[3 * COUNT];
            hd_neighbours n;
            def.density = COUNT / (e[0] * e[1] * (dimension == 3 ? e[2] : 1.0));
            def.aspect = e[1] / e[0];
            if (dimension == 3) def.aspect_z = e[2] / e[0];
            CHECK_OK(hd_neighbours_create(&n, &def, cut));
            for (int look = 0; look < LOOKS; look++) {
                for (int k = 0; k < COUNT * dimension; k++) {
                    const double edge = n.box[k % dimension], step = hd_random_symmetric(&random);
                    q[k] = look % 100 == 0 ? edge * fabs(step) : q[k] + 0.03 * step;
                    q[k] -= edge * floor(q[k] / edge);
                }
                CHECK_OK(hd_neighbours_follow(&n, q));
                check_list(&n, q, cut);
            }
            q[5] = NAN;
            assert_int_equal(hd_neighbours_follow(&n, q), HD_NOT_FINITE);
            hd_neighbours_clear(&n);
        }
}
