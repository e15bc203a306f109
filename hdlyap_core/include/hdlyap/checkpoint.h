/** Checkpoints: a run in a file, from which it can be resumed.
 *
 * The file has a head with format, length and checksum, and a list of named arrays
 * (doc/survival.md): particles, frame, averages, what was measured last, lengths of intervals, and
 * changes (hd_run_change) that do not hold yet. A resumed run has the same trajectory, bit for bit,
 * as an uninterrupted one; with the same number of threads, BLAS routines and observables also the
 * same exponents.
 *
 * In all functions, message[size] gets one line with the reason of a failure; `message` may be
 * NULL. */
#ifndef HDLYAP_CHECKPOINT_H
#define HDLYAP_CHECKPOINT_H

#include "hdlyap/run.h"

HD_API_BEGIN

/** The format of the files that this version writes, the only one that it reads; and the bytes of
 * the label of a file (see hd_run_save), with its final zero. */
enum { HD_CHECKPOINT_FORMAT = 21, HD_CHECKPOINT_LABEL = 64 };

/** What can be read of a checkpoint without resuming its run. */
typedef struct hd_checkpoint {
    hd_scene_def scene;              /**< the scene of the run */
    char label[HD_CHECKPOINT_LABEL]; /**< the label that hd_run_save was given, shortened to fit */
    char particles[HD_PARTICLES];    /**< name of the dynamics, as disks */
    double time;                     /**< simulated time since the start of the run [time units] */
} hd_checkpoint;

/** Writes the run to the file `path`. It may be called between two calls of hd_run_advance. It
 * first writes `path`.part, which then replaces an older `path` when it is complete and on the
 * disk; if writing fails, the older file stays. The first HD_CHECKPOINT_LABEL - 1 bytes of `label`
 * are kept. Returns HD_FILE_FAULT if the file cannot be written, or if no run could be resumed from
 * its contents; HD_NOT_FINITE if a number of the run is not finite; or the status with which the
 * run has failed before. With several ranks all call it, rank 0 writes, and only its `message` is
 * filled. The file has about 32 N n bytes for N particles with two coordinates and n vectors that
 * are carried (hd_counts.carried). */
HD_MUST_CHECK hd_status hd_run_save(hd_run *run, const char *path, const char *label, char *message,
                                    size_t size);

/** Returns HD_OK if hd_run_save could write to `path` now, otherwise HD_FILE_FAULT. It leaves no
 * file behind. */
HD_MUST_CHECK hd_status hd_checkpoint_writable(const char *path, char *message, size_t size);

/** Reads a whole checkpoint and checks it. Its particles are those of hd_particles or of one of the
 * dynamics own[count], which must last as long as out->scene is used. Returns HD_FILE_FAULT if the
 * file is missing, no checkpoint, of another format or dynamics, cut short or damaged. */
HD_MUST_CHECK hd_status hd_checkpoint_read(hd_checkpoint *out, const char *path,
                                           const hd_dynamics *const *own, int count, char *message,
                                           size_t size);

/** Makes the run of a checkpoint in *out, at the time at which it was saved; the caller frees it
 * with hd_run_free. If `scene` is NULL, the run has the scene of the checkpoint, which must be of
 * hd_particles. Otherwise the call returns HD_REFUSED unless `scene` differs from that scene only
 * in parameters with hd_parameter.may_differ, and its duration is not shorter than the averaged
 * time. With threads = 0 the run has as many threads as before, or fewer if the machine has fewer.
 * A finished run goes on if `scene` has a longer duration, or a target that is not reached yet. A
 * window of covariant vectors that was not complete begins again. Returns HD_FILE_FAULT for the
 * reasons of hd_checkpoint_read, and if no run can have these contents; or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_run_resume(hd_run **out, const char *path, const hd_scene_def *scene,
                                      char *message, size_t size);
/** hd_run_resume for a run that several ranks carry. All ranks call it together, and each reads the
 * file. There may be more or fewer ranks than in the run that wrote it. */
HD_MUST_CHECK hd_status hd_run_resume_shared(hd_run **out, const char *path,
                                             const hd_scene_def *scene,
                                             hd_communicator *communicator, char *message,
                                             size_t size);

HD_API_END
#endif
