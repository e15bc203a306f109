/** Predictions -> the next event. See queue.h for the scheme. */
#include "dynamics/hard/queue.h"

#include <stddef.h>

#include "base/check.h"
#include "base/memory.h"

/** With this many buckets each holds less than about one event, so the heap has almost nothing to
 * sort. */
enum { BUCKETS_PER_DISK = 16 };

/** Entries before the first: entry[-1] stands for a neighbour that does not exist, and is written
 * to without a check. There are two, so that each other entry stays in half a cache line. */
enum { NOBODY = 2 };

hd_status hd_queue_create(hd_queue *queue, int32_t disks, double horizon)
{
    const size_t n = (size_t)disks;
    *queue = (hd_queue){.disks = disks, .buckets = BUCKETS_PER_DISK * disks};
    queue->per_time = queue->buckets / horizon;
    queue->first = hd_memory_alloc((size_t)queue->buckets, sizeof *queue->first);
    queue->block = hd_memory_alloc(n + NOBODY, sizeof *queue->block);
    queue->heap = hd_memory_alloc(n, sizeof *queue->heap);
    if (!queue->first || !queue->block || !queue->heap) return HD_NO_MEMORY;
    queue->entry = queue->block + NOBODY;
    hd_queue_restart(queue);
    return HD_OK;
}

void hd_queue_clear(hd_queue *queue)
{
    hd_memory_free(queue->first);
    hd_memory_free(queue->block);
    hd_memory_free(queue->heap);
    *queue = (hd_queue){0};
}

void hd_queue_restart(hd_queue *queue)
{
    queue->now = 0;
    queue->heap_count = 0;
    for (int32_t b = 0; b < queue->buckets; b++) queue->first[b] = -1;
    for (int32_t i = 0; i < queue->disks; i++) queue->entry[i].place = HD_QUEUE_NOWHERE;
}

static bool earlier(const hd_queue_key *a, const hd_queue_key *b)
{
    return a->t < b->t || (a->t == b->t && a->order < b->order);
}

static void heap_set(hd_queue *queue, int32_t position, int32_t disk)
{
    queue->heap[position] = disk;
    queue->entry[disk].before = position;
}

/** Moves the disk up the heap from a position. Returns where it ends. */
static int32_t heap_up(hd_queue *queue, int32_t position, int32_t disk)
{
    while (position > 0) {
        const int32_t parent = (position - 1) / 2;
        if (!earlier(&queue->entry[disk].key, &queue->entry[queue->heap[parent]].key)) break;
        heap_set(queue, position, queue->heap[parent]);
        position = parent;
    }
    heap_set(queue, position, disk);
    return position;
}

static void heap_down(hd_queue *queue, int32_t position, int32_t disk)
{
    for (int32_t child; (child = 2 * position + 1) < queue->heap_count; position = child) {
        if (child + 1 < queue->heap_count && earlier(&queue->entry[queue->heap[child + 1]].key,
                                                     &queue->entry[queue->heap[child]].key))
            child++;
        if (!earlier(&queue->entry[queue->heap[child]].key, &queue->entry[disk].key)) break;
        heap_set(queue, position, queue->heap[child]);
    }
    heap_set(queue, position, disk);
}

static void heap_place(hd_queue *queue, int32_t position, int32_t disk)
{
    if (heap_up(queue, position, disk) == position) heap_down(queue, position, disk);
}

static void heap_add(hd_queue *queue, int32_t disk)
{
    queue->entry[disk].place = HD_QUEUE_HEAP;
    heap_up(queue, queue->heap_count++, disk);
}

static void heap_remove(hd_queue *queue, int32_t position)
{
    const int32_t last = queue->heap[--queue->heap_count];
    if (position < queue->heap_count) heap_place(queue, position, last);
}

static void bucket_add(hd_queue *queue, int32_t bucket, int32_t disk)
{
    const int32_t old = queue->first[bucket];
    queue->entry[disk].place = bucket;
    queue->entry[disk].next = old;
    queue->entry[disk].before = -1;
    queue->entry[old].before = disk;
    queue->first[bucket] = disk;
}

static void bucket_remove(hd_queue *queue, int32_t disk)
{
    const int32_t before = queue->entry[disk].before, after = queue->entry[disk].next;
    int32_t *const link[2] = {&queue->first[queue->entry[disk].place], &queue->entry[before].next};
    *link[before >= 0] = after;
    queue->entry[after].before = before;
}

/** The bucket of a time; `buckets` if it is at or after the horizon. */
static int32_t bucket_of(const hd_queue *queue, double t)
{
    const double b = t * queue->per_time;
    if (!(b < queue->buckets)) return queue->buckets;
    return b > queue->now ? (int32_t)b : queue->now;
}

void hd_queue_put(hd_queue *queue, int32_t disk, hd_queue_key key)
{
    const int32_t bucket = bucket_of(queue, key.t);
    const int32_t place = queue->entry[disk].place;
    if (place == HD_QUEUE_HEAP && bucket == queue->now) {
        queue->entry[disk].key = key;
        heap_place(queue, queue->entry[disk].before, disk);
        return;
    }
    if (place == HD_QUEUE_HEAP) heap_remove(queue, queue->entry[disk].before);
    if (place >= 0) bucket_remove(queue, disk);
    queue->entry[disk].key = key;
    queue->entry[disk].place = HD_QUEUE_NOWHERE;
    if (bucket == queue->now)
        heap_add(queue, disk);
    else if (bucket < queue->buckets)
        bucket_add(queue, bucket, disk);
}

int32_t hd_queue_next(hd_queue *queue)
{
    while (queue->heap_count == 0) {
        if (queue->now + 1 >= queue->buckets) return -1;
        for (int32_t disk = queue->first[++queue->now], after; disk >= 0; disk = after) {
            after = queue->entry[disk].next;
            heap_add(queue, disk);
        }
        queue->first[queue->now] = -1;
    }
    return queue->heap[0];
}
