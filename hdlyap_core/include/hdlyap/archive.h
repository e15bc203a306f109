/** How a program's own dynamics (hdlyap/dynamics.h) writes its state into a checkpoint and reads it
 * back. */
#ifndef HDLYAP_ARCHIVE_H
#define HDLYAP_ARCHIVE_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

/** A checkpoint that is being written or read. The core makes it, and hands it to
 * hd_dynamics.archive. */
typedef struct hd_archive hd_archive;

/** If the checkpoint is being written, writes x[count] into it; if it is being read, fills x[count]
 * from it. So one sequence of calls serves for both. `name` has at most 39 characters; arrays must
 * be read in the order in which they were written, with the same names and counts. The archive
 * fails if a number is not finite, or if another array or the end of the file is found. Once it has
 * failed, writing does nothing, reading fills x with zeros, and hd_run_save or hd_run_resume
 * reports the first failure. */
void hd_archive_doubles(hd_archive *archive, const char *name, double *x, size_t count);

/** Makes the archive fail because what was read into the array `name` cannot be right. `fault` is
 * the reason in words, for the user; both texts must last until the archive has ended, as literals
 * do. */
void hd_archive_refuse(hd_archive *archive, const char *name, const char *fault);

HD_API_END
#endif
