/** Cells at least as wide as two centres that meet are apart: who can meet whom, and through which
 * image. */
#ifndef HD_CELLS_H
#define HD_CELLS_H

#include <stddef.h>

#include "dynamics/hard/disk.h"
#include "hdlyap/scene.h"

/** Where the cells next to a column (row, layer) lie; both ends of a line, both directions. */
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
    int32_t size[HD_DIM];       /**< columns, rows, of spheres layers */
    hd_cell_line *line[HD_DIM]; /**< [size[d]] */
    hd_cell *cell; /**< [product of (size[d] + 1)]; the last column, row, layer stay empty */
    int32_t *next; /**< [disks], links of the crowded cells' lists; -1 at their ends */
} hd_cells;

/** reach: largest distance of two centres that meet, of disks 1. */
HD_MUST_CHECK hd_status hd_cells_create(hd_cells *cells, const hd_scene_def *def, double reach);
void hd_cells_clear(hd_cells *cells);

/** Books disk i, inside the box, into the cell of its position q. */
void hd_cells_add(hd_cells *cells, hd_disk *disks, int32_t i);

/** Books disk i into the cell that it names, wherever its position is. */
void hd_cells_book(hd_cells *cells, const hd_disk *disks, int32_t i);

/** No disk is in any cell. */
void hd_cells_empty(hd_cells *cells);

/** Moves disk i over the low (side 0) or high (side 2) edge of its cell in direction d. */
void hd_cells_cross(hd_cells *cells, hd_disk *disks, int32_t i, int d, int side);

/** Back into the box; the cell that it is booked in stays. */
static inline void hd_cells_fold(const hd_cells *cells, hd_disk *disk)
{
    for (int d = 0; d < HD_DIM; d++) {
        if (cells->boundary[d] != HD_PERIODIC) continue;
        const double turns = floor(disk->q[d] / cells->box[d]);
        disk->q[d] -= turns * cells->box[d];
        disk->wrap[d] -= (int32_t)turns;
    }
}

/** The cell in that column, row (and layer); an empty one beyond a wall. */
static inline hd_cell *hd_cells_at(const hd_cells *cells, const int32_t at[HD_DIM])
{
    ptrdiff_t place = at[HD_DIM - 1];
    for (int d = HD_DIM - 2; d >= 0; d--) place = place * (cells->size[d] + 1) + at[d];
    return &cells->cell[place];
}

/** The cells around one, itself among them; those at one side of it. */
enum { HD_CELLS_AROUND = HD_DIM == 2 ? 9 : 27, HD_CELLS_BESIDE = HD_CELLS_AROUND / 3 };

/** Which side of a cell number k of those around it is at in direction d: 0 low, 1 here, 2 high. */
static inline int hd_cells_side(int k, int d)
{
    return d == 0 ? k % 3 : d == 1 ? k / 3 % 3 : k / 9;
}

/** Number k of those around a disk's cell that are at a side of it in direction d, among all. */
static inline int hd_cells_beside(int k, int d, int side)
{
    const int step = d == 0 ? 1 : d == 1 ? 3 : 9; /* of that direction among all */
    return k / step * 3 * step + side * step + k % step;
}

/** Number k of the cells around that of a disk. */
static inline hd_cell *hd_cells_near(const hd_cells *cells, const hd_disk *disk, int k)
{
    int32_t at[HD_DIM];
    for (int d = 0; d < HD_DIM; d++)
        at[d] = cells->line[d][disk->cell[d]].near[hd_cells_side(k, d)];
    return hd_cells_at(cells, at);
}

/** The disk after j in the list of a crowded cell that cell->disk[HD_CELL_DISKS - 1] heads, or -1.
 */
static inline int32_t hd_cells_next(const hd_cells *cells, int32_t j) { return cells->next[j]; }

#endif
