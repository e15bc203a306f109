/** What a run of several ranks has beside that of one. */
#ifndef HD_RANKS_H
#define HD_RANKS_H

#include "run/run_state.h"

/** What one rank cannot do, none does. */
HD_MUST_CHECK hd_status hd_run_agree(const hd_run *run, hd_status status);

/** A scene that these ranks can carry together: HD_REFUSED with its line, or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_run_check_together(const hd_scene_def *def,
                                              hd_communicator *communicator, char *message,
                                              size_t size);

/** Ranks share the cores of their machine. */
int hd_run_threads_most(const hd_run *run);

/** True where somebody wants all of the vectors of this very time. */
bool hd_run_vectors_wanted(const hd_run *run);
/** True where a watcher wants vectors. */
bool hd_run_is_watched(const hd_run *run);
/** HD_RANKS_APART unless all of them have the same disks, bit for bit. */
HD_MUST_CHECK hd_status hd_run_compare_disks(const hd_run *run);

/** Vectors that somebody wants to read now, of all ranks on each of them. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_run_gather(hd_run *run);

#endif
