/** Checkpoints: a run in a file, from which it can be resumed.
 *
 * The file has a head with format, length and checksum, and a list of named arrays
 * (doc/survival.md): particles, pending events, frame, averages, phases, what is learnt about
 * intervals, and changes that do not hold yet. So a resumed run has the same events bit for bit as
 * an uninterrupted one; with the same threads, BLAS kernels and observables also the same
 * exponents.
 */
#ifndef HDLYAP_CHECKPOINT_H
#define HDLYAP_CHECKPOINT_H

#include "hdlyap/run.h"

HD_API_BEGIN

enum { HD_CHECKPOINT_FORMAT = 18, HD_CHECKPOINT_LABEL = 64 };

/** Contents of the head and the scene of a checkpoint. */
typedef struct hd_checkpoint {
    hd_scene_def scene;              /**< the scene of the run */
    char label[HD_CHECKPOINT_LABEL]; /**< the label that hd_run_save was given */
    char particles[HD_PARTICLES];    /**< name of the dynamics */
    double time;                     /**< simulated time since the start of the run [time units] */
} hd_checkpoint;

/** Writes the run to `path`, between two calls of hd_run_advance. It writes `path`.part first,
 * which replaces the file when it is complete and on the disk, and keeps HD_CHECKPOINT_LABEL - 1
 * bytes of `label`. If it fails, an older file stays: HD_FILE_FAULT with the file and the reason in
 * `message`, also if no run could be resumed from the contents; HD_NOT_FINITE for a number that is
 * not finite; or the status of a run that has failed. With several ranks rank 0 writes, and has the
 * message. The file has about 32 N n bytes. */
HD_MUST_CHECK hd_status hd_run_save(hd_run *run, const char *path, const char *label, char *message,
                                    size_t size);

/** HD_OK if hd_run_save could write to `path` now; otherwise HD_FILE_FAULT, with a line in
 * `message`.
 */
HD_MUST_CHECK hd_status hd_checkpoint_writable(const char *path, char *message, size_t size);

/** Reads a whole checkpoint of hd_particles, or of one of the dynamics own[count]. HD_FILE_FAULT
 * with one line in `message` if it is missing, no checkpoint, of another format or dynamics, cut
 * short or damaged. */
HD_MUST_CHECK hd_status hd_checkpoint_read(hd_checkpoint *out, const char *path,
                                           const hd_dynamics *const *own, int count, char *message,
                                           size_t size);

/** Resumes the run of a checkpoint. `scene` may differ from the scene of the checkpoint only in
 * parameters whose row (hd_scene_parameters) allows it, and the duration must not be shorter than
 * what is averaged; otherwise HD_REFUSED with a line in `message`. NULL is the scene of the
 * checkpoint, for hd_particles only. 0 threads means as many as before, if the machine has them. A
 * finished run goes on if the scene asks for more. An incomplete window of covariant vectors begins
 * again. HD_FILE_FAULT as hd_checkpoint_read, and if no run can have such contents; HD_NO_MEMORY.
 */
HD_MUST_CHECK hd_status hd_run_resume(hd_run **out, const char *path, const hd_scene_def *scene,
                                      char *message, size_t size);
/** hd_run_resume for several ranks, which call it together and each read the file. Their number may
 * differ from that of the run which wrote it. */
HD_MUST_CHECK hd_status hd_run_resume_shared(hd_run **out, const char *path,
                                             const hd_scene_def *scene,
                                             hd_communicator *communicator, char *message,
                                             size_t size);

HD_API_END
#endif
