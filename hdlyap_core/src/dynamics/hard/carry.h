/** Record of hard particles -> tangent maps -> blocks of columns, carried through the maps. This is
 * the code that all hard particles share. Free flight is lazy: a collision brings only the rows of
 * its particles up to date. A file that includes this one defines before it, for its particles:
 *   hd_entry: an entry of the record, with t, i and j (negative: a wall);
 *   HD_HALF: the number of coordinates of a particle;
 *   hd_tangent_map: a map with i, j and flight[2], the times since the last events of i and of j;
 *   hd_map_fill(map, entry): fills all members of the map but i, j and flight;
 *   hd_collide(vi, vj, map, width), hd_meet_wall(v, map, width): carry the rows of one event's
 *   particles, of a block `width` columns wide, through the free flights and then the event. */
#ifndef HD_CARRY_H
#define HD_CARRY_H

#include <stdbool.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/multiversion.h"
#include "dynamics/dynamics.h"

/** If a block outgrows the cache, rows are fetched this many events before they are needed. LINE:
 * numbers in a cache line. */
enum { FETCH_AHEAD = 12, LINE = 64 / sizeof(double) };

typedef struct hd_maps {
    const hd_scene_def *scene;
    int bodies;
    hd_tangent_map *map; /**< [count] */
    size_t count, capacity;
    bool walls;    /**< true if one of the maps is a wall event */
    double *since; /**< [bodies]: time of the last event; once filled, the flight after it */
} hd_maps;

static hd_status maps_create(void **out, const hd_scene_def *scene)
{
    hd_maps *maps = *out = hd_memory_alloc(1, sizeof *maps);
    if (!maps) return HD_NO_MEMORY;
    maps->scene = scene;
    maps->bodies = scene->number;
    maps->since = hd_memory_alloc((size_t)maps->bodies, sizeof *maps->since);
    return maps->since ? HD_OK : HD_NO_MEMORY;
}

static void maps_free(hd_maps *maps)
{
    if (!maps) return;
    hd_memory_free(maps->map);
    hd_memory_free(maps->since);
    hd_memory_free(maps);
}

/* ---- events as tangent maps ---------------------------------------------------------------- */

static double flight(double *since, int32_t body, double t)
{
    const double tau = t - since[body];
    since[body] = t;
    return tau;
}

static void map_fill(hd_tangent_map *map, const hd_entry *event, double *since)
{
    *map = (hd_tangent_map){.i = (int32_t)event->i, .j = (int32_t)event->j};
    map->flight[0] = flight(since, map->i, event->t);
    if (map->j >= 0) map->flight[1] = flight(since, map->j, event->t);
    hd_map_fill(map, event);
}

static hd_status reserve(hd_maps *maps, size_t count)
{
    if (count <= maps->capacity) return HD_OK;
    hd_memory_free(maps->map);
    maps->capacity = count + count / 2;
    maps->map = hd_memory_alloc(maps->capacity, sizeof *maps->map);
    if (maps->map) return HD_OK;
    maps->capacity = 0;
    return HD_NO_MEMORY;
}

static hd_status maps_fill(hd_maps *maps, const hd_record *record, double t_begin, double t_end)
{
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    const hd_entry *event = hd_record_entry(record, those.first);
    maps->count = 0;
    maps->walls = false;
    HD_TRY(reserve(maps, those.end - those.first));
    for (int i = 0; i < maps->bodies; i++) maps->since[i] = t_begin;
    for (size_t k = 0; k < those.end - those.first; k++) {
        maps->walls |= event[k].j < 0;
        map_fill(&maps->map[maps->count++], &event[k], maps->since);
    }
    for (int i = 0; i < maps->bodies; i++) maps->since[i] = t_end - maps->since[i];
    return HD_OK;
}

/* ---- a block of columns -------------------------------------------------------------------- */

/** Fetches the rows of both particles into the cache; of a wall event, the rows of i alone. */
HD_KERNEL void fetch(const double *buffer, const hd_tangent_map *map, int width)
{
    const size_t body = 2 * HD_HALF * (size_t)width;
    const double *vi = buffer + body * (size_t)map->i;
    const double *vj = map->j >= 0 ? buffer + body * (size_t)map->j : vi;
    for (size_t k = 0; k < body; k += LINE) {
        __builtin_prefetch(vi + k, 1);
        __builtin_prefetch(vj + k, 1);
    }
}

/** Carries a block through all maps. Before each of the first `fetching` maps it fetches the rows
 * of the map that comes FETCH_AHEAD later. */
HD_KERNEL void carry_width(double *buffer, const hd_maps *m, size_t fetching, bool walls, int width)
{
    const size_t body = 2 * HD_HALF * (size_t)width;
    const hd_tangent_map *map = m->map;
    for (size_t e = 0; e < m->count; e++) {
        if (e < fetching) fetch(buffer, &map[e + FETCH_AHEAD], width);
        double *vi = buffer + body * (size_t)map[e].i;
        if (!walls || map[e].j >= 0)
            hd_collide(vi, buffer + body * (size_t)map[e].j, &map[e], width);
        else
            hd_meet_wall(vi, &map[e], width);
    }
}

/** Each width is a constant here so that the compiler unrolls and vectorises its loops. */
HD_KERNEL void carry_any(double *buffer, const hd_maps *m, size_t fetching, bool walls, int width)
{
    switch (width) {
    case 1: carry_width(buffer, m, fetching, walls, 1); break;
    case 2: carry_width(buffer, m, fetching, walls, 2); break;
    case 4: carry_width(buffer, m, fetching, walls, 4); break;
    case 8: carry_width(buffer, m, fetching, walls, 8); break;
    case 16: carry_width(buffer, m, fetching, walls, 16); break;
    case 32: carry_width(buffer, m, fetching, walls, 32); break;
    default: carry_width(buffer, m, fetching, walls, HD_BLOCK_WIDTH_MAX); break;
    }
}

/** For maps without wall events. */
HD_MULTIVERSION
static void carry_block(double *buffer, const hd_maps *m, size_t fetching, int width)
{
    carry_any(buffer, m, fetching, false, width);
}

HD_MULTIVERSION
static void carry_block_with_walls(double *buffer, const hd_maps *m, size_t fetching, int width)
{
    carry_any(buffer, m, fetching, true, width);
}

static void maps_carry(const hd_maps *maps, double *block, int width)
{
    const size_t body = 2 * HD_HALF * (size_t)width;
    const bool is_far = body * (size_t)maps->bodies * sizeof(double) > HD_BLOCK_BYTES &&
                        maps->count > FETCH_AHEAD;
    const size_t fetching = is_far ? maps->count - FETCH_AHEAD : 0;
    if (maps->walls)
        carry_block_with_walls(block, maps, fetching, width);
    else
        carry_block(block, maps, fetching, width);
    for (int i = 0; i < maps->bodies; i++)
        hd_fly(block + body * (size_t)i, maps->since[i], HD_HALF * width);
}

#endif
