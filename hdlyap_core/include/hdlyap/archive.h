/** How a dynamics of one's own writes its arrays into a checkpoint, and reads them. */
#ifndef HDLYAP_ARCHIVE_H
#define HDLYAP_ARCHIVE_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_archive hd_archive;

/** Writes x[count] under a name of at most 39 characters, or reads it: the same call does both, so
 * that they cannot differ. The archive fails if a number is not finite. Once it has failed it reads
 * nothing more, and the run is not resumed. */
void hd_archive_doubles(hd_archive *archive, const char *name, double *x, size_t count);

/** Makes the archive fail, because what was read cannot be right, for the reason `fault`. */
void hd_archive_refuse(hd_archive *archive, const char *name, const char *fault);

HD_API_END
#endif
