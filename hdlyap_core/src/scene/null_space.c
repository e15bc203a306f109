/** Scene -> conserved quantities, and the null directions that follow from them [T9]. What the
 * start of the trajectory uses has only + - * / sqrt. */
#include "scene/null_space.h"

#include <math.h>
#include <string.h>

#include "base/random.h"
#include "scene/container.h"
#include "scene/dynamics.h"
#include "scene/ends.h"

int hd_null_axes(const hd_scene_def *def, int *axis)
{
    const int dimension = hd_scene_dimension(def);
    int count = 0;
    for (int d = 0; d < dimension; d++)
        if (hd_scene_boundary(def, d) == HD_PERIODIC ||
            (d == HD_NULL_X && hd_container_of(def)->rotates))
            axis[count++] = d;
    if (hd_dynamics_of(def)->scale_invariant) axis[count++] = dimension;
    return count;
}

bool hd_null_is_damped(const hd_scene_def *def, int axis)
{
    return axis < hd_scene_dimension(def) && hd_ends_drag(def, axis);
}

int hd_null_count(const hd_scene_def *def)
{
    int axis[HD_DIMENSION_MAX + 1], damped = 0;
    const int axes = hd_null_axes(def, axis);
    for (int k = 0; k < axes; k++) damped += hd_null_is_damped(def, axis[k]);
    return 2 * axes - damped;
}

hd_null_space hd_null_space_of(const hd_scene_def *def)
{
    double box[HD_DIMENSION_MAX];
    hd_scene_box(def, box);
    hd_null_space null = {.dimension = hd_scene_dimension(def),
                          .rotates = hd_container_of(def)->rotates,
                          .centre = 0.5 * box[0],
                          .kinds = hd_kinds_of(def)};
    null.count = hd_null_axes(def, null.axis);
    return null;
}

int hd_null_space_fill(const hd_scene_def *def, const double *q, const double *p, double *column)
{
    const hd_null_space null = hd_null_space_of(def);
    const int of_one = hd_scene_coordinates(def);
    const size_t rows = 2 * (size_t)(of_one * def->number);
    int count = 0;
    for (int k = 0; k < 2 * null.count; k++) {
        const bool rotation = null.rotates && null.axis[k / 2] == HD_NULL_X;
        if (k % 2 == 1 && (rotation || hd_null_is_damped(def, null.axis[k / 2]))) continue;
        memset(column, 0, rows * sizeof *column);
        for (int j = 0; j < of_one * def->number; j++) {
            const int d = j % of_one;
            const double *at = q + (j - d), *moving = p + (j - d);
            double *entry = column + 2 * of_one * (j / of_one) + d;
            entry[of_one * (k % 2)] = hd_null_entry(&null, null.axis[k / 2], d, at, moving,
                                                    hd_kinds_root(&null.kinds, j / of_one));
            if (rotation) entry[of_one] = d == 0 ? -moving[1] : moving[0];
        }
        column += rows;
        count++;
    }
    return count;
}

/* ---- momenta ------------------------------------------------------------------------------- */

static void still_rotation(const hd_scene_def *def, const double *q, double *p)
{
    const hd_null_space null = hd_null_space_of(def);
    double angular = 0.0, inertia = 0.0;
    for (int k = 0; k < 2 * def->number; k += 2) {
        const double root = hd_kinds_root(&null.kinds, k / 2), x = root * (q[k] - null.centre),
                     y = root * (q[k + 1] - null.centre);
        angular += x * p[k + 1] - y * p[k];
        inertia += x * x + y * y;
    }
    const double rate = inertia > 0 ? angular / inertia : 0.0;
    for (int k = 0; k < 2 * def->number; k += 2) {
        const double by = rate * hd_kinds_root(&null.kinds, k / 2);
        p[k] += by * (q[k + 1] - null.centre);
        p[k + 1] -= by * (q[k] - null.centre);
    }
}

void hd_null_space_still(const hd_scene_def *def, const double *q, double *p)
{
    const int dimension = hd_scene_dimension(def), of_one = hd_scene_coordinates(def);
    const hd_kinds kinds = hd_kinds_of(def);
    for (int d = 0; d < dimension; d++) {
        double sum = 0.0, mass = 0.0;
        if (hd_scene_boundary(def, d) != HD_PERIODIC) continue;
        for (int k = 0; k < kinds.count; k++) mass += kinds.kind[k].number * kinds.kind[k].mass;
        for (int i = 0; i < def->number; i++) sum += hd_kinds_root(&kinds, i) * p[of_one * i + d];
        for (int i = 0; i < def->number; i++)
            p[of_one * i + d] -= hd_kinds_root(&kinds, i) * (sum / mass);
    }
    if (hd_container_of(def)->rotates) still_rotation(def, q, p);
}

void hd_null_space_momenta(const hd_scene_def *def, const double *q, double *p)
{
    hd_random random = hd_random_seeded(def->seed, 0);
    const int all = hd_scene_coordinates(def) * def->number;
    double square = 0.0;
    for (int k = 0; k < all; k++) p[k] = hd_random_symmetric(&random);
    hd_null_space_still(def, q, p);
    for (int k = 0; k < all; k++) square += p[k] * p[k];
    const double scale = sqrt(2.0 * def->number / square);
    for (int k = 0; k < all; k++) p[k] *= scale;
}

double hd_null_conserved(const hd_scene_def *def, int d)
{
    if (hd_container_of(def)->rotates) return 0.5;
    return hd_scene_boundary(def, d) == HD_PERIODIC && !hd_ends_drag(def, d) ? 1.0 : 0.0;
}
