/** Event log -> tangent vectors carried along.
 *
 * The log is first turned into tangent maps with all divisions done. Then each thread takes a block
 * of columns into a buffer that stays in its cache, [disk][HD_ROWS][width], carries it through all
 * maps with lazy free flight (only disks that collide are brought up to date), and writes it to the
 * second copy of V; so the vectors from before remain for hd_frame_rewind at no cost in time.
 * Maps and kernels are those of disks or of spheres [T1], [T3], [T4], [T21], [T22]. Parallel over
 * blocks; the result does not depend on the number of threads. */
#include <omp.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/multiversion.h"
#include "tangent/frame_state.h"
#if HD_DIM == 2
#include "tangent/kernel_2d.h"
#else
#include "tangent/kernel_3d.h"
#endif

/** Events that are fetched ahead, where the disks of a block outgrow the cache. */
enum { FETCH_AHEAD = 12, LINE = 64 / sizeof(double) };

/* ---- the log as tangent maps --------------------------------------------------------------- */

static double flight(double *since, int32_t disk, double t)
{
    const double tau = t - since[disk];
    since[disk] = t;
    return tau;
}

static void map_fill(hd_tangent_map *map, const hd_event *event, double *since)
{
    *map = (hd_tangent_map){.i = event->i, .j = event->j};
    map->flight[0] = flight(since, event->i, event->t);
    if (event->j >= 0) map->flight[1] = flight(since, event->j, event->t);
    hd_map_fill(map, event);
}

static hd_status maps_reserve(hd_frame *frame, size_t count)
{
    if (count <= frame->map_capacity) return HD_OK;
    hd_memory_free(frame->map);
    frame->map_capacity = count + count / 2;
    frame->map = hd_memory_alloc(frame->map_capacity, sizeof *frame->map);
    if (frame->map) return HD_OK;
    frame->map_capacity = 0;
    return HD_NO_MEMORY;
}

/** Fills frame->map and leaves each disk's last flight in frame->since; returns the number of maps.
 */
static size_t maps_fill(hd_frame *frame, const hd_event_log *log, double t_begin, double t_end)
{
    const bool last = t_end >= log->duration;
    size_t count = 0;
    frame->walls = false;
    for (int i = 0; i < frame->disks; i++) frame->since[i] = t_begin;
    for (size_t e = 0; e < log->count; e++) {
        if (log->event[e].t < t_begin) continue;
        if (log->event[e].t >= t_end && !last) break;
        frame->walls |= log->event[e].j < 0;
        map_fill(&frame->map[count++], &log->event[e], frame->since);
    }
    for (int i = 0; i < frame->disks; i++) frame->since[i] = t_end - frame->since[i];
    return count;
}

/* ---- a block of columns -------------------------------------------------------------------- */

typedef struct maps {
    const hd_tangent_map *map; /**< [count] */
    size_t count;
    size_t fetching; /**< at the first ones of them, those FETCH_AHEAD later are fetched */
} maps;

/** The rows of both disks, into the cache. A wall fetches those of i alone. */
static inline __attribute__((always_inline)) void fetch(const double *buffer,
                                                        const hd_tangent_map *map, int width)
{
    const size_t disk = HD_ROWS * (size_t)width;
    const double *vi = buffer + disk * (size_t)map->i;
    const double *vj = map->j >= 0 ? buffer + disk * (size_t)map->j : vi;
    for (size_t k = 0; k < disk; k += LINE) {
        __builtin_prefetch(vi + k, 1);
        __builtin_prefetch(vj + k, 1);
    }
}

static inline __attribute__((always_inline)) void replay_width(double *buffer, maps m, bool walls,
                                                               int width)
{
    const size_t disk = HD_ROWS * (size_t)width;
    const hd_tangent_map *map = m.map;
    for (size_t e = 0; e < m.count; e++) {
        if (e < m.fetching) fetch(buffer, &map[e + FETCH_AHEAD], width);
        double *vi = buffer + disk * (size_t)map[e].i;
        if (!walls || map[e].j >= 0)
            hd_collide(vi, buffer + disk * (size_t)map[e].j, &map[e], width);
        else
            hd_meet_wall(vi, &map[e], width);
    }
}

