/** What holds the disks. Each kind is a file with a row of functions; who asks knows rows alone. */
#ifndef HD_CONTAINER_ROW_H
#define HD_CONTAINER_ROW_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap/wave.h"

/** Least distance of two start positions: disks that all touch can never move. */
#define HD_START_DISTANCE_MIN (1.0 + 1e-9)

/** Room of centres between walls: less is crossed more often than there are times to tell apart. It
 * is 1e-9 but for the rounding of an edge that density and aspect give. */
#define HD_ROOM_MIN 0.999e-9

/** Takes one wave; `to` is its own. */
typedef void (*hd_wave_taker)(void *to, const hd_wave *wave);

enum { HD_WAVES_USUAL_MAX = 26 };

typedef struct hd_container_row {
    /** For a refusal, what it is beside its disks and their density. */
    void (*say)(const hd_scene_def *def, char *text, size_t size);
    /** That one disk has room, and that no parameter is given which it does not have. */
    hd_status (*check)(const hd_scene_def *def, char *message, size_t size);
    void (*box)(const hd_scene_def *def, double *box); /**< edges of the box around it */
    double (*area)(const hd_scene_def *def);           /**< that centres can reach */
    /** Pairs of zero exponents: of energy and time, and of each conserved momentum. */
    int (*symmetries)(const hd_scene_def *def);
    double (*start_distance)(const hd_scene_def *def); /**< least, of the densest start positions */
    double (*density_max)(const hd_scene_def *def);    /**< that these can hold; 0 for none */
    void (*start)(const hd_scene_def *def, double *q); /**< positions */
    /** Takes out of the momenta p each momentum that is conserved. */
    void (*still)(const hd_scene_def *def, const double *q, double *p);
    hd_wave_limits (*limits)(const hd_scene_def *def);
    void (*waves)(const hd_scene_def *def, hd_wave_taker take, void *to); /**< in any order */
    /** So many of the longest waves, and those as long as the last one, are classified if the scene
     * does not say: steps of shorter ones seldom part from the rest. HD_WAVES_USUAL_MAX at most. */
    int (*waves_usual)(const hd_scene_def *def);
} hd_container_row;

extern const hd_container_row hd_rectangle_row, hd_circle_row;

const hd_container_row *hd_container_of(const hd_scene_def *def);

/** Of more sites than disks some are left empty, evenly. */
static inline bool hd_site_is_spare(int64_t site, int64_t sites, int64_t disks)
{
    return (site + 1) * disks / sites == site * disks / sites;
}

/** Largest number of nodes that the scene asks for, of `most` within the limits. */
int hd_wave_nodes(const hd_scene_def *def, int most);
/** Wave number up to which the scene asks for waves. */
double hd_wave_limit(const hd_scene_def *def);

#endif
