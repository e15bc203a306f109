/** Which disk has the next event. Events wait in buckets of time, which cover one epoch; a heap
 * sorts the present bucket. A change costs O(1), whatever the number of disks (G. Paul, J. Comput.
 * Phys. 221, 615 (2007)). */
#ifndef HD_QUEUE_H
#define HD_QUEUE_H

#include "dynamics/hard/compiled.h"
#include "hdlyap/scene.h"

#include <stdbool.h>
#include <stdint.h>

/** Events are ordered by time, then by kind, then by their disks. */
typedef struct hd_queue_key {
    double t;
    uint64_t order; /**< hd_queue_order */
} hd_queue_key;

/** One number that sorts like kind (< 4), then i (>= 0), then j (>= -HD_DIM). */
static inline uint64_t hd_queue_order(int32_t kind, int32_t i, int32_t j)
{
    return (uint64_t)kind << 62 | (uint64_t)i << 31 | (uint64_t)(j + HD_DIM);
}

static inline int32_t hd_queue_kind(uint64_t order) { return (int32_t)(order >> 62); }
static inline int32_t hd_queue_i(uint64_t order) { return (int32_t)(order >> 31 & INT32_MAX); }
static inline int32_t hd_queue_j(uint64_t order) { return (int32_t)(order & INT32_MAX) - HD_DIM; }

/** The event of a disk, and where it waits. It fills half a cache line. */
typedef struct hd_queue_entry {
    hd_queue_key key;
    int32_t place;        /**< bucket, or HD_QUEUE_HEAP, HD_QUEUE_NOWHERE */
    int32_t next, before; /**< neighbours in the bucket; in the heap, before is the position */
} hd_queue_entry;

enum { HD_QUEUE_HEAP = -1, HD_QUEUE_NOWHERE = -2 };

typedef struct hd_queue {
    double per_time; /**< buckets per time unit */
    int32_t buckets, now;
    int32_t *first;        /**< [buckets]: first disk in a bucket after the present one, or -1 */
    hd_queue_entry *entry; /**< [disks]; entry[-1] may be written, but is never read */
    hd_queue_entry *block; /**< the memory in which `entry` lies */
    int32_t *heap;         /**< [heap_count], at most `disks`: the disks in the present bucket */
    int32_t heap_count, disks;
} hd_queue;

/** Creates an empty queue for events in [0, horizon). Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_queue_create(hd_queue *queue, int32_t disks, double horizon);
void hd_queue_clear(hd_queue *queue);

/** Goes back to time 0 and forgets all events. */
void hd_queue_restart(hd_queue *queue);

/** Sets the event of a disk, which replaces the one before. An event at or after the horizon is
 * forgotten. */
void hd_queue_put(hd_queue *queue, int32_t disk, hd_queue_key key);

/** The disk with the next event, or -1 if no event is left before the horizon. */
int32_t hd_queue_next(hd_queue *queue);

/** The first disk of a bucket after the present one, or -1; entry[].next leads to the others. */
static inline int32_t hd_queue_bucket(const hd_queue *queue, int32_t bucket)
{
    return bucket < queue->buckets ? queue->first[bucket] : -1;
}

#endif
