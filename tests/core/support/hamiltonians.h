/** Rows that hdlyap/hamiltonian.h makes: the chain of the examples, a ring of rotors, and the two
 * coordinates of Henon and Heiles; and scenes of them. */
#ifndef HD_HAMILTONIANS_H
#define HD_HAMILTONIANS_H

#include "rotors.h"
#include "runs.h"

#define main chain_main
#include "../../../hdlyap_core/examples/chain.c"
#undef main

/* ---- Henon and Heiles: V = (x^2 + y^2) / 2 + x^2 y - y^3 / 3 -------------------------------- */

static void hh_start(const hd_scene_def *scene, double *q, double *p)
{
    (void)scene;
    q[1] = -0.15; /* E = 0.1602, most of which is chaotic */
    p[0] = sqrt(2.0 * (0.1602 - 0.5 * q[1] * q[1] + q[1] * q[1] * q[1] / 3.0));
}

static double hh_force(const hd_scene_def *scene, const double *q, double *f, double *kept)
{
    const double x = q[0], y = q[1];
    (void)scene;
    f[0] -= x + 2.0 * x * y;
    f[1] -= y + x * x - y * y;
    kept[0] = x;
    kept[1] = y;
    return 0.5 * (x * x + y * y) + x * x * y - y * y * y / 3.0;
}

static void hh_bend(const double *kept, double time, const double *restrict dq, double *restrict dp,
                    int n, int width)
{
    const double x = 2.0 * time * kept[0], y = 2.0 * time * kept[1];
    (void)n;
    for (int k = 0; k < width; k++) {
        dp[k] -= (time + y) * dq[k] + x * dq[width + k];
        dp[width + k] -= x * dq[k] + (time - y) * dq[width + k];
    }
}

static double hh_growth(const hd_scene_def *scene) { return (void)scene, 0.1; }
static const hd_parameter hh_own[] = {HD_OWN_TIME_STEP(0), HD_OWN_INTEGRATOR(1)};
HD_HAMILTONIAN(of_henon_heiles, hh_bend,
               (.kept = 2, .start = hh_start, .force = hh_force, .growth = hh_growth),
               .particles = "stars", .coordinates = 2, .parameter = hh_own, .parameters = 2);

/* ---- scenes -------------------------------------------------------------------------------- */

static inline hd_scene_def of_row(const hd_dynamics *row, int number)
{
    return scene_from(hd_scene_def_of(row), .number = number, .exponents = HD_EXPONENTS_ALL,
                      .equilibration = 20.0, .duration = 500.0, .threads = 1);
}

static inline hd_scene_def chain_scene(int number, int integrator, double step)
{
    return scene_from(of_row(&of_chain, number), .own[BETA].real = 10.0, .own[ENERGY].real = 10.0,
                      .own[STEP].real = step, .own[INTEGRATOR].whole = integrator);
}

enum { VERLET, PEFRL, OF_CHAIN, OF_ROTORS, OF_STARS, KINDS };

/** Chains whose kept numbers fill a part of an entry and several ones, and all else. */
static inline hd_scene_def kind(int k)
{
    switch (k) {
    case VERLET: return chain_scene(7, 0, 0.005);
    case PEFRL: return chain_scene(60, 1, 0.02);
    case OF_CHAIN: return chain_scene(27, 1, 0.0);
    case OF_ROTORS: return of_row(&of_rotors, 4);
    default: return of_row(&of_henon_heiles, 1);
    }
}

static inline void *state_of(const hd_scene_def *scene)
{
    void *state;
    CHECK_OK(scene->dynamics->create(&state, scene));
    return state;
}

#endif
