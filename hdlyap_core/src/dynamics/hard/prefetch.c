/** Fetches what the next events will touch into the cache. Each event goes through five steps, and
 * each step finds its addresses in what the step before has fetched: entry; disk; cells and
 * partner; disks in the cells and the partner's cells; disks in the partner's cells. The steps are
 * spread over the buckets before that of the event, so that no step waits for memory. Runs in one
 * thread. */
#include "dynamics/hard/prefetch.h"

/** With at least this many disks the state outgrows the second-level cache, and fetching pays. */
enum { FETCH_DISKS = 16000 };

/** Buckets between one step and the next. They have about two events, which take longer than memory
 * does. */
enum { FETCH_STEP = 2 };

/** GCC thinks that a function that only fetches has no effect, and drops calls of it unless it is
 * inlined. */
#define FETCHES inline __attribute__((always_inline))

/** Fetches the rows of cells around a disk. */
static FETCHES void fetch_cells(const hd_cells *cells, const hd_disk *disk)
{
    for (int k = 1; k < HD_CELLS_AROUND; k += 3) { /* the cells in the disk's column */
        const hd_cell *cell = hd_cells_near(cells, disk, k);
        __builtin_prefetch(cell - (disk->cell[0] > 0));
        __builtin_prefetch(cell + 1);
    }
}

/** Fetches the first disk of each cell around, of a mixture, whose cells are as wide as its larger
 * disks, two; without checking whether they are there. */
static FETCHES void fetch_nearby(const hd_motion *m, const hd_disk *disk)
{
    for (int k = 0; k < HD_CELLS_AROUND; k++) {
        const hd_cell *cell = hd_cells_near(&m->cells, disk, k);
        __builtin_prefetch(&m->disk[cell->disk[0]]);
        if (HD_MIXED) __builtin_prefetch(&m->disk[cell->disk[1]]);
    }
}

static FETCHES void fetch_disk(const hd_motion *m, int32_t i)
{
    __builtin_prefetch(&m->disk[i]);
    __builtin_prefetch(&m->predicted[i]);
    __builtin_prefetch(&m->queue.entry[i]);
}

/** Does the next step for the events in five of the buckets ahead. */
static FETCHES void fetch_steps(const hd_motion *m, int32_t bucket)
{
    const hd_queue_entry *entry = m->queue.entry;
    __builtin_prefetch(&entry[hd_queue_bucket(&m->queue, bucket + 5 * FETCH_STEP)]);
    int32_t i = hd_queue_bucket(&m->queue, bucket + 4 * FETCH_STEP);
    for (; i >= 0; i = entry[i].next) fetch_disk(m, i);
    i = hd_queue_bucket(&m->queue, bucket + 3 * FETCH_STEP);
    for (; i >= 0; i = entry[i].next) {
        fetch_cells(&m->cells, &m->disk[i]);
        if (m->predicted[i].partner >= 0) fetch_disk(m, m->predicted[i].partner);
    }
    i = hd_queue_bucket(&m->queue, bucket + 2 * FETCH_STEP);
    for (; i >= 0; i = entry[i].next) {
        const int32_t j = m->predicted[i].partner;
        fetch_nearby(m, &m->disk[i]);
        if (j >= 0) fetch_cells(&m->cells, &m->disk[j]);
    }
    i = hd_queue_bucket(&m->queue, bucket + FETCH_STEP);
    for (; i >= 0; i = entry[i].next)
        if (m->predicted[i].partner >= 0) fetch_nearby(m, &m->disk[m->predicted[i].partner]);
}

void hd_prefetch_ahead(const hd_motion *m, int32_t from)
{
    if (m->count < FETCH_DISKS) return;
    for (int32_t bucket = from + 1; bucket <= m->queue.now; bucket++) fetch_steps(m, bucket);
}
