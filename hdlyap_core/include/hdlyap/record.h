/** What happened to the particles since some moment: entries in the order of their times, each
 * self-contained. Only the dynamics that wrote an entry knows what it holds; everybody else knows
 * that all of one record have the same size and begin with their time. Everything behind the
 * dynamics is a function of the record alone. */
#ifndef HDLYAP_RECORD_H
#define HDLYAP_RECORD_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_record hd_record;

double hd_record_duration(const hd_record *record); /**< time units that it covers */
size_t hd_record_count(const hd_record *record);
/** Entry k: its first double is its time since the start of the record. */
const void *hd_record_entry(const hd_record *record, size_t k);

/** Entries first .. end - 1. */
typedef struct hd_entries {
    size_t first, end;
} hd_entries;

/** Those with t_begin <= t < t_end; up to the end of the record those at that very time, too. Cost
 * O(log count). */
hd_entries hd_record_within(const hd_record *record, double t_begin, double t_end);

/** Adds an entry, which is copied, at the end. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_put(hd_record *record, const void *entry);
/** The record covers so many time units. */
void hd_record_end(hd_record *record, double duration);

HD_API_END
#endif
