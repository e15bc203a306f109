/** Who may be within reach of whom: a list with a skin, over cells, in a periodic box. */
#ifndef HD_NEIGHBOURS_H
#define HD_NEIGHBOURS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hdlyap/scene.h"

typedef struct hd_neighbours {
    int count, dimension;
    double box[HD_DIMENSION_MAX];
    double reach;                   /**< of the list: cut and skin [sigma] */
    double moved;                   /**< square of the way that nobody has gone since */
    int32_t size[HD_DIMENSION_MAX]; /**< cells along each direction */
    int32_t *head, *next; /**< [cells], [particle]: lists of the cells; -1 at their ends */
    double *place;        /**< [particle][dimension] when the list was made */
    size_t *first;        /**< [particle + 1]: of its partners, all of higher numbers */
    int32_t *partner;     /**< [first[count]], for each in ascending order */
    size_t capacity;
} hd_neighbours;

/** Of a scene's particles: a list for all that are nearer than `cut`. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_neighbours_create(hd_neighbours *n, const hd_scene_def *scene,
                                             double cut);
/** Partners of higher numbers that a particle has within reach, on average. */
double hd_neighbours_expected(const hd_scene_def *scene, double reach);
/** Of it, expected, and while it grows, or of a copy of the positions and momenta later. */
double hd_neighbours_bytes(const hd_scene_def *scene, double cut);
void hd_neighbours_clear(hd_neighbours *n);

/** Afterwards all pairs nearer than the cut are in the list, in an order that does not depend on
 * when it was made. q[particle][dimension] in the box. HD_NOT_FINITE if they are not; HD_NO_MEMORY.
 */
HD_MUST_CHECK hd_status hd_neighbours_follow(hd_neighbours *n, const double *q);
/** The list is made anew by the next call of that. */
void hd_neighbours_forget(hd_neighbours *n);

/** A distance along an edge of the box to the nearest image. */
static inline double hd_nearest(double r, double edge)
{
    return r > 0.5 * edge ? r - edge : r < -0.5 * edge ? r + edge : r;
}

#endif
