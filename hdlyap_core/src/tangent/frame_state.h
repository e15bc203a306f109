/** The members of a frame. frame.c keeps them, replay.c carries the vectors. */
#ifndef HD_FRAME_STATE_H
#define HD_FRAME_STATE_H

#include <stdbool.h>

#include "dynamics/dynamics.h"
#include "tangent/frame.h"

struct hd_frame {
    hd_communicator *communicator; /**< NULL: a single rank, which has all vectors */
    const hd_dynamics *of;
    int particles, rows, vectors, stride;
    int rows_kept; /**< rows with the zeros that make all ranks' parts equal */
    bool by_rows;
    int threads, threads_max;
    int width;       /**< width of a block: 1, 2, 4, 8, 16, 32 or 64 columns */
    double *copy[2]; /**< [rows * stride]: the vectors before and after a replay */
    int current;
    double *buffer; /**< [threads][rows * width] */
    void *maps;     /**< the tangent maps of the present replay; the dynamics knows what they are */
};

#endif
