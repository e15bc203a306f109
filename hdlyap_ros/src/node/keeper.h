/** The run in its file: when it is written, and whether that went well. Used by one thread at a time. */
#ifndef HDLYAP_KEEPER_H
#define HDLYAP_KEEPER_H

#include "hdlyap/checkpoint.h"
#include "settings.h"

/** What others may know of it. */
typedef struct kept {
    bool failed;       /**< the last attempt */
    double time;       /**< simulated time of the last file that is whole; -1: no file */
    char message[512]; /**< of the last failure */
} kept;

typedef struct keeper {
    const settings *set;
    double due; /**< [s of clock_seconds] */
    kept state;
} keeper;

/** Writes the first file, so that what cannot be kept is not begun. Another run's file of that name, unless it is the one
 *  that is gone on from, becomes `name`.old; the log says so. Fails as hd_run_save, with its line in message. */
HD_MUST_CHECK hd_status keeper_begin(const settings *set, hd_run *run, char *message, size_t size);

/** Of a run that has begun so. */
keeper keeper_of(const settings *set, const hd_run *run);

/** True once the interval has passed since the last attempt. */
bool keeper_due(const keeper *k);

/** Writes the run now. A failure is logged; the file of before stays. Does nothing without a file. */
void keeper_save(keeper *k, hd_run *run);

#endif
