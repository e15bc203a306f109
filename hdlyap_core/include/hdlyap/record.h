/** The record: what happened to the particles since some moment, as entries in the order of their
 * times, one for each collision or time step. All entries of a record have the same size and begin
 * with their time; only the dynamics that wrote them knows what else they hold. Tangent vectors are
 * carried by the record alone. */
#ifndef HDLYAP_RECORD_H
#define HDLYAP_RECORD_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_record hd_record;

/** Simulated time that it covers [time units]. */
double hd_record_duration(const hd_record *record);
size_t hd_record_count(const hd_record *record);
/** Entry k. Its first double is the time since the start of the record. */
const void *hd_record_entry(const hd_record *record, size_t k);

/** The entries first .. end - 1. */
typedef struct hd_entries {
    size_t first, end;
} hd_entries;

/** The entries with t_begin <= t < t_end; if t_end is the end of the record, also those at t_end.
 * O(log count). */
hd_entries hd_record_within(const hd_record *record, double t_begin, double t_end);

/** Adds a copy of an entry at the end. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_put(hd_record *record, const void *entry);
/** Sets the time that the record covers [time units]. */
void hd_record_end(hd_record *record, double duration);

HD_API_END
#endif
