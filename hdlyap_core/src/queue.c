/** Predictions -> the next event. See queue.h for the scheme. */
#include "queue.h"

#include <stddef.h>

#include "check.h"
#include "memory.h"

enum { IN_HEAP = -1, NOWHERE = -2, BUCKETS_PER_DISK = 8 };

hd_status hd_queue_create(hd_queue *queue, int32_t disks, double horizon)
{
    const size_t n = (size_t)disks;
    *queue = (hd_queue){.disks = disks, .buckets = BUCKETS_PER_DISK * disks};
    queue->per_time = queue->buckets / horizon;
    queue->first = hd_memory_alloc((size_t)queue->buckets, sizeof *queue->first);
    queue->key = hd_memory_alloc(n, sizeof *queue->key);
    queue->place = hd_memory_alloc(n, sizeof *queue->place);
    queue->next = hd_memory_alloc(n, sizeof *queue->next);
    queue->before = hd_memory_alloc(n, sizeof *queue->before);
    queue->heap = hd_memory_alloc(n, sizeof *queue->heap);
    if (!queue->first || !queue->key || !queue->place || !queue->next || !queue->before ||
        !queue->heap)
        return HD_NO_MEMORY;
    hd_queue_restart(queue);
    return HD_OK;
}

void hd_queue_clear(hd_queue *queue)
{
    hd_memory_free(queue->first);
    hd_memory_free(queue->key);
    hd_memory_free(queue->place);
    hd_memory_free(queue->next);
    hd_memory_free(queue->before);
    hd_memory_free(queue->heap);
    *queue = (hd_queue){0};
}

void hd_queue_restart(hd_queue *queue)
{
    queue->now = 0;
    queue->heap_count = 0;
    for (int32_t b = 0; b < queue->buckets; b++) queue->first[b] = -1;
    for (int32_t i = 0; i < queue->disks; i++) queue->place[i] = NOWHERE;
}

static bool earlier(const hd_queue_key *a, const hd_queue_key *b)
{
    if (a->t != b->t) return a->t < b->t;
    if (a->kind != b->kind) return a->kind < b->kind;
    if (a->i != b->i) return a->i < b->i;
    return a->j < b->j;
}

static void heap_set(hd_queue *queue, int32_t position, int32_t disk)
{
    queue->heap[position] = disk;
    queue->before[disk] = position;
}

/** Returns where the disk came to rest. */
static int32_t heap_up(hd_queue *queue, int32_t position, int32_t disk)
{
    while (position > 0) {
        const int32_t parent = (position - 1) / 2;
        if (!earlier(&queue->key[disk], &queue->key[queue->heap[parent]])) break;
        heap_set(queue, position, queue->heap[parent]);
        position = parent;
    }
    heap_set(queue, position, disk);
    return position;
}

static void heap_down(hd_queue *queue, int32_t position, int32_t disk)
{
    for (int32_t child; (child = 2 * position + 1) < queue->heap_count; position = child) {
        if (child + 1 < queue->heap_count &&
            earlier(&queue->key[queue->heap[child + 1]], &queue->key[queue->heap[child]]))
            child++;
        if (!earlier(&queue->key[queue->heap[child]], &queue->key[disk])) break;
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
    queue->place[disk] = IN_HEAP;
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
    queue->place[disk] = bucket;
    queue->next[disk] = old;
    queue->before[disk] = -1;
    if (old >= 0) queue->before[old] = disk;
    queue->first[bucket] = disk;
}

static void bucket_remove(hd_queue *queue, int32_t disk)
{
    const int32_t before = queue->before[disk], after = queue->next[disk];
    if (before >= 0) queue->next[before] = after;
    else queue->first[queue->place[disk]] = after;
    if (after >= 0) queue->before[after] = before;
}

/** Bucket of a time; `buckets` from the horizon on. */
static int32_t bucket_of(const hd_queue *queue, double t)
{
    const double b = t * queue->per_time;
    if (!(b < queue->buckets)) return queue->buckets;
    return b > queue->now ? (int32_t)b : queue->now;
}

void hd_queue_put(hd_queue *queue, int32_t disk, hd_queue_key key)
{
    const int32_t bucket = bucket_of(queue, key.t);
    const int32_t place = queue->place[disk];
    if (place == IN_HEAP && bucket == queue->now) {
        queue->key[disk] = key;
        heap_place(queue, queue->before[disk], disk);
        return;
    }
    if (place == IN_HEAP) heap_remove(queue, queue->before[disk]);
    if (place >= 0) bucket_remove(queue, disk);
    queue->key[disk] = key;
    queue->place[disk] = NOWHERE;
    if (bucket == queue->now) heap_add(queue, disk);
    else if (bucket < queue->buckets) bucket_add(queue, bucket, disk);
}

int32_t hd_queue_next(hd_queue *queue)
{
    while (queue->heap_count == 0) {
        if (queue->now + 1 >= queue->buckets) return -1;
        for (int32_t disk = queue->first[++queue->now], after; disk >= 0; disk = after) {
            after = queue->next[disk];
            heap_add(queue, disk);
        }
        queue->first[queue->now] = -1;
    }
    return queue->heap[0];
}
