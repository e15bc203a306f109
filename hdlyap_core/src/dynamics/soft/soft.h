/** Soft particles in a periodic box, moved in time steps. */
#ifndef HD_SOFT_H
#define HD_SOFT_H

#include "dynamics/create_from.h"
#include "dynamics/dynamics.h"
#include "dynamics/soft/integrator.h"
#include "dynamics/soft/neighbours.h"
#include "dynamics/soft/potential.h"

/** Parameters that only soft particles have. */
enum { HD_SOFT_POTENTIAL, HD_SOFT_ENERGY, HD_SOFT_TIME_STEP, HD_SOFT_INTEGRATOR, HD_SOFT_OWN };
extern const hd_parameter hd_soft_own[HD_SOFT_OWN];

typedef struct soft {
    const hd_potential *potential;
    const hd_integrator *integrator;
    int count, dimension;
    double step; /**< [time units] */
    double now;
    uint64_t steps;   /**< time steps done so far */
    double energy;    /**< energy at the start */
    double error;     /**< relative error of the energy, see look */
    double *q, *p;    /**< [particles][dimension] after the last time step, q in the box */
    bool sums;        /**< true if the scene asks for gas, so that integrals are taken */
    hd_totals totals; /**< the integrals; their time follows from `steps` */
    hd_neighbours near;
} soft;

const hd_potential *hd_soft_potential(const hd_scene_def *scene);
const hd_integrator *hd_soft_integrator(const hd_scene_def *scene);
/** The number of the integrator: that of the scene, or of the one that auto stands for. */
double hd_soft_integrator_chosen(const hd_scene_def *scene);
/** The length of a time step: that of the scene, or the one that is chosen [time units]. */
double hd_soft_time_step(const hd_scene_def *scene);
/** See hd_dynamics.energy_asked. */
double hd_soft_energy_asked(const hd_scene_def *scene);
/** Usual speed of a particle. */
double hd_soft_speed(const hd_scene_def *scene);
/** Collisions per time unit, of the order of the largest exponent: to a factor of two at densities
 * of 0.1 to 0.9. */
double hd_soft_rate(const hd_scene_def *scene);

/* See hd_dynamics. */
double hd_soft_split(const hd_scene_def *scene);
double hd_soft_entries(const hd_scene_def *scene);
double hd_soft_crossing(const hd_scene_def *scene);

#endif
