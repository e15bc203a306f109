/** Queue -> cache. The addresses are found in steps, each in what the step before has fetched:
 * entry, disk, cells and partner, the disks in the cells. An event takes them while the queue goes
 * through the buckets before its own, so that nothing is waited for. One thread. */
#include "dynamics/hard/prefetch.h"

/** From so many disks on the state outgrows the second-level cache, and this pays. */
enum { FETCH_DISKS = 16000 };

/** Buckets, of about two events, from one step to the next: longer than memory takes. */
enum { FETCH_STEP = 2 };

/** GCC takes a function that only fetches for one without effect, and drops calls of it. */
#define FETCHES inline __attribute__((always_inline))

/** The rows of cells around a disk. */
static FETCHES void fetch_cells(const hd_cells *cells, const hd_disk *disk)
{
    for (int k = 1; k < HD_CELLS_AROUND; k += 3) { /* its own column */
        const hd_cell *cell = hd_cells_near(cells, disk, k);
        __builtin_prefetch(cell - (disk->cell[0] > 0));
        __builtin_prefetch(cell + 1);
    }
}

/** The first disk of each; without asking whether there is one. */
static FETCHES void fetch_nearby(const hd_motion *m, const hd_disk *disk)
{
    for (int k = 0; k < HD_CELLS_AROUND; k++) {
        const hd_cell *cell = hd_cells_near(&m->cells, disk, k);
        __builtin_prefetch(&m->disk[cell->disk[0]]);
    }
}

static FETCHES void fetch_disk(const hd_motion *m, int32_t i)
{
    __builtin_prefetch(&m->disk[i]);
    __builtin_prefetch(&m->predicted[i]);
    __builtin_prefetch(&m->queue.entry[i]);
}

/** Takes the events of five buckets ahead one step further. */
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
