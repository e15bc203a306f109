/** Writes the run's checkpoint when it is due, and keeps whether that succeeded. One thread at a
 * time may use it. */
#ifndef HDLYAP_CHECKPOINT_WRITER_H
#define HDLYAP_CHECKPOINT_WRITER_H

#include <stdbool.h>

#include "hdlyap/checkpoint.h"
#include "settings.h"

/** What other threads may read about checkpoints. */
typedef struct kept {
    bool failed;       /**< true if the last attempt to write failed */
    double time;       /**< simulated time of the last file that is whole; -1: no file */
    char message[512]; /**< why the last failure happened */
} kept;

typedef struct checkpoint_writer {
    const settings *set;
    bool changed; /**< true if the run has gone on since the file was written */
    double due; /**< when to write next [s of clock_seconds]; INFINITY: only when a service asks for
                   it */
    int written; /**< the file, held open so that its inode number is not reused; -1: none */
    kept state;
} checkpoint_writer;

/** Checks that checkpoints can be written, if the settings ask for them; waits if another run is
 * just writing the same file. Fails with HD_FILE_FAULT and a line in message. */
HD_MUST_CHECK hd_status checkpoint_writer_check(const settings *set, char *message, size_t size);

/** Writes the first checkpoint, so that a run that cannot be kept does not begin; does nothing if
 * the settings ask for none. A file that has the name already is renamed to FILE.old, FILE.old2 ..,
 * unless the run is resumed from it; the log says so. Fails as hd_run_save does, with a line in
 * message; all files are then as before. */
HD_MUST_CHECK hd_status checkpoint_writer_begin(checkpoint_writer *out, const settings *set,
                                                hd_run *run, char *message, size_t size);

/** Says that the run has gone on since the last writing. */
void checkpoint_writer_touch(checkpoint_writer *k);

/** True if the run has changed, and checkpoint_interval has passed since the last attempt. */
bool checkpoint_writer_due(const checkpoint_writer *k);

/** Writes the run now, unless the file has this state already. Logs a failure; the old file stays.
 */
void checkpoint_writer_save(checkpoint_writer *k, hd_run *run);

#endif
