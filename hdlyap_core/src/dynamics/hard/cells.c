/** Scene -> cells. Their edge is a little longer than the reach, or long enough that a cell holds
 * about one disk, whichever is longer. */
#include "dynamics/hard/cells.h"

#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "scene/ends.h"
#include "scene/scene.h"

/** Shortest edge of a cell over the reach. Rounding can put a centre slightly outside its cell; the
 * margin keeps all contacts within neighbouring cells even then. */
static const double EDGE_OF_REACH = 1.0 + 1e-6;
static const double DISKS_PER_CELL = 0.75;

static void line_fill(hd_cell_line *line, int32_t size, double length, hd_boundary boundary)
{
    for (int32_t c = 0; c < size; c++) {
        hd_cell_line *l = &line[c];
        l->bound[0] = length * c / size;
        l->bound[1] = length * (c + 1) / size;
        for (int32_t k = 0; k < 3; k++) {
            const int32_t column = c + k - 1;
            l->shift[k] = column < 0 ? -1 : column >= size;
            l->near[k] = column - l->shift[k] * size;
            if (boundary != HD_PERIODIC && l->shift[k] != 0) l->near[k] = size;
            if (boundary != HD_PERIODIC) l->shift[k] = 0;
        }
    }
    if (hd_is_wall(boundary)) {
        line[0].bound[0] = HD_MIXED ? 0.0 : 0.5;
        line[size - 1].bound[1] = HD_MIXED ? length : length - 0.5;
        line[0].inwards[0] = HD_MIXED;
        line[size - 1].inwards[1] = -HD_MIXED;
    }
}

static size_t cell_count(const hd_cells *cells)
{
    size_t count = 1;
    for (int d = 0; d < HD_DIM; d++) count *= (size_t)cells->size[d] + 1;
    return count;
}

hd_status hd_cells_create(hd_cells *cells, const hd_scene_def *def, double reach)
{
    *cells = (hd_cells){.next = NULL};
    hd_scene_box(def, cells->box);
    const double place = DISKS_PER_CELL / def->density;
    const double edge = fmax(EDGE_OF_REACH * reach, HD_DIM == 2 ? sqrt(place) : cbrt(place));
    for (int d = 0; d < HD_DIM; d++) {
        cells->boundary[d] = hd_scene_boundary(def, d);
        cells->size[d] = (int32_t)fmax(1.0, floor(cells->box[d] / edge));
        cells->line[d] = hd_memory_alloc((size_t)cells->size[d], sizeof *cells->line[d]);
        if (!cells->line[d]) return HD_NO_MEMORY;
        line_fill(cells->line[d], cells->size[d], cells->box[d], cells->boundary[d]);
    }
    cells->cell = hd_memory_alloc(cell_count(cells), sizeof *cells->cell);
    cells->next = hd_memory_alloc((size_t)def->number, sizeof *cells->next);
    return cells->cell && cells->next ? HD_OK : HD_NO_MEMORY;
}

void hd_cells_clear(hd_cells *cells)
{
    for (int d = 0; d < HD_DIM; d++) hd_memory_free(cells->line[d]);
    hd_memory_free(cells->cell);
    hd_memory_free(cells->next);
    *cells = (hd_cells){0};
}

enum { LAST = HD_CELL_DISKS - 1 };

static void cell_add(hd_cells *cells, hd_cell *cell, int32_t i)
{
    if (cell->count < HD_CELL_DISKS) {
        cell->disk[cell->count++] = i;
        return;
    }
    if (!cell->crowded) cells->next[cell->disk[LAST]] = -1;
    cells->next[i] = cell->disk[LAST];
    cell->disk[LAST] = i;
    cell->crowded = 1;
}

/** Takes disk i out of its cell; another disk may move to its place. */
static void cell_remove(hd_cells *cells, hd_cell *cell, int32_t i)
{
    int32_t k = 0;
    while (k < LAST && cell->disk[k] != i) k++;
    if (k < LAST) { /* the last disk, or the head of the list, moves there */
        cell->disk[k] = cell->disk[cell->count - 1];
        i = cell->disk[LAST];
    }
    if (!cell->crowded) {
        cell->count--;
        return;
    }
    int32_t *link = &cell->disk[LAST];
    while (*link != i) link = &cells->next[*link];
    *link = cells->next[i];
    cell->crowded = cells->next[cell->disk[LAST]] >= 0;
}

static hd_cell *cell_of(const hd_cells *cells, const hd_disk *disk)
{
    return hd_cells_at(cells, disk->cell);
}

void hd_cells_book(hd_cells *cells, const hd_disk *disks, int32_t i)
{
    cell_add(cells, cell_of(cells, &disks[i]), i);
}

void hd_cells_add(hd_cells *cells, hd_disk *disks, int32_t i)
{
    for (int d = 0; d < HD_DIM; d++) {
        const int32_t c = (int32_t)(disks[i].q[d] / cells->box[d] * cells->size[d]);
        disks[i].cell[d] = c >= cells->size[d] ? cells->size[d] - 1 : c;
    }
    hd_cells_book(cells, disks, i);
}

void hd_cells_empty(hd_cells *cells)
{
    const size_t count = cell_count(cells);
    for (size_t k = 0; k < count; k++) cells->cell[k] = (hd_cell){.count = 0};
}

void hd_cells_cross(hd_cells *cells, hd_disk *disks, int32_t i, int d, int side)
{
    hd_disk *disk = &disks[i];
    cell_remove(cells, cell_of(cells, disk), i);
    const hd_cell_line *line = &cells->line[d][disk->cell[d]];
    disk->wrap[d] += line->shift[side];
    disk->cell[d] = line->near[side];
    cell_add(cells, cell_of(cells, disk), i);
}
