/** The run in its file: when it is written, and whether that went well. Used by one thread at a time. */
#ifndef HDLYAP_KEEPER_H
#define HDLYAP_KEEPER_H

#include "hdlyap/checkpoint.h"
#include "settings.h"

/** What others may know of it. */
typedef struct kept {
    bool failed;       /**< the last attempt */
    double time;       /**< simulated time of the last file that is whole; negative: none */
    char message[512]; /**< of the last failure */
} kept;

typedef struct keeper {
    const settings *set;
    double due; /**< [s of clock_seconds] */
    kept state;
} keeper;

keeper keeper_of(const settings *set);

/** Another run's file of that name, unless it is the one that is gone on from, becomes `name`.old; the log says so.
 *  HD_FILE_FAULT with its line in message. */
HD_MUST_CHECK hd_status keeper_set_aside(const settings *set, char *message, size_t size);

/** True once the interval has passed since the last attempt. */
bool keeper_due(const keeper *k);

/** Writes the run now. A failure is logged; the file of before stays. Does nothing without a file. */
void keeper_save(keeper *k, hd_run *run);

#endif
