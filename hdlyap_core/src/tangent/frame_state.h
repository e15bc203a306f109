/** What a frame holds, for the files that make it up: frame.c keeps it, replay.c carries it along.
 */
#ifndef HD_FRAME_STATE_H
#define HD_FRAME_STATE_H

#include <stdbool.h>

#include "hdlyap/frame.h"

/** Columns that a thread carries at once, and their bytes in its cache. */
enum { HD_BLOCK_BYTES = 512 * 1024, HD_BLOCK_WIDTH_MAX = 64 };

/** Tangent map of one event: free flights of its disks since their last events, then the collision.
 */
typedef struct hd_tangent_map {
    int32_t i, j; /**< as in hd_event */
    union {
        double flight[2]; /**< of i, of j */
        struct {
            double alone; /**< flight of i */
            double bend;  /**< of a round wall, twice its curvature */
        };
    };
    double n[HD_DIM];
    double normal;     /**< b = p.n: < 0, of a round wall > 0 */
    double tangential; /**< p_t = p.t, t = n turned by +90 degrees */
    double ratio;      /**< p_t / b */
} hd_tangent_map;

struct hd_frame {
    hd_communicator *communicator; /**< NULL: all vectors are here */
    int disks, rows, vectors, stride;
    int rows_kept; /**< with zeros behind, so that the disks fall into equal parts */
    bool by_rows;
    int threads, threads_max;
    int width;       /**< of a block: 1, 2, 4, 8, 16, 32 or 64 columns */
    double *copy[2]; /**< [rows * stride] */
    int current;
    double *buffer;      /**< [threads][rows * width] */
    hd_tangent_map *map; /**< [map_capacity], of the interval being replayed */
    size_t map_capacity;
    bool walls;    /**< some of them are of wall events */
    double *since; /**< [disks], time of each disk's last event, then its last flight */
};

#endif
