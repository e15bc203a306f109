/** States of particles with given q and p, both [particle][coordinates], for tests and benchmarks.
 * All fail with HD_REFUSED for a box that hd_scene_check refuses; those of hard particles for
 * positions outside it or momenta above 1e6, too, and with HD_OVERLAP if particles overlap deeper
 * than hd_invariants.overlap_max; those of soft ones with HD_NOT_FINITE for positions outside it.
 */
#ifndef HD_CREATE_FROM_H
#define HD_CREATE_FROM_H

#include "hdlyap/dynamics.h"

HD_MUST_CHECK hd_status hd_hard_create_from_2d(void **state, const hd_scene_def *def,
                                               const double *q, const double *p);
HD_MUST_CHECK hd_status hd_hard_create_from_3d(void **state, const hd_scene_def *def,
                                               const double *q, const double *p);
HD_MUST_CHECK hd_status hd_hard_create_from_2d_mixed(void **state, const hd_scene_def *def,
                                                     const double *q, const double *p);
HD_MUST_CHECK hd_status hd_hard_create_from_3d_mixed(void **state, const hd_scene_def *def,
                                                     const double *q, const double *p);
HD_MUST_CHECK hd_status hd_dumbbells_create_from(void **state, const hd_scene_def *def,
                                                 const double *q, const double *p);
HD_MUST_CHECK hd_status hd_soft_create_from(void **state, const hd_scene_def *scene,
                                            const double *q, const double *p);

#endif
