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

/** A wall in the plane that is no edge of the box: centres of disks stay within it. It curves
 * inwards everywhere, and lies within what centres reach of the box. It decides events: only + - *
 * / sqrt. q, p, n: [2]. */
typedef struct hd_wall hd_wall;
struct hd_wall {
    double own[4];                    /**< what its functions need */
    double radius_least, radius_most; /**< of its curvature */
    /** How far beyond the wall q is; negative inside. */
    double (*excess)(const hd_wall *wall, const double *q);
    /** Time until q with velocity p leaves through it: 0 there, and beyond it, on the way out;
     * INFINITY at rest. */
    double (*wait)(const hd_wall *wall, const double *q, const double *p);
    /** Moves q onto the wall, where it is within rounding; n: unit vector outwards there. Returns
     * the radius of curvature. */
    double (*meet)(const hd_wall *wall, double *q, double *n);
};

/** A modulation at one place: A and its gradient. */
typedef struct hd_modulation {
    double a, x, y;
} hd_modulation;

enum { HD_WAVE_OWN = 6 };

typedef struct hd_container_row {
    /** For a refusal, what it is beside its disks and their density. */
    void (*say)(const hd_scene_def *def, char *text, size_t size);
    /** See hd_scene_describe. */
    void (*describe)(const hd_scene_def *def, char *text, size_t size);
    /** That one disk has room, and that no parameter is given which it does not have. */
    hd_status (*check)(const hd_scene_def *def, char *message, size_t size);
    void (*box)(const hd_scene_def *def, double *box); /**< edges of the box around it */
    double (*area)(const hd_scene_def *def);           /**< that centres can reach */
    bool rotates; /**< about the middle of its box: angular momentum is conserved there */
    double (*start_distance)(const hd_scene_def *def); /**< least, of the densest start positions */
    double (*density_max)(const hd_scene_def *def);    /**< that these can hold; 0 for none */
    void (*start)(const hd_scene_def *def, double *q); /**< positions */

    /* Of a curved wall; NULL of a box. Its boundaries are HD_CURVED, and no scene gives others. */
    hd_wall (*wall)(const hd_scene_def *def);
    /** Part `turn`, 0 .. 1, of the way round, where rims touch it. */
    void (*outline)(const hd_scene_def *def, double turn, double *place);

    hd_wave_limits (*limits)(const hd_scene_def *def);
    void (*waves)(const hd_scene_def *def, hd_wave_taker take, void *to); /**< in any order */
    /** So many of the longest waves, and those as long as the last one, are classified if the scene
     * does not say: steps of shorter ones seldom part from the rest. HD_WAVES_USUAL_MAX at most. */
    int (*waves_usual)(const hd_scene_def *def);
    /** NULL of a box, whose modulations are products of functions of each coordinate. of_wave
     * writes own[HD_WAVE_OWN], by which modulations are computed: out[..] for the bits of the wave,
     * in their order, at q. */
    void (*of_wave)(const hd_scene_def *def, const hd_wave *wave, double *own);
    void (*modulations)(hd_modulation *out, const double *own, const double *q);
    /** By which part of themselves T and LP steps stray from the relation of boxes [T12]: 0 as
     * those of boxes; NAN: they follow none. */
    double t_strays, lp_strays;
} hd_container_row;

#define HD_CONTAINER_ROW(NAME, name, what) extern const hd_container_row hd_##name##_row;
HD_CONTAINERS(HD_CONTAINER_ROW)
#undef HD_CONTAINER_ROW

const hd_container_row *hd_container_of(const hd_scene_def *def);
/** As a scene says it. */
const char *hd_container_name(const hd_scene_def *def);

/** Its wall; without functions of a box. */
hd_wall hd_wall_of(const hd_scene_def *def);

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
