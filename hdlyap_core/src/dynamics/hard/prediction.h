/** The earliest event of each disk, from the states of its neighbours. See hard.c for the
 * scheme. */
#ifndef HD_PREDICTION_H
#define HD_PREDICTION_H

#include "dynamics/hard/cells.h"
#include "dynamics/hard/contact.h"
#include "dynamics/hard/queue.h"
#include "dynamics/hard/round_wall.h"

enum { PAIR, WALL, EDGE };  /* kinds, in the order in which equal times are taken */
enum { LOW = 0, HIGH = 2 }; /* sides of a cell, as in hd_cell_line */

typedef struct prediction {
    double contact;              /**< time of the earliest known contact, or INFINITY */
    int32_t partner;             /**< hd_motion.count: the round wall; see HD_WALL_CONTACTS */
    uint32_t partner_collisions; /**< when it was predicted */
    int32_t image[HD_DIM];       /**< box edges to add to the partner's position */
    int32_t direction, side;     /**< of the next cell edge or wall */
} prediction;

/** The disks, and what each will meet next. */
typedef struct hd_motion {
    int32_t count;
    hd_disk *disk; /**< [count + 1]: the last one stands for the round wall, and is none */
    hd_wall wall;  /**< without functions of a box */
    prediction *predicted;
    hd_cells cells;
    hd_queue queue;
} hd_motion;

/** Predicts all that disk i can meet, from its present state, and hands the earliest to the queue.
 */
void hd_prediction_renew(hd_motion *m, int32_t i);

/** Predicts what has newly come into reach of disk i, which has crossed the edge of its cell in
 * direction d to that side, and hands the earliest to the queue. What was predicted before stays.
 */
void hd_prediction_extend(hd_motion *m, int32_t i, int d, int side);

#endif
