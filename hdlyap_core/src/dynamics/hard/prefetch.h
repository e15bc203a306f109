/** Fetches what the next events will touch into the cache, in time. */
#ifndef HD_PREFETCH_H
#define HD_PREFETCH_H

#include "dynamics/hard/prediction.h"

/** Has to be called when the queue has gone on from bucket `from`. If the state does not fit into
 * the cache, it fetches what the events of the buckets ahead will touch. Results do not change. */
void hd_prefetch_ahead(const hd_motion *m, int32_t from);

#endif
