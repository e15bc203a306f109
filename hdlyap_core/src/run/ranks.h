/** Checks that the ranks of a run agree. */
#ifndef HD_RANKS_H
#define HD_RANKS_H

#include "hdlyap/communicator.h"
#include "hdlyap/trajectory.h"

/** Checks that these ranks can carry the scene together. Fails with HD_REFUSED and a line that says
 * why, or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_ranks_check(const hd_scene_def *def, hd_communicator *communicator,
                                       char *message, size_t size);

/** Fails with HD_RANKS_APART unless all ranks have the same particles, bit for bit. */
HD_MUST_CHECK hd_status hd_ranks_compare(hd_communicator *communicator,
                                         const hd_trajectory *trajectory);

#endif
