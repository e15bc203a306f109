/** Cells divide the box. They are wider than the largest distance of two centres that meet, so a
 * disk can only meet disks in its cell and in the cells next to it, some of them as images. */
#ifndef HD_CELLS_H
#define HD_CELLS_H

#include <stddef.h>

#include "dynamics/hard/disk.h"
#include "hdlyap/scene.h"

/** One column (row, layer) of cells: its two ends, and the columns next to it. */
typedef struct hd_cell_line {
    double bound[2];   /**< lowest and highest centre; at a wall, where centres are reflected */
    int32_t near[3];   /**< index of the column below, itself, above; hd_cells.size beyond a wall */
    int32_t shift[4];  /**< box edges to add to positions in near[] (-1, 0, 1); the last is spare */
    int8_t inwards[2]; /**< of bound: 1 or -1, the way into the box, at a wall whose distance is the
                          radius of each disk; else 0 */
} hd_cell_line;

/** Where the centre of a disk meets an end, low or high, of a line of cells. */
static inline double hd_cell_line_end(const hd_cell_line *line, int high, double radius)
{
    return HD_MIXED ? line->bound[high] + line->inwards[high] * radius : line->bound[high];
}

enum { HD_CELL_DISKS = 3 };

/** The disks of one cell, in any order. */
typedef struct hd_cell {
    int32_t disk[HD_CELL_DISKS]; /**< the last place heads a list, which takes all further disks */
    int16_t count;               /**< places taken */
    int16_t crowded;             /**< 1 if the list has more than one disk */
} hd_cell;

typedef struct hd_cells {
    double box[HD_DIM];
    hd_boundary boundary[HD_DIM];
    int32_t size[HD_DIM];       /**< number of columns, rows and, for spheres, layers */
    hd_cell_line *line[HD_DIM]; /**< [size[d]] */
    hd_cell *cell; /**< [product of (size[d] + 1)]; the last column, row, layer stay empty */
    int32_t *next; /**< [disks]: the next disk in the list of a crowded cell; -1 at its end */
} hd_cells;

/** reach: largest distance of two centres that meet; 1 for disks. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_cells_create(hd_cells *cells, const hd_scene_def *def, double reach);
void hd_cells_clear(hd_cells *cells);

/** Enters disk i, whose position q is inside the box, in the cell at q. */
void hd_cells_add(hd_cells *cells, hd_disk *disks, int32_t i);

/** Enters disk i in the cell disks[i].cell, whatever its position is. */
void hd_cells_book(hd_cells *cells, const hd_disk *disks, int32_t i);

/** Takes all disks out of all cells. */
void hd_cells_empty(hd_cells *cells);

/** Moves disk i to the next cell in direction d, below (side 0) or above (side 2). */
void hd_cells_cross(hd_cells *cells, hd_disk *disks, int32_t i, int d, int side);

/** Folds the position back into the box. The disk stays in its cell. */
static inline void hd_cells_fold(const hd_cells *cells, hd_disk *disk)
{
    for (int d = 0; d < HD_DIM; d++) {
        if (cells->boundary[d] != HD_PERIODIC) continue;
        const double turns = floor(disk->q[d] / cells->box[d]);
        disk->q[d] -= turns * cells->box[d];
        disk->wrap[d] -= (int32_t)turns;
    }
}

/** The cell in column at[0], row at[1] (and layer at[2]); beyond a wall, an empty cell. */
static inline hd_cell *hd_cells_at(const hd_cells *cells, const int32_t at[HD_DIM])
{
    ptrdiff_t place = at[HD_DIM - 1];
    for (int d = HD_DIM - 2; d >= 0; d--) place = place * (cells->size[d] + 1) + at[d];
    return &cells->cell[place];
}

/** How many cells there are around a cell, itself among them, and how many of them are at one side
 * of it. */
enum { HD_CELLS_AROUND = HD_DIM == 2 ? 9 : 27, HD_CELLS_BESIDE = HD_CELLS_AROUND / 3 };

/** On which side of a cell the k-th of the cells around it lies in direction d: 0 below, 1 neither,
 * 2 above. */
static inline int hd_cells_side(int k, int d)
{
    return d == 0 ? k % 3 : d == 1 ? k / 3 % 3 : k / 9;
}

/** Index, among all cells around a cell, of the k-th of those at one side of it in direction d. */
static inline int hd_cells_beside(int k, int d, int side)
{
    const int step = d == 0 ? 1 : d == 1 ? 3 : 9; /* between neighbours in direction d */
    return k / step * 3 * step + side * step + k % step;
}

/** The k-th of the cells around the cell of a disk. */
static inline hd_cell *hd_cells_near(const hd_cells *cells, const hd_disk *disk, int k)
{
    int32_t at[HD_DIM];
    for (int d = 0; d < HD_DIM; d++)
        at[d] = cells->line[d][disk->cell[d]].near[hd_cells_side(k, d)];
    return hd_cells_at(cells, at);
}

/** The disk after j in the list of a crowded cell, which cell->disk[HD_CELL_DISKS - 1] heads; -1 at
 * its end. */
static inline int32_t hd_cells_next(const hd_cells *cells, int32_t j) { return cells->next[j]; }

#endif
