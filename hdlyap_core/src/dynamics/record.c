/** Memory of a record; it only grows. */
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/record.h"

hd_status hd_record_create(hd_record **out, size_t entry)
{
    *out = hd_memory_alloc(1, sizeof **out);
    if (!*out) return HD_NO_MEMORY;
    (*out)->size = entry;
    return HD_OK;
}

double hd_record_bytes(double entries, size_t entry)
{
    return fmax(HD_RECORD_FIRST, entries) * (double)entry;
}

double hd_record_bytes_twice(double entries, size_t entry)
{
    double room = HD_RECORD_FIRST;
    while (room < 1.1 * entries) room *= 2.0;
    return 2.0 * room * (double)entry;
}

void hd_record_free(hd_record *record)
{
    if (!record) return;
    hd_memory_free(record->entry);
    hd_memory_free(record);
}

void hd_record_clear(hd_record *record)
{
    record->count = 0;
    record->duration = 0.0;
    record->fault = NULL;
}

hd_status hd_record_reserve(hd_record *record, size_t count)
{
    size_t capacity = record->capacity ? record->capacity : HD_RECORD_FIRST;
    while (capacity < count) capacity *= 2;
    if (capacity == record->capacity) return HD_OK;
    void *grown = hd_memory_alloc(capacity, record->size);
    if (!grown) return HD_NO_MEMORY;
    if (record->count) memcpy(grown, record->entry, record->count * record->size);
    hd_memory_free(record->entry);
    record->entry = grown;
    record->capacity = capacity;
    return HD_OK;
}

/** Time of the last entry; 0 if there is none. */
static inline double last_time(const hd_record *record)
{
    const char *end = (const char *)record->entry + record->count * record->size;
    return record->count > 0 ? *(const double *)(end - record->size) : 0.0;
}

/** Notes the first fault. */
static hd_status fail(hd_record *record, const char *fault, double at)
{
    if (!record->fault) record->at = at;
    if (!record->fault) record->fault = fault;
    return HD_DYNAMICS_FAULT;
}

hd_status hd_record_put(hd_record *record, const void *entry)
{
    const double time = *(const double *)entry;
    if (!(time >= last_time(record))) /* false for NaN */
        return fail(record, "hd_record_put: an entry is earlier than the last one, or not a number",
                    time);
    if (record->count == record->capacity) HD_TRY(hd_record_reserve(record, record->count + 1));
    memcpy((char *)record->entry + record->count++ * record->size, entry, record->size);
    return HD_OK;
}

void hd_record_end(hd_record *record, double duration)
{
    if (!(last_time(record) <= duration))
        (void)fail(record, "hd_record_end: the record ends before its last entry", duration);
    record->duration = duration;
}

double hd_record_duration(const hd_record *record) { return record->duration; }
size_t hd_record_count(const hd_record *record) { return record->count; }

const void *hd_record_entry(const hd_record *record, size_t k)
{
    return (const char *)record->entry + k * record->size;
}

/** The first entry that is not before t. */
static size_t first_from(const hd_record *record, double t)
{
    size_t low = 0, high = record->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (*(const double *)hd_record_entry(record, middle) < t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

hd_entries hd_record_within(const hd_record *record, double t_begin, double t_end)
{
    const size_t end = t_end >= record->duration ? record->count : first_from(record, t_end);
    return (hd_entries){first_from(record, t_begin), end};
}
