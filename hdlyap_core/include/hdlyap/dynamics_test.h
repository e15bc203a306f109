/** A test of a row of dynamics: whether its functions do what they say. It finds mistakes that a
 * run cannot see, as a second derivative that is 5 % wrong, or a number that the archive forgets.
 */
#ifndef HDLYAP_DYNAMICS_TEST_H
#define HDLYAP_DYNAMICS_TEST_H

#include <stddef.h>

#include "hdlyap/dynamics.h"

HD_API_BEGIN

/** Tests a row on a scene of its particles; NULL: on hd_scene_def_of(row). It moves them for some
 * ten of the times (N / 2) / collision_rate, and asks:
 * - Do the members fit together (hd_dynamics_check), and does hd_scene_check accept the scene?
 * - Are entries in order, and do records and times end where they must (hd_trajectory_fault)?
 * - Is the motion the same if the time is cut into other advances? To the bit if the row has
 * hd_dynamics.step.
 * - Does a state that hd_dynamics.archive wrote, and read into a new one, go on to the same bits?
 * - Do averages follow from the state alone, are they finite, and no more than the row says?
 * - Do tangent maps give the same in parts as in one go, and at each width?
 * - Are they symplectic, if the row says so?
 * - Is hd_dynamics.divergence the growth of the volume that they carry?
 * - Do they carry vectors as nearby trajectories go? These start from numbers of the archive that
 * are changed a little.
 * - Are null vectors carried into the span of those of the later state?
 * - Are there as many exponents that vanish as the row says? Only with up to 64 exponents, and if
 *   100 of the times above have few enough entries.
 * Returns HD_OK; HD_REFUSED with one line in message[size], unless that is NULL, which begins with
 * the member that is wrong; HD_NO_MEMORY; or HD_FILE_FAULT if there is no temporary file. Cost: for
 * up to some hundred particles less than a few seconds. */
HD_MUST_CHECK hd_status hd_dynamics_test(const hd_dynamics *row, const hd_scene_def *scene,
                                         char *message, size_t size);

HD_API_END
#endif
