/** (frame at the start of a stretch, events since) -> the triangles of the stretch.
 *
 * Frame, events and cuts are the same as in the forward pass, so triangles are the same to
 * rounding, and the way through a stretch ends at the next frame that was kept. */
#include "covariant/recompute.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "covariant/backward.h"
#include "covariant/coupling.h"
#include "covariant/store.h"
#include "tangent/frame.h"
#include "tangent/interval.h"
#include "tangent/ortho.h"

/** The largest condition that the forward pass accepts. */
static const hd_ortho_limits LIMITS = {HD_CONDITION_MAX, 1e-6, HD_NORM_FULL};
/** Orthonormal to rounding, because Y needs both ends to be so [T18]. */
static const hd_ortho_limits LIMITS_COUPLED = {HD_CONDITION_MAX, 1e-12, HD_NORM_FULL};

/** Events of a chunk of the ring; and chunks beyond a full ring, for an interval that begins before
 * the ring is full. */
enum { CHUNK = 256, CHUNKS_BEYOND = 4 };

/** Where a slot's events are in the ring. */
typedef struct stored {
    uint64_t first, end;
    double duration;
} stored;

struct hd_recompute {
    hd_recompute_def def;
    hd_store *frames;    /**< of the first slot of each stretch */
    hd_store *triangles; /**< packed, of one stretch */
    long from, to;       /**< triangles of slots from <= slot < to are there */
    hd_store *events;    /**< a ring of chunks: event k is in chunk k / CHUNK, mod chunks */
    stored *stored;      /**< [slots] */
    uint64_t tail, head; /**< events from tail on, before head, are there */
    long next;           /**< slot that is to be written */
    hd_record *record;   /**< of the slot that is replayed */
    hd_frame *frame;
    hd_ortho *ortho;
    hd_coupling *coupling; /**< NULL where all vectors are carried */
};

long hd_recompute_stretch(long slots, int rows, int vectors)
{
    const double stretch = sqrt(2.0 * (double)slots * rows / (vectors + 1.0));
    return (long)fmax(1.0, fmin(round(stretch), (double)slots));
}

/** Entries that R takes, or R and Y. */
static size_t triangle_size(const hd_recompute_def *def)
{
    return (def->conjugate ? 2 : 1) * hd_triangle_size(def->vectors);
}

/** Chunks of the ring. Up to twice an average interval's events may come before it counts as full.
 */
static long chunks_of(const hd_recompute_def *def)
{
    const double of_slot = def->events / (double)def->slots;
    return (long)ceil((def->events + 2.0 * of_slot) / CHUNK) + CHUNKS_BEYOND;
}

static size_t chunk_doubles(const hd_recompute_def *def)
{
    return CHUNK * def->of->entry / sizeof(double);
}

static size_t frame_of(const hd_recompute_def *def)
{
    return (size_t)def->rows * (size_t)def->vectors;
}

double hd_recompute_bytes(const hd_recompute_def *def)
{
    const double kept = hd_store_bytes(frame_of(def), def->slots / def->stretch) +
                        hd_store_bytes(triangle_size(def), def->stretch);
    const double coupling = def->conjugate ? hd_coupling_bytes(def->of, def->rows, def->threads)
                                           : 0;
    const double replayed = hd_frame_bytes(def->of, def->rows, def->vectors, def->threads) +
                            hd_ortho_bytes(def->rows, def->vectors, 1) +
                            2.0 * sizeof(double) * def->vectors * def->vectors + /* its factors */
                            coupling;
    const double record = hd_record_bytes(2.0 * def->events / (double)def->slots, def->of->entry);
    return kept + replayed + hd_store_bytes(chunk_doubles(def), chunks_of(def)) +
           (double)def->slots * sizeof(stored) + record;
}

