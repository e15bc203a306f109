/** The second check of a row of dynamics; the first one is hd_dynamics_check. */
#ifndef HD_ROW_CHECK_H
#define HD_ROW_CHECK_H

#include "hdlyap/dynamics.h"

/** Checks the numbers that the functions of a program's own row give for a scene, of which all else
 * is checked. */
HD_MUST_CHECK hd_status hd_row_check_numbers(const hd_scene_def *scene, char *message, size_t size);

/** Checks the kinds of particles that such a row tells, before anything reads them. */
HD_MUST_CHECK hd_status hd_row_check_kinds(const hd_scene_def *scene, char *message, size_t size);

#endif
