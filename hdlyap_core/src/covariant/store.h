/** Records of equal length, up to a limit. */
#ifndef HD_STORE_H
#define HD_STORE_H

#include <stddef.h>

#include "hdlyap/status.h"

typedef struct hd_store hd_store;

/** Room for `most` records of `doubles` numbers, taken as it is needed. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_store_create(hd_store **out, size_t doubles, long most);
void hd_store_free(hd_store *store);

/** Bytes that it takes once all are put. */
double hd_store_bytes(size_t doubles, long most);

/** Record 0 .. most - 1, to be filled: [doubles]; NULL without memory. */
double *hd_store_put(hd_store *store, long record);
/** One that was put. */
const double *hd_store_fetch(const hd_store *store, long record);

#endif
