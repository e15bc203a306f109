/** Records of equal length, up to a limit. */
#ifndef HD_STORE_H
#define HD_STORE_H

#include <stddef.h>

#include "hdlyap/status.h"

typedef struct hd_store hd_store;

/** Creates a store of up to `most` records of `doubles` numbers; memory is taken as it is needed.
 * Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_store_create(hd_store **out, size_t doubles, long most);
void hd_store_free(hd_store *store);

/** Bytes that a full store takes. */
double hd_store_bytes(size_t doubles, long most);

/** A record, 0 .. most - 1, [doubles], for the caller to fill; NULL if there is no memory. */
double *hd_store_put(hd_store *store, long record);
/** A record that was put before. */
const double *hd_store_fetch(const hd_store *store, long record);

#endif
