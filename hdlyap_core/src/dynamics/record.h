/** Functions on records that only the core calls. */
#ifndef HD_RECORD_H
#define HD_RECORD_H

#include "hdlyap/record.h"

/** Bytes of a record of so many entries. */
double hd_record_bytes(double entries, size_t entry);
/** Bytes of this many entries in a record that doubles when it is full, and of maps that take as
 * much. */
double hd_record_bytes_twice(double entries, size_t entry);

/** Entries for which a new record has room. */
enum { HD_RECORD_FIRST = 4096 };

struct hd_record {
    void *entry; /**< [count] */
    size_t size; /**< bytes of an entry */
    size_t count, capacity;
    double duration; /**< [time units] */
    /** What was wrong with a time that was told, and that time; NULL: nothing. */
    const char *fault;
    double at;
};

/** Makes room for at least `count` entries in all; it at least doubles when it grows. Fails with
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_reserve(hd_record *record, size_t count);

#endif
