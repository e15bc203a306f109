/** The computation in a thread of its own: it steps a run, publishes reports when they are due,
 * writes checkpoints, and obeys pause and reset. */
#ifndef HDLYAP_WORKER_H
#define HDLYAP_WORKER_H

#include "checkpoint_writer.h"
#include "examination.h"
#include "topics/report.h"

typedef enum worker_stage {
    WORKER_WAITING, /**< for subscribers */
    WORKER_RUNNING,
    WORKER_PAUSED,
    WORKER_ENDED /**< finished, stopped or at fault */
} worker_stage;

/** State of the worker for other threads, after its last finished step. */
typedef struct worker_state {
    worker_stage stage;
    hd_status status; /**< the status with which the run failed, else HD_OK */
    char fault[256];  /**< the fault in words, with its numbers */
    progress last;
    examination seen;      /**< result of the last worker_examine */
    const char *warning;   /**< warning of the settings */
    const char *particles; /**< name of the particles, e.g. disks */
    kept checkpoint;
    bool saving; /**< a checkpoint is being written */
    double lost; /**< hdr_node_lost, filled in by the caller of worker_state */
} worker_state;

typedef struct worker worker;

/** Makes a worker that has not begun. Returns false if there is no memory. */
bool worker_create(worker **out, hd_run *run, report *rep, settings *set, changes *all,
                   const checkpoint_writer *keep);
/** Starts the thread. Until worker_state says WORKER_ENDED, only the thread uses run, rep, changes,
 * and the settings that may change. False if the system cannot start a thread. */
bool worker_begin(worker *w);
/** Asks the thread to end and waits for the step that it is in. NULL is allowed. */
void worker_end(worker *w);
/** Frees the worker after worker_end; NULL is allowed. */
void worker_free(worker *w);

worker_state worker_state_now(worker *w);

void worker_pause(worker *w, bool pause);
/** Asks the thread to begin the averages again before the next step. */
void worker_reset_average(worker *w);

/** Asks the thread to examine the particles before the next step; it does so unless examinations
 * would take more than a hundredth of the time. */
void worker_examine(worker *w);

/** Has a checkpoint written before the next step, and waits for it at most this long. False if it
 * was not written, with the reason in message. */
bool worker_checkpoint(worker *w, double seconds, char *message, size_t size);

/** Has a parameter changed before the next step, as changes_ask does, and waits for it at most this
 * long, once it is this thread's turn; assignment NULL: has changes_end called. False, with the
 * reason in message, if nothing has changed and nothing will. */
bool worker_set(worker *w, double seconds, const char *assignment, char *message, size_t size);

/** Ends the averaging in the same way; a run that pauses goes on to its end. */
static inline bool worker_end_averaging(worker *w, double seconds, char *message, size_t size)
{
    return worker_set(w, seconds, NULL, message, size);
}

/** Waits at most this long for the end; true if it has come. */
bool worker_wait(worker *w, double seconds);
/** Asks the thread to end after its present step. */
void worker_stop(worker *w);
/** Publishes the last message from the caller's thread; the worker publishes nothing after it, even
 * if it is still in a step. */
HD_MUST_CHECK hd_status worker_finish(worker *w);

#endif
