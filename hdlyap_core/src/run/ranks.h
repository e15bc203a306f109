/** What the ranks of a run have in common. */
#ifndef HD_RANKS_H
#define HD_RANKS_H

#include "hdlyap/communicator.h"
#include "hdlyap/trajectory.h"

/** A scene that these ranks can carry together: HD_REFUSED with its line, or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_ranks_check(const hd_scene_def *def, hd_communicator *communicator,
                                       char *message, size_t size);

/** HD_RANKS_APART unless all of them have the same disks, bit for bit. */
HD_MUST_CHECK hd_status hd_ranks_compare(hd_communicator *communicator, const hd_trajectory *disks);

#endif
