/** A checkpoint's arrays, for a dynamics of one's own. */
#ifndef HDLYAP_ARCHIVE_H
#define HDLYAP_ARCHIVE_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_archive hd_archive;

/** Writes x[count] under a name of up to 39 characters, or reads it: one call for both, so what is
 * written and what is read cannot differ. Numbers must be finite, or the archive fails; once it has
 * failed nothing is read any more, and no run comes of it. */
void hd_archive_doubles(hd_archive *archive, const char *name, double *x, size_t count);

/** What was read cannot be: the archive fails, with the reason. */
void hd_archive_refuse(hd_archive *archive, const char *name, const char *fault);

HD_API_END
#endif
