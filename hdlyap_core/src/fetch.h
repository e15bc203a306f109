/** What the next events will touch, fetched in time. */
#ifndef HD_FETCH_H
#define HD_FETCH_H

#include "prediction.h"

/** The queue has gone on from bucket `from`: where the state does not fit into the cache, asks for
 * what the events of the buckets ahead will touch. Changes no result. */
void hd_fetch_ahead(const hd_trajectory *tr, int32_t from);

#endif
