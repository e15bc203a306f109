/** Records of equal length, kept in memory or in a file without a name, up to a limit. */
#ifndef HD_STORE_H
#define HD_STORE_H

#include <stddef.h>

#include "hdlyap/status.h"

typedef struct hd_store hd_store;

/** Bytes that are free in a folder; negative (errno) where no file can be made. */
double hd_store_folder_room(const char *folder);

/** Room for `most` records of `doubles` numbers. In memory (folder NULL) it is taken as it is
 * needed; in a file in the folder all of it at once, so that what begins can end. The file has no
 * name and is gone with the process. HD_NO_MEMORY; HD_FILE_FAULT (errno says why). */
HD_MUST_CHECK hd_status hd_store_create(hd_store **out, size_t doubles, long most,
                                        const char *folder);
void hd_store_free(hd_store *store);

long hd_store_most(const hd_store *store);

/** Record 0 .. most - 1. HD_NO_MEMORY, HD_FILE_FAULT. */
HD_MUST_CHECK hd_status hd_store_put(hd_store *store, long record, const double *data);
/** One that was put. */
HD_MUST_CHECK hd_status hd_store_fetch(hd_store *store, double *data, long record);

#endif
