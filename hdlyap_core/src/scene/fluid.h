/** What kinetic theory predicts for particles in a box. */
#ifndef HD_FLUID_H
#define HD_FLUID_H

#include "hdlyap/dynamics.h"

/** What is known beforehand of the curvature of a branch, lambda = c k + C2 k^2 + C3 k^3, measured
 * in long boxes [T12] at mean free paths l: C2 / c = c2 + c2_l l, with the error error + error_l l,
 * and C3 / c = c3 + c3_l2 l^2, with the error c3_error + off C3 / c; `off` is the part by which
 * single densities differ from the formula. */
typedef struct hd_curvature {
    double c2, c2_l, error, error_l, c3, c3_l2, c3_error, off;
} hd_curvature;

struct hd_fluid {
    double density_max;                            /**< closest packing */
    double (*rate)(const hd_scene_def *def);       /**< collisions of one particle per time unit */
    double (*free_path)(const hd_scene_def *def);  /**< mean path between two of them [sigma] */
    double (*sound)(const hd_scene_def *def);      /**< velocity of sound */
    double (*transverse)(const hd_scene_def *def); /**< lambda / k of the transverse modes of long
                                                      waves, as measured, to some percent */
    hd_curvature lp, t;
};

/** Hard disks and spheres of kinetic energy 1 each, by Enskog's theory. */
extern const hd_fluid hd_fluid_disks, hd_fluid_spheres;

#endif
