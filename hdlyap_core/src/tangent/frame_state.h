/** What a frame holds, for the files that make it up: frame.c keeps it, replay.c carries it along.
 */
#ifndef HD_FRAME_STATE_H
#define HD_FRAME_STATE_H

#include <stdbool.h>

#include "dynamics/dynamics.h"
#include "tangent/frame.h"

struct hd_frame {
    hd_communicator *communicator; /**< NULL: all vectors are here */
    const hd_dynamics *of;
    int particles, rows, vectors, stride;
    int rows_kept; /**< with zeros behind, so that the particles fall into equal parts */
    bool by_rows;
    int threads, threads_max;
    int width;       /**< of a block: 1, 2, 4, 8, 16, 32 or 64 columns */
    double *copy[2]; /**< [rows * stride] */
    int current;
    double *buffer; /**< [threads][rows * width] */
    void *maps;     /**< of what is being replayed, as the dynamics has them */
};

#endif
