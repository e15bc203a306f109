/** Cells at least a diameter wide: who can meet whom, and through which image. */
#ifndef HD_CELLS_H
#define HD_CELLS_H

#include <stddef.h>

#include "events/disk.h"
#include "hdlyap/scene.h"

/** Where the cells next to a column (or row) lie; both ends of a line, both directions. */
typedef struct hd_cell_line {
    double bound[2];  /**< low and high end of the disks' centres; a wall's position where there is
                         one */
    int32_t near[3];  /**< columns to the left, here, to the right; hd_cells.size beyond a wall */
    int32_t shift[4]; /**< box edges to add to the positions there (-1, 0, 1); the last is spare */
} hd_cell_line;

enum { HD_CELL_DISKS = 3 };

/** The disks of one cell, in no order. */
typedef struct hd_cell {
    int32_t disk[HD_CELL_DISKS]; /**< the last place heads the list of all that find no other */
    int16_t count;               /**< places taken */
    int16_t crowded;             /**< 1 if that list is longer than 1 */
} hd_cell;

typedef struct hd_cells {
    double box[HD_DIM];
    hd_boundary boundary[HD_DIM];
    int32_t size[HD_DIM];       /**< columns, rows */
    hd_cell_line *line[HD_DIM]; /**< [size[d]] */
    hd_cell *cell; /**< [(size[0] + 1) * (size[1] + 1)]; the last column and row stay empty */
    int32_t *next; /**< [disks], links of the crowded cells' lists; -1 at their ends */
} hd_cells;

HD_MUST_CHECK hd_status hd_cells_create(hd_cells *cells, const hd_scene_def *def);
void hd_cells_clear(hd_cells *cells);

/** Books disk i, inside the box, into the cell of its position q. */
void hd_cells_add(hd_cells *cells, hd_disk *disks, int32_t i);

/** Books disk i into the cell that it names, wherever its position is. */
void hd_cells_book(hd_cells *cells, const hd_disk *disks, int32_t i);

/** No disk is in any cell. */
void hd_cells_empty(hd_cells *cells);

/** Moves disk i over the low (side 0) or high (side 2) edge of its cell in direction d. */
void hd_cells_cross(hd_cells *cells, hd_disk *disks, int32_t i, int d, int side);

/** The cell in column x, row y; an empty one beyond a wall. */
static inline hd_cell *hd_cells_at(const hd_cells *cells, int32_t x, int32_t y)
{
    return &cells->cell[(ptrdiff_t)y * (cells->size[0] + 1) + x];
}

/** The disk after j in the list of a crowded cell that cell->disk[HD_CELL_DISKS - 1] heads, or -1.
 */
static inline int32_t hd_cells_next(const hd_cells *cells, int32_t j) { return cells->next[j]; }

#endif
