/** What the next events will touch, fetched in time. */
#ifndef HD_PREFETCH_H
#define HD_PREFETCH_H

#include "dynamics/hard/prediction.h"

/** The queue has gone on from bucket `from`: where the state does not fit into the cache, asks for
 * what the events of the buckets ahead will touch. Changes no result. */
void hd_prefetch_ahead(const hd_motion *m, int32_t from);

#endif
