/** What holds the particles. Each container is a file with a row of functions; callers know rows
 * alone.
 */
#ifndef HD_CONTAINER_ROW_H
#define HD_CONTAINER_ROW_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap/wave.h"

/** Smallest distance of two start positions: particles that all touch could never move. */
#define HD_START_DISTANCE_MIN (1.0 + 1e-9)

/** Smallest room of centres between two walls. Particles would cross less room more often than
 * times can be told apart. It is 1e-9, less what rounding an edge takes. */
#define HD_MEMORY_LIMIT_MIN 0.999e-9

/** Is called with each wave, one after another; `to` belongs to it. */
typedef void (*hd_wave_taker)(void *to, const hd_wave *wave);

enum { HD_WAVES_USUAL_MAX = 26 };

/** A wall in the plane that is no edge of the box: centres of particles stay within it. It curves
 * inwards everywhere, and lies within what centres reach of the box. It decides events: only + - *
 * / sqrt. q, p, n: [2]. */
typedef struct hd_wall hd_wall;
struct hd_wall {
    double own[4];                    /**< numbers that its functions need */
    double radius_least, radius_most; /**< range of its radius of curvature */
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
    /** Words for a refusal that describe the container, without its particles and their density. */
    void (*say)(const hd_scene_def *def, char *text, size_t size);
    /** See hd_scene_describe. */
    void (*describe)(const hd_scene_def *def, char *text, size_t size);
    /** Checks that one particle has room, and that no parameter is given that this container lacks.
     */
    hd_status (*check)(const hd_scene_def *def, char *message, size_t size);
    /** Writes the edges of the box around the container. */
    void (*box)(const hd_scene_def *def, double *box);
    double (*area)(const hd_scene_def *def); /**< area that centres can reach, of a mixture those
                                                of the mean diameter */
    bool rotates; /**< symmetric under rotation about its middle: angular momentum is conserved */
    /** Smallest distance of two positions in the densest start. */
    double (*start_distance)(const hd_scene_def *def);
    double (*density_max)(const hd_scene_def *def);    /**< highest density of a start; 0: none */
    void (*start)(const hd_scene_def *def, double *q); /**< positions */

    /* The two entries of a curved wall; NULL for a box. Boundaries are HD_CURVED then. */
    /** The wall for centres of particles of this radius. */
    hd_wall (*wall)(const hd_scene_def *def, double particle);
    /** The place on the outline, which rims touch, at the part `turn`, 0 .. 1, of the way round. */
    void (*outline)(const hd_scene_def *def, double turn, double *place);

    hd_wave_limits (*limits)(const hd_scene_def *def);
    /** Calls `take` with each wave of the scene, in any order. */
    void (*waves)(const hd_scene_def *def, hd_wave_taker take, void *to);
    /** Number of the longest waves that are classified if the scene does not give one, at most
     * HD_WAVES_USUAL_MAX; waves as long as the last one are added. Steps of shorter waves are
     * seldom resolved. */
    int (*waves_usual)(const hd_scene_def *def);
    /** Both are NULL for a box, whose modulations are products of functions of each coordinate.
     * of_wave writes own[HD_WAVE_OWN]; with it, modulations writes out[..], one for each bit of the
     * wave in order, at q. */
    void (*of_wave)(const hd_scene_def *def, const hd_wave *wave, double *own);
    void (*modulations)(hd_modulation *out, const double *own, const double *q);
    /** Relative distance of T and LP steps from the dispersion relation of boxes [T12]: 0 if they
     * follow it, NAN if they follow no relation. */
    double t_strays, lp_strays;
} hd_container_row;

#define HD_CONTAINER_ROW(NAME, name, what) extern const hd_container_row hd_##name##_row;
HD_CONTAINERS(HD_CONTAINER_ROW)
#undef HD_CONTAINER_ROW

const hd_container_row *hd_container_of(const hd_scene_def *def);
/** The container's name, as a scene file has it. */
const char *hd_container_name(const hd_scene_def *def);

/** The curved wall for centres of particles of this radius; its functions are NULL for a box. */
hd_wall hd_wall_of(const hd_scene_def *def, double particle);

/** Whether a site stays empty: if there are more sites than particles, the empty ones are spread
 * evenly. */
static inline bool hd_site_is_spare(int64_t site, int64_t sites, int64_t particles)
{
    return (site + 1) * particles / sites == site * particles / sites;
}

/** Largest number of nodes that the scene asks for; `most` is that of the waves within its limits.
 */
int hd_wave_nodes(const hd_scene_def *def, int most);
/** Wave number up to which the scene asks for waves. */
double hd_wave_limit(const hd_scene_def *def);

#endif
