/** The record: what happened to the particles from some moment on, as entries in the order of their
 * times. The dynamics decides what has an entry: in the core each collision of hard particles, and
 * of soft ones each time step and, within it, each pair at each computation of forces. All entries
 * of a record have the same size and begin with their time; only the dynamics that wrote them knows
 * what else they hold. Tangent vectors are carried by the record alone. Times are counted from the
 * start of the record [time units]. */
#ifndef HDLYAP_RECORD_H
#define HDLYAP_RECORD_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

/** A record. That of a run belongs to the run, which empties it after each orthonormalisation;
 * hd_record_create makes one alone, to test `advance` and `carry` of a row. */
typedef struct hd_record hd_record;

/** Makes an empty record, which the caller frees with hd_record_free. entry: bytes of an entry, as
 * hd_dynamics.entry, a multiple of those of a double. Returns HD_OK or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_record_create(hd_record **out, size_t entry);
/** Frees a record, unless the pointer is NULL. */
void hd_record_free(hd_record *record);
/** Empties the record, which then begins where the particles are now. Its memory stays. */
void hd_record_clear(hd_record *record);

/** Simulated time that the record covers [time units]. */
double hd_record_duration(const hd_record *record);
/** Number of entries. */
size_t hd_record_count(const hd_record *record);
/** Entry k, 0 .. count - 1, whose first double is its time. It is valid until an entry is put. */
const void *hd_record_entry(const hd_record *record, size_t k);

/** The entries with numbers first .. end - 1. */
typedef struct hd_entries {
    size_t first, end;
} hd_entries;

/** The entries with t_begin <= time < t_end; if t_end is the end of the record, also those at
 * t_end. O(log count). */
hd_entries hd_record_within(const hd_record *record, double t_begin, double t_end);

/** Adds a copy of an entry, which must not be earlier than the last one, nor than the start.
 * Returns HD_OK; HD_NO_MEMORY; or HD_DYNAMICS_FAULT for an entry that is too early or whose time is
 * NaN: the run then fails with this status, also if the caller ignores it. */
HD_MUST_CHECK hd_status hd_record_put(hd_record *record, const void *entry);
/** Says which time the record covers [time units], from its start; hd_dynamics.advance calls this
 * last. If an entry is later, or the duration is not that of the advance, the run fails with
 * HD_DYNAMICS_FAULT. */
void hd_record_end(hd_record *record, double duration);

HD_API_END
#endif
