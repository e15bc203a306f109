/** Which disk has the next event: buckets of time for one epoch, a heap for the present bucket.
 * Cost per change O(1), whatever the number of disks (G. Paul, J. Comput. Phys. 221, 615 (2007)).
 */
#ifndef HD_QUEUE_H
#define HD_QUEUE_H

#include "dynamics/hard/compiled.h"
#include "hdlyap/scene.h"

#include <stdbool.h>
#include <stdint.h>

/** Total order of events: by time, then kind, then the disks. */
typedef struct hd_queue_key {
    double t;
    uint64_t order; /**< hd_queue_order */
} hd_queue_key;

/** Kind (< 4), i (>= 0) and j (>= -HD_DIM) as one number that sorts like the three. */
static inline uint64_t hd_queue_order(int32_t kind, int32_t i, int32_t j)
{
    return (uint64_t)kind << 62 | (uint64_t)i << 31 | (uint64_t)(j + HD_DIM);
}

static inline int32_t hd_queue_kind(uint64_t order) { return (int32_t)(order >> 62); }
static inline int32_t hd_queue_i(uint64_t order) { return (int32_t)(order >> 31 & INT32_MAX); }
static inline int32_t hd_queue_j(uint64_t order) { return (int32_t)(order & INT32_MAX) - HD_DIM; }

/** One disk's event and where it waits; half a cache line. */
typedef struct hd_queue_entry {
    hd_queue_key key;
    int32_t place;        /**< bucket, or HD_QUEUE_HEAP, HD_QUEUE_NOWHERE */
    int32_t next, before; /**< neighbours in the bucket; before = position in the heap */
} hd_queue_entry;

enum { HD_QUEUE_HEAP = -1, HD_QUEUE_NOWHERE = -2 };

typedef struct hd_queue {
    double per_time; /**< buckets per time unit */
    int32_t buckets, now;
    int32_t *first;        /**< [buckets], first disk in a later bucket or -1 */
    hd_queue_entry *entry; /**< [disks]; entry[-1] may be written, and means nothing */
    hd_queue_entry *block; /**< where `entry` lies */
    int32_t *heap;         /**< [heap_count] of at most `disks`: the present bucket */
    int32_t heap_count, disks;
} hd_queue;

/** For events in [0, horizon). */
HD_MUST_CHECK hd_status hd_queue_create(hd_queue *queue, int32_t disks, double horizon);
void hd_queue_clear(hd_queue *queue);

/** Back to time 0, no events. */
void hd_queue_restart(hd_queue *queue);

/** Sets the one event of a disk; from the horizon on it is forgotten. */
void hd_queue_put(hd_queue *queue, int32_t disk, hd_queue_key key);

/** Disk with the next event, or -1 if none is left before the horizon. */
int32_t hd_queue_next(hd_queue *queue);

/** First disk of a later bucket than the present one, or -1; then entry[].next. */
static inline int32_t hd_queue_bucket(const hd_queue *queue, int32_t bucket)
{
    return bucket < queue->buckets ? queue->first[bucket] : -1;
}

#endif
