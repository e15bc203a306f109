/** Orthonormalisations, one after the other -> triangles and snapshots, for the way back.
 *
 * Rings: interval k is in slot k mod intervals. Triangles are kept packed. */
#include "covariant/history.h"

#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "covariant/backward.h"
#include "covariant/coupling.h"
#include "covariant/store.h"
#include "tangent/conjugate.h"

typedef struct interval_kept {
    double time, length;
    long snapshot; /**< its number; -1: none */
} interval_kept;

struct hd_history {
    hd_history_def def;
    int rows;
    interval_kept *kept; /**< [def.intervals] */
    hd_store *triangles, *snapshots;
    hd_coupling *coupling; /**< NULL where all vectors are carried */
    long first, end, snapshots_end;
    double time;
};

static int rows_of(const hd_history_def *def) { return 2 * def->of->coordinates * def->particles; }

static size_t snapshot_size(const hd_history_def *def)
{
    return (size_t)rows_of(def) * ((size_t)def->vectors + 1);
}

/** Entries that R takes, or R and Y. */
static size_t triangle_size(const hd_history_def *def)
{
    return (def->conjugate ? 2 : 1) * hd_triangle_size(def->vectors);
}

double hd_history_bytes(const hd_history_def *def)
{
    const double coupling = def->conjugate ? hd_coupling_bytes(def->of, rows_of(def), def->threads)
                                           : 0.0;
    return hd_store_bytes(snapshot_size(def), def->snapshots) +
           hd_store_bytes(triangle_size(def), def->intervals) + coupling +
           (double)def->intervals * sizeof(interval_kept);
}

static hd_status allocate(hd_history *past, const hd_scene_def *scene)
{
    const hd_history_def *def = &past->def;
    past->kept = hd_memory_alloc((size_t)def->intervals, sizeof *past->kept);
    if (!past->kept) return HD_NO_MEMORY;
    HD_TRY(hd_store_create(&past->snapshots, snapshot_size(def), def->snapshots));
    if (def->conjugate) HD_TRY(hd_coupling_create(&past->coupling, scene, def->threads));
    return hd_store_create(&past->triangles, triangle_size(def), def->intervals);
}

hd_status hd_history_create(hd_history **out, const hd_history_def *def, const hd_scene_def *scene)
{
    HD_ASSERT(def->intervals >= 2 && def->snapshots >= 1);
    hd_history *past = hd_memory_alloc(1, sizeof *past);
    *out = NULL;
    if (!past) return HD_NO_MEMORY;
    past->def = *def;
    past->rows = rows_of(def);
    const hd_status status = allocate(past, scene);
    if (status == HD_OK)
        *out = past;
    else
        hd_history_free(past);
    return status;
}

void hd_history_free(hd_history *past)
{
    if (!past) return;
    hd_memory_free(past->kept);
    hd_store_free(past->triangles);
    hd_store_free(past->snapshots);
    hd_coupling_free(past->coupling);
    hd_memory_free(past);
}

/* ---- forward ------------------------------------------------------------------------------- */

static interval_kept *kept_at(const hd_history *past, long interval)
{
    HD_ASSERT(interval >= past->first && interval < past->end);
    return &past->kept[interval % past->def.intervals];
}

void hd_history_begin(hd_history *past, double time)
{
    past->first = past->end = past->snapshots_end = 0;
    past->time = time;
}

bool hd_history_is_full(const hd_history *past)
{
    return past->end - past->first >= past->def.intervals;
}

static hd_status keep_triangle(hd_history *past, const double *factor, long slot)
{
    double *triangle = hd_store_put(past->triangles, slot);
    if (!triangle) return HD_NO_MEMORY;
    hd_triangle_pack(triangle, factor, past->def.vectors);
    if (past->coupling)
        hd_triangle_pack(triangle + hd_triangle_size(past->def.vectors),
                         hd_coupling_read(past->coupling), past->def.vectors);
    return HD_OK;
}

hd_status hd_history_add(hd_history *past, const double *factor, const hd_frame *frame,
                         const hd_record *record, double t_begin, double t_end)
{
    HD_ASSERT(!hd_history_is_full(past));
    const long slot = past->end % past->def.intervals;
    if (past->coupling)
        HD_TRY(hd_coupling_measure(past->coupling, frame, factor, record, t_begin, t_end));
    HD_TRY(keep_triangle(past, factor, slot));
    past->time += t_end - t_begin;
    past->kept[slot] = (interval_kept){past->time, t_end - t_begin, -1};
    past->end++;
    return HD_OK;
}

hd_status hd_history_snapshot(hd_history *past, hd_columns frame, const double *q, const double *p)
{
    const size_t n = (size_t)past->def.vectors, rows = (size_t)past->rows, half = rows / 2;
    const long record = past->snapshots_end % past->def.snapshots;
    double *kept = hd_store_put(past->snapshots, record);
    if (!kept) return HD_NO_MEMORY;
    for (size_t row = 0; row < rows; row++)
        memcpy(kept + row * n, frame.data + row * (size_t)frame.stride, n * sizeof(double));
    memcpy(kept + rows * n, q, half * sizeof *q);
    memcpy(kept + rows * n + half, p, half * sizeof *p);
    kept_at(past, past->end - 1)->snapshot = record;
    past->snapshots_end++;
    return HD_OK;
}

void hd_history_drop(hd_history *past, double time)
{
    while (past->first < past->end && kept_at(past, past->first)->time <= time) past->first++;
}

/* ---- what is there ------------------------------------------------------------------------- */

long hd_history_first(const hd_history *past) { return past->first; }
long hd_history_end(const hd_history *past) { return past->end; }
double hd_history_time(const hd_history *past, long interval)
{
    return kept_at(past, interval)->time;
}
double hd_history_length(const hd_history *past, long interval)
{
    return kept_at(past, interval)->length;
}
bool hd_history_has_snapshot(const hd_history *past, long interval)
{
    return kept_at(past, interval)->snapshot >= 0;
}

void hd_history_factor(const hd_history *past, double *factor, double *coupling, long interval)
{
    const long slot = kept_at(past, interval) - past->kept;
    const double *triangle = hd_store_fetch(past->triangles, slot);
    hd_triangle_unpack(factor, triangle, past->def.vectors);
    if (past->coupling)
        hd_triangle_unpack(coupling, triangle + hd_triangle_size(past->def.vectors),
                           past->def.vectors);
}

void hd_history_vectors(const hd_history *past, double *vectors, double *q, double *p,
                        long interval)
{
    const size_t n = (size_t)past->def.vectors, rows = (size_t)past->rows, half = rows / 2;
    const long record = kept_at(past, interval)->snapshot;
    HD_ASSERT(record >= 0);
    const double *kept = hd_store_fetch(past->snapshots, record);
    if (past->def.conjugate)
        hd_conjugate_fill(vectors, (hd_columns){kept, (int)n, 0, (int)n}, past->rows,
                          past->def.of->coordinates);
    else
        memcpy(vectors, kept, rows * n * sizeof *vectors);
    memcpy(q, kept + rows * n, half * sizeof *q);
    memcpy(p, kept + rows * n + half, half * sizeof *p);
}
