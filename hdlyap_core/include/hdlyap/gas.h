/** The particles as a gas [T19]: their pressure; the collision rate of hard particles; the
 * temperature and potential energy of soft ones; all with standard errors. The unit of energy is
 * the mean kinetic energy of a hard particle, or epsilon of the soft potential. Several threads may
 * read one hd_gas at once while no thread calls its run. Tags as [T19] are those of equations in
 * THEORY.md. */
#ifndef HDLYAP_GAS_H
#define HDLYAP_GAS_H

#include "hdlyap/trajectory.h"

HD_API_BEGIN

/** Pairs of two kinds of particles: 11, 12 and 22, in this order. */
enum { HD_KIND_PAIRS = 3 };

/** Means over all complete samples since the averaging began. Each _error is the standard error
 * [T8] of the number in front of it, negative while it is not known or the number does not exist.
 */
typedef struct hd_gas_means {
    double time;           /**< averaged time; while it is 0 all means are NaN [time units] */
    double collision_rate; /**< pair collisions in which a particle takes part per time, 2
                              collisions / (N time); NaN for soft particles [1/time unit] */
    double collision_rate_error;
    /** Parts of collision_rate: of each pair of kinds; NaN unless there are two [1/time unit]. */
    double pair_rate[HD_KIND_PAIRS];
    double pair_rate_error[HD_KIND_PAIRS];
    /** What kinetic theory says of pair_rate, but for 1/N [T26] [1/time unit]. */
    double pair_rate_expected[HD_KIND_PAIRS];
    double pressure; /**< mean over all directions [energy/sigma^d in d dimensions] */
    double pressure_error;
    /** Pressure along x, y and in space z: flux of momentum component d across a plane
     * perpendicular to direction d, per length of it that centres can reach, in space per area
     * [energy/sigma^d]. 0 for z in the plane. */
    double pressure_of[HD_DIMENSION_MAX];
    double pressure_of_error[HD_DIMENSION_MAX];
    double compressibility; /**< compressibility factor Z = d P A / (m kT), 1 for an ideal gas: A is
                               the area or volume that centres can reach, m the number of their
                               free momenta in d dimensions, d N less the conserved ones [T19] */
    double compressibility_error;
    double compressibility_expected; /**< what kinetic theory says of it; NaN unless particles are
                                        disks or spheres [T2], [T26] */
    double temperature; /**< kT of soft particles, from their free momenta [energy]; NaN for hard
                           ones, whose kinetic energy is constant: see hd_gas_temperature */
    double temperature_error;
    double potential_energy; /**< mean potential energy of a soft particle [energy]; NaN for hard
                                ones */
    double potential_energy_error;
    /** Momentum along shearing walls that flows from the high one to the low one, per time and
     * length [T27] [energy/sigma^d]; NaN, as the numbers below, without such walls. */
    double shear_stress;
    double shear_stress_error;
    /** Mean velocity along shearing walls of the particles near the one at the low end, and near
     * that at the high end: whose centres are within 1 sigma of where they meet it [sigma/time
     * unit]. */
    double wall_velocity[2];
    double wall_velocity_error[2];
    double divergence; /**< mean divergence of the flow, as hd_run_divergence, which is less than 0
                          where phase space contracts [1/time unit]; NaN where maps are symplectic,
                          and if the dynamics does not tell it */
    double divergence_error;
} hd_gas_means;

/** The gas of a run; owned by the run. */
typedef struct hd_gas hd_gas;

/** Reads the means; O(number of blocks), which is at most 97. */
hd_gas_means hd_gas_read(const hd_gas *gas);

/** kT of hard particles, whose total kinetic energy is N: 2 N divided by the number of free
 * momenta, which are all momenta but the conserved ones [energy]. It is 1 for disks and 2/3 for
 * spheres and dumbbells, but for terms of order 1 / N. */
double hd_gas_temperature(const hd_scene_def *def);

HD_API_END
#endif
