/** What can move: a row for each kind of particles. Who stands behind the dynamics knows rows
 * alone; what a row's state, entries and maps hold is its own. To add one is a folder with its row,
 * a name in the table of dynamics.c, a test, and words for users. */
#ifndef HD_DYNAMICS_H
#define HD_DYNAMICS_H

#include <stdint.h>

#include "base/archive.h"
#include "dynamics/record.h"
#include "hdlyap/trajectory.h"

/** Columns that a thread carries at once, and their bytes in its cache. */
enum { HD_BLOCK_BYTES = 512 * 1024, HD_BLOCK_WIDTH_MAX = 64 };

typedef struct hd_dynamics {
    const char *particles; /**< in the plural */
    int dimension;         /**< of the space */
    int coordinates;       /**< of a particle: components of its dq, and of its dp */
    size_t entry;          /**< bytes of an entry of the record */

    /* ---- particles */
    /** See hd_trajectory_create_from. */
    hd_status (*create)(void **state, const hd_scene_def *def, const double *q, const double *p);
    void (*free)(void *state);
    /** Moves them to simulated time t_end, at least the present one, and adds to the record, which
     * may be NULL, what happens on the way. */
    hd_status (*advance)(void *state, hd_record *record, double t_end);
    double (*time)(const void *state);
    void (*state)(const void *state, double *q, double *p); /**< either may be NULL */
    double (*kinetic_energy)(const void *state);
    void (*tell)(const void *state, hd_told *told);            /**< all but what is expected */
    void (*examine)(const void *state, hd_examined *examined); /**< cost O(N) */
    void (*archive)(void *state, hd_archive *archive);
    uint32_t (*fingerprint)(const void *state); /**< of positions and momenta to the last bit */
    double (*bytes)(double particles);

    /* ---- record */
    /** NULL, or what is wrong with it, whoever wrote it. */
    const char *(*fault)(const hd_record *record, const hd_scene_def *scene);
    void (*archive_record)(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
    /** Of so many entries: in the record, which doubles when it is full, and as maps. */
    double (*record_bytes)(double entries);
    double (*entries)(const hd_scene_def *scene); /**< expected in a time unit */
    double (*rate)(const hd_scene_def *scene);    /**< the same of collisions of pairs */

    /* ---- tangent maps */
    hd_status (*maps_create)(void **maps, int particles);
    void (*maps_free)(void *maps);
    /** The maps from t_begin to t_end of the record (hd_record_within). HD_NO_MEMORY if there is no
     * room for so many. */
    hd_status (*maps_fill)(void *maps, const hd_record *record, double t_begin, double t_end);
    /** Carries a block of columns through them: block[particle][2 coordinates][width], the width 1,
     * 2, 4, 8, 16, 32 or 64. Several threads may carry blocks of their own. */
    void (*carry)(const void *maps, double *block, int width);
} hd_dynamics;

extern const hd_dynamics hd_hard_disks, hd_hard_spheres;

/** That of a scene. */
const hd_dynamics *hd_dynamics_of(const hd_scene_def *def);

#endif
