#include "places.h"

const place places[PLACES] = {{HD_MODE_T, 1, 0, 58, 2, 0.20}, {HD_MODE_LP, 1, 0, 52, 4, 0.30},
                              {HD_MODE_T, 0, 1, 56, 2, 0.25}, {HD_MODE_LP, 0, 1, 48, 4, 0.36},
                              {HD_MODE_T, 1, 1, 44, 4, 0.45}, {HD_MODE_LP, 1, 1, 36, 8, 0.55}};
hd_scene_def scene_of_places(double aspect)
{
    return scene(.number = DISKS, .density = 0.5, .aspect = aspect, .seed = 4,
                 .max_mode_number = 1);
}

int subspace_of(const world *w, int k)
{
    return world_subspace(w, places[k].kind, places[k].nx, places[k].ny);
}

const hd_step *step_of(const world *w, int k)
{
    return world_step(w, places[k].kind, places[k].nx, places[k].ny);
}

world steps_in_place(double *exponents, double noise)
{
    world w = world_create(scene_of_places(0.8), VECTORS, 1);
    exponents_falling(&w, exponents);
    for (int k = 0; k < PLACES; k++) {
        const int s = subspace_of(&w, k);
        world_span(&w, places[k].col, &s, 1, noise);
        exponents_flat(exponents, places[k].col, places[k].count, places[k].exponent);
    }
    return w;
}

void check_step(const hd_step *step, int col, int count, int members, double exponent)
{
    assert_true(step->resolved);
    assert_int_equal(step->col, col);
    assert_int_equal(step->count, count);
    assert_int_equal(step->members, members);
    CHECK_CLOSE(step->exponent, exponent, ROUNDING);
}

void check_unresolved(const hd_step *step)
{
    assert_false(step->resolved);
    assert_int_equal(step->col, -1);
    assert_int_equal(step->count, 0);
    assert_int_equal(step->set, -1);
    CHECK_CLOSE(step->multiplicity, 0.0, 0.0);
    CHECK_CLOSE(step->exponent, 0.0, 0.0);
}
