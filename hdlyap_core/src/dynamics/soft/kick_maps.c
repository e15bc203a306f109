/** Record of soft particles -> tangent maps -> blocks of columns, carried through the maps [T24].
 * Free flight is lazy: the rows of a particle are brought up to date when a kick needs them. A kick
 * goes through its pairs by their first particle, whose rows stay in registers. */
#include "dynamics/soft/kick_maps.h"

#include "base/check.h"
#include "base/memory.h"
#include "base/multiversion.h"
#include "dynamics/soft/kick.h"

/** The pairs of particle i in a kick: a stretch of the list of partners, behind that of the run
 * before. Its first `come` partners have to fly to the time of the kick first; the others have done
 * so in earlier runs. */
typedef struct run {
    int32_t i, pairs, come;
} run;

typedef struct maps {
    int particles, dimension;
    double *since; /**< [particles]: time of the last kick; once filled, the flight after it */
    size_t runs, pairs, flights, capacity;
    run *run;       /**< [runs] */
    int32_t *with;  /**< [pairs]: partners */
    double *bend;   /**< [pairs][bends_of(dimension)] */
    double *flight; /**< [flights]: of each run, time that i flies, may be 0, then partners' */
} maps;

#define KERNEL static inline __attribute__((always_inline))

KERNEL int bends_of(int dimension) { return dimension == 2 ? HD_BENDS_PLANE : HD_BENDS_SPACE; }

static hd_status create(void **out, int particles, int dimension)
{
    maps *all = *out = hd_memory_alloc(1, sizeof *all);
    if (!all) return HD_NO_MEMORY;
    all->particles = particles;
    all->dimension = dimension;
    all->since = hd_memory_alloc((size_t)particles, sizeof *all->since);
    return all->since ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_kick_maps_create_plane(void **out, const hd_scene_def *scene)
{
    return create(out, scene->number, 2);
}

hd_status hd_kick_maps_create_space(void **out, const hd_scene_def *scene)
{
    return create(out, scene->number, 3);
}

static void release(maps *all)
{
    hd_memory_free(all->run);
    hd_memory_free(all->with);
    hd_memory_free(all->bend);
    hd_memory_free(all->flight);
}

void hd_kick_maps_free(void *made)
{
    maps *all = made;
    if (!all) return;
    release(all);
    hd_memory_free(all->since);
    hd_memory_free(all);
}

/* ---- steps as maps ------------------------------------------------------------------------- */

/** Makes room for this many pairs, each of which may be a run. */
static hd_status reserve(maps *all, size_t pairs)
{
    if (pairs <= all->capacity) return HD_OK;
    const size_t bends = (size_t)bends_of(all->dimension);
    size_t room = 4096; /* doubled as a record's room is */
    while (room < pairs) room *= 2;
    release(all);
    all->capacity = 0;
    all->run = hd_memory_alloc(room, sizeof *all->run);
    all->with = hd_memory_alloc(room, sizeof *all->with);
    all->bend = hd_memory_alloc(room * bends, sizeof *all->bend);
    all->flight = hd_memory_alloc(2 * room, sizeof *all->flight);
    if (!all->run || !all->with || !all->bend || !all->flight) return HD_NO_MEMORY;
    all->capacity = room;
    return HD_OK;
}

/** Returns for how long i flies to the kick at `now`: 0 if it is there already. */
static double flight(maps *all, int32_t i, double now)
{
    const double time = now - all->since[i];
    all->since[i] = now;
    return time;
}

static void set_pair(maps *all, size_t k, int32_t with, const double *bend)
{
    const int bends = bends_of(all->dimension);
    double *to = all->bend + (size_t)bends * k;
    all->with[k] = with;
    for (int b = 0; b < bends; b++) to[b] = bend[b];
}

static void add_pair(maps *all, const hd_kick *entry, bool same_run, double now)
{
    const int32_t i = (int32_t)entry->i, j = (int32_t)entry->j;
    if (!same_run) {
        all->run[all->runs++] = (run){i, 0, 0};
        all->flight[all->flights++] = flight(all, i, now);
    }
    run *r = &all->run[all->runs - 1];
    const double time = flight(all, j, now);
    size_t k = all->pairs++;
    if (time != 0) {
        const size_t first = k - (size_t)(r->pairs - r->come++); /* of those that do not fly */
        set_pair(all, k, all->with[first], all->bend + first * (size_t)bends_of(all->dimension));
        all->flight[all->flights++] = time;
        k = first;
    }
    set_pair(all, k, j, entry->bend);
    r->pairs++;
}

/** Adds all time steps. Returns the sum of their lengths. */
static double add_steps(maps *all, const hd_record *record, hd_entries those)
{
    double begin = 0.0, end = 0.0, at = -1.0, i = -1.0;
    for (size_t k = those.first; k < those.end; k++) {
        const hd_kick *entry = hd_record_entry(record, k);
        if (entry->i < 0) {
            begin = end;
            end = begin + entry->at;
            at = i = -1.0;
            continue;
        }
        add_pair(all, entry, entry->at == at && entry->i == i, begin + entry->at);
        at = entry->at;
        i = entry->i;
    }
    return end;
}

hd_status hd_kick_maps_fill(void *made, const hd_record *record, double t_begin, double t_end)
{
    maps *all = made;
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    all->runs = all->pairs = all->flights = 0;
    HD_TRY(reserve(all, those.end - those.first));
    for (int i = 0; i < all->particles; i++) all->since[i] = 0.0;
    const double end = add_steps(all, record, those);
    for (int i = 0; i < all->particles; i++) all->since[i] = end - all->since[i];
    return HD_OK;
}

/* ---- a block of columns -------------------------------------------------------------------- */

KERNEL void fly(double *restrict v, double time, int half)
{
    for (int k = 0; k < half; k++) v[k] += time * v[half + k];
}

/** Index of (d, e) in the upper half of a symmetric matrix. */
KERNEL int place(int d, int e, int of_one)
{
    const int row = d < e ? d : e;
    return row * of_one - row * (row + 1) / 2 + (d < e ? e : d);
}

#define CARRY(name) name##_1
#define LANES 1
#include "dynamics/soft/kick_carry.h"

#define CARRY(name) name##_2
#define LANES 2
#include "dynamics/soft/kick_carry.h"

#define CARRY(name) name##_4
#define LANES 4
#include "dynamics/soft/kick_carry.h"

#define CARRY(name) name##_8
#define LANES 8
#include "dynamics/soft/kick_carry.h"

#define CARRY(lanes, processor)                                                                    \
    processor static void carry_by_##lanes(double *block, const maps *all, int width)              \
    {                                                                                              \
        if (all->dimension == 2)                                                                   \
            carry_##lanes(block, all, 2, width);                                                   \
        else                                                                                       \
            carry_##lanes(block, all, 3, width);                                                   \
    }
CARRY(2, )
#ifdef HD_FOR
CARRY(4, HD_FOR("fma"))
CARRY(8, HD_FOR("avx512f"))
#endif

void hd_kick_maps_carry(const void *made, double *block, int width)
{
#ifdef HD_FOR
    (HD_HAS("avx512f") ? carry_by_8 : HD_HAS("fma") ? carry_by_4 : carry_by_2)(block, made, width);
#else
    carry_by_2(block, made, width);
#endif
}
