/** The particles as a gas [T19]: their collision rate, or the temperature and potential energy of
 * soft particles; and their pressure, with standard errors. Several threads may read one hd_gas at
 * once while none calls its run. */
#ifndef HDLYAP_GAS_H
#define HDLYAP_GAS_H

#include "hdlyap/trajectory.h"

HD_API_BEGIN

/** Means over all complete samples since the averaging began. Errors are standard errors [T8],
 * negative while they are not known. */
typedef struct hd_gas_means {
    double time;           /**< averaged time; all else is NaN while it is 0 [time units] */
    double collision_rate; /**< pair collisions of each particle, 2 collisions / (N t); NaN for soft
                              particles [1/time unit] */
    double collision_rate_error;
    double pressure; /**< mean over the directions [energy/sigma^d in d dimensions] */
    double pressure_error;
    double pressure_of[HD_DIMENSION_MAX]; /**< flux of px across x per length, in space per area;
                                             then of py across y, .. */
    double pressure_of_error[HD_DIMENSION_MAX];
    double compressibility; /**< Z = pressure area / (N kT), with kT = 2 / coordinates times the
                               mean kinetic energy of a particle: 1 for an ideal gas */
    double compressibility_error;
    double temperature; /**< kT of soft particles, from their free momenta [energy]; NaN for hard
                           ones, see hd_gas_temperature */
    double temperature_error;
    double potential_energy; /**< potential energy per soft particle [energy]; NaN for hard ones */
    double potential_energy_error;
} hd_gas_means;

typedef struct hd_gas hd_gas;

/** Reads the means. O(blocks). */
hd_gas_means hd_gas_read(const hd_gas *gas);

/** kT of hard particles, whose kinetic energy is N: 2 N divided by the number of free momenta,
 * those without the conserved ones. It is 1, for spheres and dumbbells 2/3, up to 1 / N [energy].
 */
double hd_gas_temperature(const hd_scene_def *def);

HD_API_END
#endif
