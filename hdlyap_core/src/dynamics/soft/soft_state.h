/** Soft particles in a periodic box, moved in steps. */
#ifndef HD_SOFT_STATE_H
#define HD_SOFT_STATE_H

#include "dynamics/dynamics.h"
#include "dynamics/soft/integrator.h"
#include "dynamics/soft/neighbours.h"
#include "dynamics/soft/potential.h"

/** Parameters of their own. */
enum { HD_SOFT_POTENTIAL, HD_SOFT_ENERGY, HD_SOFT_TIME_STEP, HD_SOFT_INTEGRATOR, HD_SOFT_OWN };

/** Part of the energy whose loss makes the rest of no use. */
#define HD_SOFT_LOST 0.5

typedef struct soft {
    const hd_potential *potential;
    const hd_integrator *integrator;
    int count, dimension;
    double step; /**< [time units] */
    double now;
    uint64_t steps;   /**< so many have been done */
    double energy;    /**< at the start */
    double error;     /**< of the energy now, see hd_soft_look */
    double *q, *p;    /**< [particle][dimension] after the last step, q in the box */
    bool sums;        /**< are taken: of a scene with gas */
    hd_summed summed; /**< but its time */
    hd_neighbours near;
} soft;

const hd_potential *hd_soft_potential(const hd_scene_def *scene);
const hd_integrator *hd_soft_integrator(const hd_scene_def *scene);
/** As asked for, or chosen [time units]. */
double hd_soft_time_step(const hd_scene_def *scene);

/** Potential energy of the start lattice; *energy. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_soft_lattice_energy(double *energy, const hd_scene_def *scene);

HD_MUST_CHECK hd_status hd_soft_create(void **state, const hd_scene_def *scene);
HD_MUST_CHECK hd_status hd_soft_create_from(void **state, const hd_scene_def *scene,
                                            const double *q, const double *p);
void hd_soft_free(void *state);
/** HD_ENERGY_LOST, too. */
HD_MUST_CHECK hd_status hd_soft_advance(void *state, hd_record *record, double t_end);

double hd_soft_kinetic_energy(const void *state);
/** Measures s->error: of kinetic and potential energy, as a part of both. HD_ENERGY_LOST if it is
 * more than can be of use. */
HD_MUST_CHECK hd_status hd_soft_look(soft *s);

#endif
