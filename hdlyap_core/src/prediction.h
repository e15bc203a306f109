/** What the parts of the trajectory share: its state, and the predictions made from it. */
#ifndef HD_PREDICTION_H
#define HD_PREDICTION_H

#include "cells.h"
#include "contact.h"
#include "hdlyap/trajectory.h"
#include "queue.h"

/** Deeper than this [sigma], an overlap is a fault and not rounding. */
#define HD_OVERLAP_MAX 1e-9

enum { PAIR, WALL, EDGE };  /* kinds, in the order in which equal times are taken */
enum { LOW = 0, HIGH = 2 }; /* sides of a cell, as in hd_cell_line */

typedef struct prediction {
    double contact; /**< time of the earliest known contact, or INFINITY */
    int32_t partner;
    uint32_t partner_collisions; /**< when it was predicted */
    int32_t image[2];            /**< box edges to add to the partner's position */
    int32_t direction, side;     /**< of the next cell edge or wall */
} prediction;

struct hd_trajectory {
    int32_t count;
    hd_disk *disk;
    prediction *predicted;
    hd_cells cells;
    hd_queue queue;
    double rate; /**< expected pair events per time unit */
    double epoch_length;
    double epoch_start; /**< simulated time, a multiple of epoch_length */
    double now;         /**< simulated time */
    uint64_t collisions, wall_events;
};

/** Predicts all that disk i can meet, from its present state, and hands the earliest to the queue.
 */
void hd_prediction_renew(hd_trajectory *tr, int32_t i);

/** The same for what has newly come into reach: disk i has crossed the edge of its cell in
 * direction d to that side. What was predicted before stays. */
void hd_prediction_extend(hd_trajectory *tr, int32_t i, int d, int side);

#endif
