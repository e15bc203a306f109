/** The run in its file: when it is written, and whether that went well. Used by one thread at a
 * time. */
#ifndef HDLYAP_CHECKPOINT_WRITER_H
#define HDLYAP_CHECKPOINT_WRITER_H

#include <stdbool.h>

#include "hdlyap/checkpoint.h"
#include "settings.h"

/** What others may know of it. */
typedef struct kept {
    bool failed;       /**< the last attempt */
    double time;       /**< simulated time of the last file that is whole; -1: no file */
    char message[512]; /**< of the last failure */
} kept;

typedef struct checkpoint_writer {
    const settings *set;
    bool changed; /**< the run is not as in the file */
    double due;   /**< [s of clock_seconds]; INFINITY: only when asked */
    int written;  /**< the file as it was written, held open: its number is not given again; -1 */
    kept state;
} checkpoint_writer;

/** Whether checkpoints could be written, if they are asked for; another run with the same file may
 * be writing it: then after that. HD_FILE_FAULT, with its line in message. */
HD_MUST_CHECK hd_status checkpoint_writer_check(const settings *set, char *message, size_t size);

/** Writes the first file, so that what cannot be kept is not begun; does nothing without one. A
 * file of that name, unless it is the one that is gone on from, is set aside under a name of its
 * own (FILE.old, FILE.old2 ..); the log says so. Fails as hd_run_save, with its line in message;
 * all files are then as they were. */
HD_MUST_CHECK hd_status checkpoint_writer_begin(checkpoint_writer *out, const settings *set,
                                                hd_run *run, char *message, size_t size);

/** The run has gone on. */
void checkpoint_writer_touch(checkpoint_writer *k);

/** True once the interval has passed since the last attempt, if there is anything new. */
bool checkpoint_writer_due(const checkpoint_writer *k);

/** Writes the run now, unless the file is as new. A failure is logged; the file of before stays. */
void checkpoint_writer_save(checkpoint_writer *k, hd_run *run);

#endif