static hd_status allocate(hd_recompute *r)
{
    const hd_recompute_def *def = &r->def;
    const size_t triangle = triangle_size(def);
    const int particles = def->rows / (2 * def->of->coordinates);
    if (def->conjugate) HD_TRY(hd_coupling_create(&r->coupling, def->of, particles, def->threads));
    HD_TRY(hd_store_create(&r->frames, frame_of(def), def->slots / def->stretch));
    HD_TRY(hd_store_create(&r->triangles, triangle, def->stretch));
    HD_TRY(hd_frame_create(&r->frame, def->of, particles, def->vectors, 1, def->threads));
    HD_TRY(hd_ortho_create(&r->ortho, def->rows, def->vectors));
    HD_TRY(hd_ortho_keep_factor(r->ortho));
    HD_TRY(hd_store_create(&r->events, chunk_doubles(def), chunks_of(def)));
    HD_TRY(hd_record_create(&r->record, def->of->entry));
    r->stored = hd_memory_alloc((size_t)def->slots, sizeof *r->stored);
    return r->stored ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_recompute_create(hd_recompute **out, const hd_recompute_def *def)
{
    HD_ASSERT(def->stretch >= 1 && def->slots % def->stretch == 0);
    hd_recompute *r = hd_memory_alloc(1, sizeof *r);
    *out = NULL;
    if (!r) return HD_NO_MEMORY;
    r->def = *def;
    const hd_status status = allocate(r);
    if (status == HD_OK)
        *out = r;
    else
        hd_recompute_free(r);
    return status;
}

void hd_recompute_free(hd_recompute *r)
{
    if (!r) return;
    hd_record_free(r->record);
    hd_memory_free(r->stored);
    hd_store_free(r->events);
    hd_store_free(r->frames);
    hd_store_free(r->triangles);
    hd_frame_free(r->frame);
    hd_ortho_free(r->ortho);
    hd_coupling_free(r->coupling);
    hd_memory_free(r);
}

/* ---- forward ------------------------------------------------------------------------------- */

bool hd_recompute_keeps(const hd_recompute *r, long slot) { return slot % r->def.stretch == 0; }

hd_status hd_recompute_frame(hd_recompute *r, long slot, hd_columns columns)
{
    if (!hd_recompute_keeps(r, slot)) return HD_OK;
    HD_ASSERT(columns.count == r->def.vectors);
    double *vectors = hd_store_put(r->frames, slot / r->def.stretch);
    if (!vectors) return HD_NO_MEMORY;
    for (int row = 0; row < r->def.rows; row++)
        memcpy(vectors + (size_t)row * (size_t)r->def.vectors,
               columns.data + (size_t)row * (size_t)columns.stride,
               (size_t)r->def.vectors * sizeof(double));
    return HD_OK;
}

/** The place of an event in the ring; NULL without memory. */
static double *place(hd_recompute *r, uint64_t event)
{
    const uint64_t chunks = (uint64_t)chunks_of(&r->def);
    double *chunk = hd_store_put(r->events, (long)(event / CHUNK % chunks));
    return chunk ? chunk + event % CHUNK * (r->def.of->entry / sizeof(double)) : NULL;
}

/** Turns to a slot and forgets what it held; if it does not follow the slot before it, forgets all.
 */
static void turn_to(hd_recompute *r, long slot)
{
    const uint64_t before = r->stored[slot].end;
    if (slot >= r->from && slot < r->to) r->from = r->to = 0; /* written anew */
    if (slot != r->next) {
        memset(r->stored, 0, (size_t)r->def.slots * sizeof *r->stored);
        r->tail = r->head = 0;
    } else if (before > r->tail) {
        r->tail = before;
    }
    r->next = (slot + 1) % r->def.slots;
}

bool hd_recompute_is_full(const hd_recompute *r)
{
    return (double)(r->head - r->tail) > r->def.events;
}

double hd_recompute_events_kept(const hd_recompute *r) { return (double)(r->head - r->tail); }

void hd_recompute_forget(hd_recompute *r, long slot)
{
    const long first = slot / r->def.stretch * r->def.stretch;
    if (r->stored[first].first > r->tail) r->tail = r->stored[first].first;
}

hd_status hd_recompute_events(hd_recompute *r, long slot, const hd_record *record, double t_begin,
                              double t_end)
{
    const uint64_t most = CHUNK * (uint64_t)chunks_of(&r->def);
    turn_to(r, slot);
    r->stored[slot].first = r->head;
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    for (size_t k = those.first; k < those.end; k++) {
        if (r->head - r->tail == most) return HD_NO_ROOM;
        double *event = place(r, r->head);
        if (!event) return HD_NO_MEMORY;
        memcpy(event, hd_record_entry(record, k), r->def.of->entry);
        *event -= t_begin; /* its time */
        r->head++;
    }
    r->stored[slot].end = r->head;
    r->stored[slot].duration = t_end - t_begin;
    return HD_OK;
}

/* ---- backward ------------------------------------------------------------------------------ */

static void load_frame(hd_recompute *r, const double *vectors)
{
    for (int row = 0; row < r->def.rows; row++)
        memcpy(hd_frame_data(r->frame) + (size_t)row * (size_t)hd_frame_stride(r->frame),
               vectors + (size_t)row * (size_t)r->def.vectors,
               (size_t)r->def.vectors * sizeof(double));
}

/** Copies a slot's events into the record. */
static hd_status load_record(hd_recompute *r, long slot)
{
    const stored *kept = &r->stored[slot];
    HD_ASSERT(kept->first >= r->tail);
    hd_record_clear(r->record);
    for (uint64_t k = kept->first; k < kept->end; k++)
        HD_TRY(hd_record_put(r->record, place(r, k)));
    hd_record_end(r->record, kept->duration);
    return HD_OK;
}

static hd_status recompute_slot(hd_recompute *r, long slot)
{
    HD_TRY(load_record(r, slot));
    const hd_record *record = r->record;
    const double duration = hd_record_duration(record);
    const hd_ortho_limits limits = r->coupling ? LIMITS_COUPLED : LIMITS;
    HD_TRY(hd_frame_replay(r->frame, record, 0.0, duration));
    if (hd_ortho_step(r->ortho, r->frame, limits) == HD_ILL_CONDITIONED) {
        hd_frame_rewind(r->frame);
        HD_TRY(hd_frame_replay(r->frame, record, 0.0, duration));
        HD_TRY(hd_ortho_step_stable(r->ortho, r->frame, 1.0 / DBL_EPSILON));
    }
    double *triangle = hd_store_put(r->triangles, slot % r->def.stretch);
    if (!triangle) return HD_NO_MEMORY;
    const double *factor = hd_ortho_factor(r->ortho);
    hd_triangle_pack(triangle, factor, r->def.vectors);
    if (!r->coupling) return HD_OK;
    HD_TRY(hd_coupling_measure(r->coupling, r->frame, factor, record, 0.0, duration));
    hd_triangle_pack(triangle + hd_triangle_size(r->def.vectors), hd_coupling_read(r->coupling),
                     r->def.vectors);
    return HD_OK;
}

static hd_status recompute_stretch(hd_recompute *r, long slot, long last)
{
    const long first = slot / r->def.stretch * r->def.stretch;
    const long end = last < first + r->def.stretch ? last + 1 : first + r->def.stretch;
    r->from = r->to = 0;
    load_frame(r, hd_store_fetch(r->frames, first / r->def.stretch));
    for (long k = first; k < end; k++) HD_TRY(recompute_slot(r, k));
    r->from = first;
    r->to = end;
    return HD_OK;
}

hd_status hd_recompute_factor(hd_recompute *r, double *factor, double *coupling, long slot,
                              long last)
{
    HD_ASSERT(slot >= 0 && slot <= last && last < r->def.slots);
    if (slot < r->from || slot >= r->to) HD_TRY(recompute_stretch(r, slot, last));
    const double *triangle = hd_store_fetch(r->triangles, slot % r->def.stretch);
    hd_triangle_unpack(factor, triangle, r->def.vectors);
    if (r->coupling)
        hd_triangle_unpack(coupling, triangle + hd_triangle_size(r->def.vectors), r->def.vectors);
    return HD_OK;
}
