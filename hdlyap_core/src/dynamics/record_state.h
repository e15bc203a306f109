/** The members of a record, for the dynamics that write it. */
#ifndef HD_RECORD_STATE_H
#define HD_RECORD_STATE_H

#include "dynamics/record.h"

/** Entries for which a new record has room. */
enum { HD_RECORD_FIRST = 4096 };

struct hd_record {
    void *entry; /**< [count] */
    size_t size; /**< bytes of an entry */
    size_t count, capacity;
    double duration; /**< [time units] */
};

/** Makes room for at least `count` entries in all; it at least doubles when it grows. Fails with
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_reserve(hd_record *record, size_t count);

#endif
