/** A run's arrays, without the file around them. */
#ifndef HD_CHECKPOINT_H
#define HD_CHECKPOINT_H

#include "base/archive.h"
#include "hdlyap/checkpoint.h"

void hd_run_write(hd_run *run, hd_archive *archive, const char *label);

/** Does what hd_run_resume does, from any bytes; the line in message does not name the file. */
HD_MUST_CHECK hd_status hd_run_read(hd_run **out, hd_archive *archive, const hd_scene_def *scene,
                                    hd_communicator *communicator, char *message, size_t size);

#endif
