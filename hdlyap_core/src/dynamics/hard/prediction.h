/** The earliest event of each disk, from the states of its neighbours. See hard.c for the
 * scheme. */
#ifndef HD_PREDICTION_H
#define HD_PREDICTION_H

#include "dynamics/hard/cells.h"
#include "dynamics/hard/contact.h"
#include "dynamics/hard/queue.h"
#include "dynamics/hard/round_wall.h"
#include "dynamics/hard/sizes.h"

enum { PAIR, WALL, EDGE };  /* kinds of events; at the same time the earlier kind comes first */
enum { LOW = 0, HIGH = 2 }; /* sides of a cell, as in hd_cell_line */

typedef struct prediction {
    double contact;              /**< time of the earliest known contact, or INFINITY */
    int32_t partner;             /**< hd_motion.count: the round wall; see HD_WALL_CONTACTS */
    uint32_t partner_collisions; /**< `collisions` of the partner when this was predicted */
    int32_t image[HD_DIM];       /**< box edges to add to the partner's position */
    int32_t direction, side;     /**< where the next cell edge or wall is */
} prediction;

/** The disks, and what each will meet next. */
typedef struct hd_motion {
    int32_t count;
    hd_disk *disk; /**< [count + 1]: the last one is no disk but stands for the round wall */
    hd_sizes sizes;
    hd_wall wall; /**< the round wall; its functions are NULL in a box */
    prediction *predicted;
    hd_cells cells;
    hd_queue queue;
} hd_motion;

/** The round wall for the centre of a disk. */
static inline const hd_wall *hd_motion_wall(const hd_motion *m, const hd_disk *disk)
{
    return HD_MIXED ? &m->sizes.wall[disk->size] : &m->wall;
}

/** Predicts all events of disk i from its present state, and puts the earliest into the queue. */
void hd_prediction_renew(hd_motion *m, int32_t i);

/** Disk i has crossed an edge of its cell, in direction d to this side: predicts its contacts with
 * the disks that have come into reach, keeps the prediction from before if that is earlier, and
 * puts the earliest event into the queue. */
void hd_prediction_extend(hd_motion *m, int32_t i, int d, int side);

#endif
