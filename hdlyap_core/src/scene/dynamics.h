/** The rows of dynamics that the core brings. */
#ifndef HD_DYNAMICS_ROWS_H
#define HD_DYNAMICS_ROWS_H

#include "hdlyap/dynamics.h"

extern const hd_dynamics hd_hard_disks, hd_hard_spheres;

#endif
