/** A run in a file: kept while it goes on, taken up again after whatever ended it.
 *
 * The file is a list of named arrays behind a head with format, length and checksum
 * (doc/survival.md). It holds disks, pending events, frame, averages, phases, what the intervals
 * have taught and what has been changed but does not hold yet; so a run that was taken up has the
 * same events bit for bit, and with the same number of threads, BLAS kernels and stages observed
 * the same exponents. */
#ifndef HDLYAP_CHECKPOINT_H
#define HDLYAP_CHECKPOINT_H

#include "hdlyap/run.h"

HD_API_BEGIN

enum { HD_CHECKPOINT_FORMAT = 17, HD_CHECKPOINT_LABEL = 64 };

/** What a checkpoint says of itself. */
typedef struct hd_checkpoint {
    hd_scene_def scene;              /**< as asked for */
    char label[HD_CHECKPOINT_LABEL]; /**< as given to hd_run_save */
    char particles[HD_PARTICLES];    /**< name of the dynamics */
    double time;                     /**< simulated time since the start */
} hd_checkpoint;

/** Writes the run, between two steps, to `path`: to `path`.part first, which replaces the file only
 * when it is whole and on the disk. `label` (at most HD_CHECKPOINT_LABEL - 1 bytes of it) is kept.
 * HD_FILE_FAULT with one line in `message` (the file, the reason), HD_NOT_FINITE if a number of the
 * run is none, HD_FILE_FAULT for contents with which no run could be resumed, the status of a run
 * that has failed; an older file then stays as it was. Of several ranks rank 0
 * writes, and has the line. Cost: 32 N n bytes. */
HD_MUST_CHECK hd_status hd_run_save(hd_run *run, const char *path, const char *label, char *message,
                                    size_t size);

/** HD_OK if hd_run_save could write there now; HD_FILE_FAULT with its line else. */
HD_MUST_CHECK hd_status hd_checkpoint_writable(const char *path, char *message, size_t size);

/** Reads a checkpoint, all of it, and says whose it is: that of hd_particles, or of one of the
 * dynamics own[count]. HD_FILE_FAULT with one line in `message`: it is missing, no checkpoint, of a
 * newer format, of another dynamics, cut short, damaged. */
HD_MUST_CHECK hd_status hd_checkpoint_read(hd_checkpoint *out, const char *path,
                                           const hd_dynamics *const *own, int count, char *message,
                                           size_t size);

/** The run of a checkpoint goes on. `scene` (NULL: the checkpoint's, of hd_particles) may differ
 * from the checkpoint's in those parameters whose row (hd_scene_parameters) says so, with a
 * duration not shorter than what has been averaged; anything else is HD_REFUSED with its line. With
 * 0 threads as many as before, if the machine has them. A run that had finished goes on if there is
 * more to do. A window of covariant vectors that was under way is begun anew. HD_FILE_FAULT as
 * hd_checkpoint_read, and for contents that no run has; HD_NO_MEMORY.
 */
HD_MUST_CHECK hd_status hd_run_resume(hd_run **out, const char *path, const hd_scene_def *scene,
                                      char *message, size_t size);
/** hd_run_resume by several ranks together, each of which reads the file; there may be more or
 * fewer of them than before. */
HD_MUST_CHECK hd_status hd_run_resume_shared(hd_run **out, const char *path,
                                             const hd_scene_def *scene,
                                             hd_communicator *communicator, char *message,
                                             size_t size);

HD_API_END
#endif
