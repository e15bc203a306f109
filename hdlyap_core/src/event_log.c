/** Storage of an interval's events; it only grows. */
#include "hdlyap/trajectory.h"

#include "memory.h"

hd_status hd_event_log_create(hd_event_log **out)
{
    *out = hd_memory_alloc(1, sizeof **out);
    return *out ? HD_OK : HD_NO_MEMORY;
}

void hd_event_log_free(hd_event_log *log)
{
    if (!log) return;
    hd_memory_free(log->event);
    hd_memory_free(log);
}

void hd_event_log_clear(hd_event_log *log)
{
    log->count = 0;
    log->duration = 0.0;
}
