/** A list of the pairs that may be nearer than the cut, in a periodic box. It is made by cells, and
 * reaches further than the cut by a skin, so that it holds for a while. */
#ifndef HD_NEIGHBOURS_H
#define HD_NEIGHBOURS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hdlyap/scene.h"

typedef struct hd_neighbours {
    int count, dimension;
    double box[HD_DIMENSION_MAX];
    double reach;                   /**< reach of the list: cut and skin [sigma] */
    double moved;                   /**< the list holds until a particle's square way is this */
    int32_t size[HD_DIMENSION_MAX]; /**< cells along each direction */
    int32_t *head, *next; /**< [cells], [particles]: lists of the particles in cells; end at -1 */
    double *place;        /**< [particles][dimension]: positions when the list was made */
    size_t *first;        /**< [particles + 1]: where the partners of each begin in `partner` */
    int32_t *partner;     /**< [first[count]]: partners with higher numbers, in ascending order */
    size_t capacity;
} hd_neighbours;

/** Creates the list of a scene for pairs nearer than `cut`. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_neighbours_create(hd_neighbours *n, const hd_scene_def *scene,
                                             double cut);
/** The expected number of partners with higher numbers that a particle has within reach. */
double hd_neighbours_expected(const hd_scene_def *scene, double reach);
/** Most bytes that the list is expected to take at a time: those of it and of its old copy while it
 * grows, or, if that is more, those of it and of a copy of positions and momenta. */
double hd_neighbours_bytes(const hd_scene_def *scene, double cut);
void hd_neighbours_clear(hd_neighbours *n);

/** Makes the list anew if it does not hold any more: afterwards it has all pairs nearer than the
 * cut, in an order that does not depend on when it was made. q[particles][dimension]. Fails with
 * HD_NOT_FINITE if a position is not in the box, or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_neighbours_follow(hd_neighbours *n, const double *q);
/** Makes hd_neighbours_follow make the list anew at its next call. */
void hd_neighbours_forget(hd_neighbours *n);

/** The distance to the nearest image along an edge of the box. */
static inline double hd_nearest(double r, double edge)
{
    return r > 0.5 * edge ? r - edge : r < -0.5 * edge ? r + edge : r;
}

#endif
