/** The particles as a gas: how often they collide, or, of what has a potential, their temperature
 * and its energy; and the pressure that follows, with standard errors [T19]. Several threads may
 * read one at once while its run is not called. */
#ifndef HDLYAP_GAS_H
#define HDLYAP_GAS_H

#include "hdlyap/trajectory.h"

HD_API_BEGIN

/** Means over all whole samples since the averages began. Errors are standard errors [T8]; negative
 * while they cannot be known. */
typedef struct hd_gas_means {
    double time;                 /**< averaged time [time units]; without it all else is NaN */
    double collision_rate;       /**< 2 pair events / (N t): of each particle [1/time unit]; NaN of
                                    what does not collide */
    double collision_rate_error; /**< negative if not yet known, as the next ones */
    double pressure;             /**< mean of all directions [energy/sigma^d in d dimensions] */
    double pressure_error;
    double pressure_of[HD_DIMENSION_MAX]; /**< momentum along x that crosses a line (of spheres a
                              plane) across it, per length (area) and time; along y, .. */
    double pressure_of_error[HD_DIMENSION_MAX];
    double compressibility; /**< Z = pressure area / (N kT), kT = 2 / (coordinates of one) times the
                               mean kinetic energy of a particle: 1 of what does not interact */
    double compressibility_error;
    double temperature; /**< kinetic, by the momenta that are free [energy]; NaN of what collides:
                           hd_gas_temperature */
    double temperature_error;
    double potential_energy; /**< of each particle [energy]; NaN of what collides */
    double potential_energy_error;
} hd_gas_means;

typedef struct hd_gas hd_gas;

/** O(blocks). */
hd_gas_means hd_gas_read(const hd_gas *gas);

/** kT of particles whose kinetic energy is N: twice that over the momenta that are free, those less
 * that are conserved; but for 1 / N it is 1, of spheres and dumbbells 2/3 [energy]. */
double hd_gas_temperature(const hd_scene_def *def);

HD_API_END
#endif
