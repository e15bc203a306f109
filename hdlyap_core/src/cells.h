/** Cells at least a diameter wide: who can meet whom, and through which image. */
#ifndef HD_CELLS_H
#define HD_CELLS_H

#include "disk.h"
#include "hdlyap/scene.h"

/** Where the cells next to a column (or row) lie; both ends of a line, both directions. */
typedef struct hd_cell_line {
    double low, high; /**< bounds of the disks' centres; a wall's position where there is one */
    int32_t near[3];  /**< columns to the left, here, to the right; -1 beyond a wall */
    int32_t shift[3]; /**< box edges to add to the positions there (-1, 0, 1) */
} hd_cell_line;

typedef struct hd_cells {
    double box[2];
    hd_boundary boundary[2];
    int32_t size[2];       /**< columns, rows */
    hd_cell_line *line[2]; /**< [size[d]] */
    int32_t *first;        /**< [size[0] * size[1]], first disk of the cell's list or -1 */
} hd_cells;

HD_MUST_CHECK hd_status hd_cells_create(hd_cells *cells, const hd_scene_def *def);
void hd_cells_clear(hd_cells *cells);

/** Books disk i, inside the box, into the cell of its position q. */
void hd_cells_add(hd_cells *cells, hd_disk *disks, int32_t i);

/** Moves disk i over the low (side 0) or high (side 2) edge of its cell in direction d. */
void hd_cells_cross(hd_cells *cells, hd_disk *disks, int32_t i, int d, int side);

/** First disk in column x, row y, or -1. */
static inline int32_t hd_cells_first(const hd_cells *cells, int32_t x, int32_t y)
{
    return cells->first[y * cells->size[0] + x];
}

#endif
