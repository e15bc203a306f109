/** Scenes -> golden hashes (golden.h). */
#include "golden.h"

#include <stddef.h>
#include <string.h>

#include "records.h"
#include "scene/scene.h"
#include "scenes.h"
#include "interval.h"

typedef struct golden {
    hd_scene_def def;
    double pair_events; /**< expected ones; how long to run */
    uint64_t hash;
} golden;

static hd_scene_def soft(int count, double density, int potential, int integrator)
{
    const hd_scene_def core = {.particles = HD_DIM == 2 ? HD_SOFT_DISKS : HD_SOFT_SPHERES};
    hd_scene_def def = hd_scene_def_of(hd_dynamics_of(&core));
    def.number = count;
    def.density = density;
    def.own[0].whole = potential;
    def.own[3].whole = integrator;
    return def;
}

#if HD_DIM == 2
static hd_scene_def dumbbells(int count, double density, double bond, hd_boundary x, uint64_t seed)
{
    const hd_scene_def core = {.particles = HD_DUMBBELLS};
    hd_scene_def def = hd_scene_def_of(hd_dynamics_of(&core));
    def.number = count;
    def.density = density;
    def.boundary[0] = x;
    def.seed = seed;
    def.own[0].real = bond;
    return def;
}

static golden golden_scene(int scene)
{
    const hd_boundary p = HD_PERIODIC, r = HD_REFLECTING;
    const golden all[GOLDEN_SCENES] = {
        {hd_scene_def_default(), 30000, 0x1e6d333450645800u},
        {scene_of(2, 0.3, 1.0, p, p, 1), 5000, 0x6203032da614f440u},
        {scene_of(16, 0.7, 0.866, r, r, 2), 20000, 0x414194b11b9ec0fdu},
        {scene_of(100, 0.05, 0.2, p, r, 12345678901234567890u), 10000, 0xf10f5c4e2bfa6645u},
        {scene_in_box(9, 12.0, 1.0 + 1e-6, p, p, 4), 10000, 0x0cf1b5884e03e11eu},
        {scene_in_box(6, 1.4, 9.0, p, r, 5), 10000, 0x036efe86482d7328u},
        {scene_of(64, 1.1, 0.8660254, p, p, 6), 10000, 0x04072dec68dbfaecu},
        {scene_of(20000, 0.7, 0.8, p, r, 7), 60000,
         0x2d02f1c2d1469492u}, /* larger than the caches */
        {dumbbells(100, 0.6, 0.25, p, 8), 20000, 0xd24231f41fa984b9u},
        {dumbbells(12, 0.2, 1.3, r, 9), 10000, 0xced0dc82b541f34cu},
        {soft(64, 0.7, 1, 0), 30, 0xcb79103978be7d85u},
        {soft(200, 0.6, 2, 1), 20, 0x04182d0ea279e21au},
        {packed(with_second(box_of(100, 0.1, 0.9, 1, 1, 10), 0.35, 1.4, 3.0), 0.7), 20000,
         0x24cec74854ad7929u},
        {packed(with_second(scene(.container = HD_CIRCLE, .number = 30, .seed = 11), 0.2, 2.5, 0.1),
                0.4),
         10000, 0xa859823c6855c053u},
        {scene_from(scene_of(30, 0.5, 0.7, p, HD_SHEARING, 10), .exponents = HD_EXPONENTS_ALL,
                    .shear_b = 3.0),
         20000, 0x4c91bf8a7ee1fd73u},
    };
    return all[scene];
}
#else
static golden golden_scene(int scene)
{
    const golden all[GOLDEN_SCENES] = {
        {box_of(500, 0.8, 1.0, 1.0, 0, 1), 30000, 0xc261628e6babd33au},
        {box_of(2, 0.3, 1.0, 1.0, 0, 2), 5000, 0xd11151fa097e2ba0u},
        {box_of(16, 0.7, 0.9, 0.8, 7, 3), 20000, 0xf9fe38bbd9c2c68cu},
        {box_of(100, 0.05, 0.3, 0.5, 4, 12345678901234567890u), 10000, 0x350f791558565328u},
        {box_with(4, 1.6, 1.7, 1.8, 2, 4), 10000, 0xbe93c799f43a9a81u},
        {box_of(108, 1.35, 1.0, 1.0, 0, 5), 10000, 0x016cd45fe53c6fcfu},
        {box_of(20000, 0.6, 0.8, 0.7, 1, 6), 60000,
         0x25cdd5a1319ff59fu}, /* larger than the caches */
        {soft(100, 0.5, 0, 1), 100, 0xa7dbfcf48b694a41u},
        {packed(with_second(box_of(100, 0.1, 0.9, 0.8, 4, 7), 0.35, 1.4, 3.0), 0.5), 20000,
         0xe030722d012c22b1u},
    };
    return all[scene];
}
#endif

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *byte = data;
    for (size_t k = 0; k < size; k++) hash = (hash ^ byte[k]) * 0x100000001b3u;
    return hash;
}

static uint64_t hash_entries(const hd_record *log)
{
    const size_t time = sizeof(double);
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t k = 0; k < log->count; k++)
        hash = hash_bytes(hash, (const char *)hd_record_entry(log, k) + time, log->size - time);
    return hash;
}

static uint64_t hash_log(const hd_record *log)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *e = &events_in(log)[k];
        const int32_t disks[] = {(int32_t)e->i, (int32_t)e->j};
        hash = hash_bytes(hash, disks, sizeof disks);
        hash = hash_bytes(hash, e->n, sizeof e->n);
        hash = hash_bytes(hash, e->p, sizeof e->p);
    }
    return hash;
}

uint64_t golden_hash(int scene)
{
    const golden g = golden_scene(scene);
    hd_trajectory *tr = NULL;
    hd_record *log = NULL;
    uint64_t hash = 0;
    if (hd_record_create(&log, hd_dynamics_of(&g.def)->entry) == HD_OK &&
        hd_trajectory_create(&tr, &g.def) == HD_OK) {
        const double t_end = g.pair_events / hd_trajectory_totals(tr).expected;
        if (trajectory_to(tr, log, t_end) == HD_OK && log->count > 1000)
            hash = hd_dynamics_of(&g.def)->dispersing ? hash_log(log) : hash_entries(log);
    }
    hd_trajectory_free(tr);
    hd_record_free(log);
    return hash;
}

uint64_t golden_stored(int scene) { return golden_scene(scene).hash; }