/** The widths are spelled out so that the compiler unrolls and vectorises each. */
static inline __attribute__((always_inline)) void replay_any(double *buffer, maps m, bool walls,
                                                             int width)
{
    switch (width) {
    case 1: replay_width(buffer, m, walls, 1); break;
    case 2: replay_width(buffer, m, walls, 2); break;
    case 4: replay_width(buffer, m, walls, 4); break;
    case 8: replay_width(buffer, m, walls, 8); break;
    case 16: replay_width(buffer, m, walls, 16); break;
    case 32: replay_width(buffer, m, walls, 32); break;
    default: replay_width(buffer, m, walls, HD_BLOCK_WIDTH_MAX); break;
    }
}

/** Of a log without wall events. */
HD_MULTIVERSION
static void replay_block(double *buffer, maps m, int width) { replay_any(buffer, m, false, width); }

/** Of a log that holds wall events. */
HD_MULTIVERSION
static void replay_block_with_walls(double *buffer, maps m, int width)
{
    replay_any(buffer, m, true, width);
}

/** Columns [col, col + used) of V into the buffer, or back. */
static void block_load(const hd_frame *frame, double *buffer, int col, int used)
{
    const double *v = frame->copy[frame->current] + col;
    for (int row = 0; row < frame->rows; row++)
        memcpy(buffer + (size_t)row * (size_t)frame->width, v + (size_t)row * (size_t)frame->stride,
               (size_t)used * sizeof *v);
}

static void block_store(const hd_frame *frame, const double *buffer, int col, int used)
{
    double *v = frame->copy[1 - frame->current] + col;
    for (int row = 0; row < frame->rows; row++)
        memcpy(v + (size_t)row * (size_t)frame->stride, buffer + (size_t)row * (size_t)frame->width,
               (size_t)used * sizeof *v);
}

static maps maps_of(const hd_frame *frame, size_t count)
{
    const size_t bytes = (size_t)frame->rows * (size_t)frame->width * sizeof(double);
    const bool is_far = bytes > HD_BLOCK_BYTES && count > FETCH_AHEAD;
    return (maps){frame->map, count, is_far ? count - FETCH_AHEAD : 0};
}

static void block_replay(const hd_frame *frame, double *buffer, size_t count, int block)
{
    const maps m = maps_of(frame, count);
    const int width = frame->width, col = block * width;
    const int used = col + width <= frame->stride ? width : frame->stride - col;
    block_load(frame, buffer, col, used);
    if (frame->walls)
        replay_block_with_walls(buffer, m, width);
    else
        replay_block(buffer, m, width);
    for (int i = 0; i < frame->disks; i++)
        hd_fly(buffer + HD_ROWS * (size_t)width * (size_t)i, frame->since[i], width);
    block_store(frame, buffer, col, used);
}

hd_status hd_frame_replay(hd_frame *frame, const hd_event_log *log, double t_begin, double t_end)
{
    HD_ASSERT(!frame->by_rows);
    HD_TRY(hd_communicator_agree(frame->communicator, maps_reserve(frame, log->count)));
    const size_t count = maps_fill(frame, log, t_begin, t_end);
    const int blocks = (frame->stride + frame->width - 1) / frame->width;
    const size_t block_size = (size_t)frame->rows * (size_t)frame->width;
#pragma omp parallel for schedule(dynamic) num_threads(frame->threads) if (frame->threads > 1)
    for (int block = 0; block < blocks; block++)
        block_replay(frame, frame->buffer + block_size * (size_t)omp_get_thread_num(), count,
                     block);
    frame->current = 1 - frame->current;
    return HD_OK;
}
