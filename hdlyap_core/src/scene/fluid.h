/** What kinetic theory predicts for particles in a box. */
#ifndef HD_FLUID_H
#define HD_FLUID_H

#include "hdlyap/dynamics.h"

/** The curvature of a branch, lambda = c k + c2 k^2 + c3 k^3, as measured in long boxes [T12]. With
 * the mean free path l, c2 / c = c2 + c2_l l and c3 / c = c3 + c3_l2 l^2. Errors have the same
 * form; `off` is the part of c3 / c by which single densities differ from the formula. */
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
