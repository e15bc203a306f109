/** Cells -> whom a disk may meet, and when. See nearby.h. One thread. */
#include "events/nearby.h"

#include <string.h>

#include "base/multiversion.h"

/* ---- who ----------------------------------------------------------------------------------- */

typedef int32_t int_quad __attribute__((vector_size(16)));

static inline int_quad spread(int32_t x) { return (int_quad){x, x, x, x}; }

/** Images of the cells below, at and above a line, as a disk with those wraps sees them. */
static inline int_quad images_of(const hd_cell_line *line, int32_t wrap)
{
    int_quad shift;
    memcpy(&shift, line->shift, sizeof shift);
    return shift + wrap;
}

/** Adds the disks in a cell's places: copies the whole cell, and counts what is in it. */
static inline void add_cell(hd_nearby *near, const hd_cell *cell, int_quad x, int_quad y)
{
    const int32_t count = near->count;
    memcpy(&near->disk[count], cell, sizeof *cell);
    memcpy(&near->image[0][count], &x, sizeof x);
    memcpy(&near->image[1][count], &y, sizeof y);
    near->count = count + cell->count;
    near->crowded |= cell->crowded;
}

void hd_nearby_around(hd_nearby *near, const hd_cells *cells, const hd_disk *disk)
{
    const hd_cell_line column = cells->line[0][disk->cell[0]], row = cells->line[1][disk->cell[1]];
    const int_quad x = images_of(&column, disk->wrap[0]), y = images_of(&row, disk->wrap[1]);
    near->count = near->crowded = 0;
    for (int v = 0; v < 3; v++) {
        const hd_cell *first = hd_cells_at(cells, 0, row.near[v]);
        for (int u = 0; u < 3; u++)
            add_cell(near, &first[column.near[u]], spread(x[u]), spread(y[v]));
    }
}

void hd_nearby_beside(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int d, int side)
{
    const hd_cell_line column = cells->line[0][disk->cell[0]], row = cells->line[1][disk->cell[1]];
    near->count = near->crowded = 0;
    for (int k = 0; k < 3; k++) {
        const int u = d == 0 ? side : k, v = d == 0 ? k : side;
        add_cell(near, hd_cells_at(cells, column.near[u], row.near[v]),
                 spread(column.shift[u] + disk->wrap[0]), spread(row.shift[v] + disk->wrap[1]));
    }
}

int32_t hd_nearby_listed(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int u, int v,
                         int32_t j)
{
    const int32_t x = cells->line[0][disk->cell[0]].shift[u] + disk->wrap[0];
    const int32_t y = cells->line[1][disk->cell[1]].shift[v] + disk->wrap[1];
    near->count = 0;
    while (near->count < HD_NEARBY_MAX && (j = hd_cells_next(cells, j)) >= 0) {
        near->disk[near->count] = j;
        near->image[0][near->count] = x;
        near->image[1][near->count++] = y;
    }
    return j;
}

/* ---- when ---------------------------------------------------------------------------------- */

/** Contacts in one step: two pairs, for one computation to fill the waits of the other. */
enum { STEP = HD_NEARBY_SPARE };

/** The earliest contact in each half of the pairs so far; NaN never gets in. */
typedef struct earliest {
    hd_pair t;
    hd_pair_mask number, tied; /**< tied: another one was as early as the earliest up to then */
} earliest;

static inline void earliest_lower(earliest *e, hd_pair t, int64_t k)
{
    const hd_pair_mask less = t < e->t, number = {k, k + 1};
    e->tied |= t == e->t;
    e->t = hd_pair_where(less, t, e->t);
    e->number = (less & number) | (~less & e->number);
}

static inline int earliest_number(const earliest *e)
{
    const int64_t number[HD_DIM] = {e->number[0], e->number[1]};
    const double t = e->t[1] < e->t[0] ? e->t[1] : e->t[0];
    if (t == INFINITY) return HD_NEARBY_NONE;
    if ((e->t[0] == e->t[1]) | (int)(e->tied[0] | e->tied[1])) return HD_NEARBY_TIED;
    return (int)number[e->t[1] < e->t[0]];
}

/** Contacts of the two disks a with numbers k and k + 1. */
static inline hd_pair contacts_with(const hd_two_disks *a, const hd_nearby *near, int k,
                                    const hd_disk *disks, const double box[HD_DIM])
{
    const hd_disk *b0 = &disks[near->disk[k]], *b1 = &disks[near->disk[k + 1]];
    const int32_t *x = &near->image[0][k], *y = &near->image[1][k];
    const hd_two_disks b = hd_two_disks_of(b0, b1);
    const hd_pair edges_x = {x[0] - b0->wrap[0], x[1] - b1->wrap[0]};
    const hd_pair edges_y = {y[0] - b0->wrap[1], y[1] - b1->wrap[1]};
    return hd_contact_times(a, &b, edges_x * box[0], edges_y * box[1]);
}

/** hd_nearby_contacts, without what fills the last step. */
HD_MULTIVERSION
static int contacts(double *contact, const hd_nearby *near, const hd_disk *disks, int32_t i,
                    const double box[HD_DIM])
{
    const hd_two_disks a = hd_two_disks_of(&disks[i], &disks[i]);
    earliest e = {.t = hd_pair_both(INFINITY)};
    for (int k = 0; k < near->count; k += STEP) {
        const hd_pair t = contacts_with(&a, near, k, disks, box);
        const hd_pair u = contacts_with(&a, near, k + 2, disks, box);
        memcpy(&contact[k], &t, sizeof t);
        memcpy(&contact[k + 2], &u, sizeof u);
        earliest_lower(&e, t, k);
        earliest_lower(&e, u, k + 2);
    }
    return earliest_number(&e);
}

int hd_nearby_contacts(double *contact, hd_nearby *near, const hd_disk *disks, int32_t i,
                       const double box[HD_DIM])
{
    const int_quad self = spread(i), zero = spread(0);
    memcpy(&near->disk[near->count], &self, sizeof self); /* it never meets itself: p = 0 */
    for (int d = 0; d < HD_DIM; d++) memcpy(&near->image[d][near->count], &zero, sizeof zero);
    return contacts(contact, near, disks, i, box);
}
