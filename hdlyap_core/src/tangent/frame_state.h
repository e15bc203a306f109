/** What a frame holds, for the files that make it up: frame.c keeps it, replay.c carries it along.
 */
#ifndef HD_FRAME_STATE_H
#define HD_FRAME_STATE_H

#include <stdbool.h>

#include "hdlyap/frame.h"

/** Columns that a thread carries at once, and their bytes in its cache. */
enum { HD_BLOCK_BYTES = 512 * 1024, HD_BLOCK_WIDTH_MAX = 64 };

struct hd_frame {
    hd_communicator *communicator; /**< NULL: all vectors are here */
    int disks, rows, vectors, stride;
    int rows_kept; /**< with zeros behind, so that the disks fall into equal parts */
    bool by_rows;
    int threads, threads_max;
    int width;       /**< of a block: 1, 2, 4, 8, 16, 32 or 64 columns */
    double *copy[2]; /**< [rows * stride] */
    int current;
    double *buffer;             /**< [threads][rows * width] */
    struct hd_tangent_map *map; /**< [map_capacity], of the interval being replayed */
    size_t map_capacity;
    bool walls;    /**< some of them are of wall events */
    double *since; /**< [disks], time of each disk's last event, then its last flight */
};

#endif
