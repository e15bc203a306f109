/** Cells -> the disks that a disk may meet, and when. See nearby.h. Runs in one thread. */
#include "dynamics/hard/nearby.h"

#include <string.h>

#include "base/multiversion.h"

/* ---- who ----------------------------------------------------------------------------------- */

typedef int32_t int_quad __attribute__((vector_size(16)));

static inline int_quad spread(int32_t x) { return (int_quad){x, x, x, x}; }

/** Adds the disks in the places of a cell, with the cell's image: copies the whole cell, and counts
 * only the places that are taken. */
static inline void add_cell(hd_nearby *near, const hd_cell *cell, const int32_t image[HD_DIM])
{
    const int32_t count = near->count;
    memcpy(&near->disk[count], cell, sizeof *cell);
    for (int d = 0; d < HD_DIM; d++) {
        const int_quad images = spread(image[d]);
        memcpy(&near->image[d][count], &images, sizeof images);
    }
    near->count = count + cell->count;
    near->crowded |= cell->crowded;
}

/** For each direction and side: how far to go on in the array of cells, and which image is there.
 * These are copies because the compiler cannot know that writing to hd_nearby leaves the lines
 * unchanged. */
typedef struct around {
    ptrdiff_t place[HD_DIM][3];
    int32_t image[HD_DIM][3];
} around;

static inline around around_of(const hd_cells *cells, const hd_disk *disk)
{
    around a;
    ptrdiff_t step = 1;
    for (int d = 0; d < HD_DIM; d++) {
        const hd_cell_line *line = &cells->line[d][disk->cell[d]];
        for (int side = 0; side < 3; side++) {
            a.place[d][side] = line->near[side] * step;
            a.image[d][side] = line->shift[side] + disk->wrap[d];
        }
        step *= cells->size[d] + 1;
    }
    return a;
}

void hd_nearby_around(hd_nearby *near, const hd_cells *cells, const hd_disk *disk)
{
    const around a = around_of(cells, disk);
    const hd_cell *first = cells->cell;
    near->count = near->crowded = 0;
#pragma GCC unroll 27
    for (int k = 0; k < HD_CELLS_AROUND; k++) {
        const hd_cell *cell = first;
        int32_t image[HD_DIM];
        for (int d = 0; d < HD_DIM; d++) {
            cell += a.place[d][hd_cells_side(k, d)];
            image[d] = a.image[d][hd_cells_side(k, d)];
        }
        add_cell(near, cell, image);
    }
}

/** These are a third of the cells around, too few to prepare all images and places first. The sides
 * of the directions other than d vary with k. */
void hd_nearby_beside(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int d, int side)
{
    hd_cell_line line[HD_DIM];
    for (int e = 0; e < HD_DIM; e++) line[e] = cells->line[e][disk->cell[e]];
    near->count = near->crowded = 0;
    for (int k = 0; k < HD_CELLS_BESIDE; k++) {
        int32_t at[HD_DIM], image[HD_DIM];
        for (int e = 0; e < HD_DIM; e++) {
            const int here = e == d ? side : e == (d == 0) ? k % 3 : k / 3;
            at[e] = line[e].near[here];
            image[e] = line[e].shift[here] + disk->wrap[e];
        }
        add_cell(near, hd_cells_at(cells, at), image);
    }
}

int32_t hd_nearby_listed(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int k,
                         int32_t j)
{
    near->count = 0;
    while (near->count < HD_NEARBY_MAX && (j = hd_cells_next(cells, j)) >= 0) {
        near->disk[near->count] = j;
        for (int d = 0; d < HD_DIM; d++)
            near->image[d][near->count] = cells->line[d][disk->cell[d]].shift[hd_cells_side(k, d)] +
                                          disk->wrap[d];
        near->count++;
    }
    return j;
}

/* ---- when ---------------------------------------------------------------------------------- */

/** Contacts that one step computes: two pairs, so that one is computed while the other waits for
 * its root or quotient. */
enum { STEP = HD_NEARBY_SPARE };

/** The earliest contact so far, separately for the first and the second number of the pairs. NaN
 * never counts as earlier. */
typedef struct earliest {
    hd_pair t;
    hd_pair_mask number, tied; /**< tied: a contact was as early as the earliest one before it */
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
    const int64_t number[2] = {e->number[0], e->number[1]};
    const double t = e->t[1] < e->t[0] ? e->t[1] : e->t[0];
    if (t == INFINITY) return HD_NEARBY_NONE;
    if ((e->t[0] == e->t[1]) | (int)(e->tied[0] | e->tied[1])) return HD_NEARBY_TIED;
    return (int)number[e->t[1] < e->t[0]];
}

/** Contact times of one disk, which `a` holds twice, with the k-th and (k + 1)-th disk nearby. */
static inline hd_pair contacts_with(const hd_two_disks *a, const hd_nearby *near, int k,
                                    const hd_disk *disks, const double box[HD_DIM],
                                    const hd_sizes *sizes, hd_pair radius)
{
    const hd_disk *b0 = &disks[near->disk[k]], *b1 = &disks[near->disk[k + 1]];
    const hd_two_disks b = hd_two_disks_of(b0, b1);
    hd_pair shift[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) {
        const int32_t *image = &near->image[d][k];
        const hd_pair edges = {image[0] - b0->wrap[d], image[1] - b1->wrap[d]};
        shift[d] = edges * box[d];
    }
    const hd_pair radii = {hd_sizes_radius(sizes, b0), hd_sizes_radius(sizes, b1)};
    return hd_contact_times(a, &b, shift, radius + radii);
}

/** Does what hd_nearby_contacts does, once the places of the last step are filled. */
HD_MULTIVERSION
static int listed_contacts(double *contact, const hd_nearby *near, const hd_disk *disks, int32_t i,
                           const double box[HD_DIM], const hd_sizes *sizes)
{
    const hd_pair radius = hd_pair_both(hd_sizes_radius(sizes, &disks[i]));
    const hd_two_disks a = hd_two_disks_of(&disks[i], &disks[i]);
    earliest e = {.t = hd_pair_both(INFINITY)};
    for (int k = 0; k < near->count; k += STEP) {
        const hd_pair t = contacts_with(&a, near, k, disks, box, sizes, radius);
        const hd_pair u = contacts_with(&a, near, k + 2, disks, box, sizes, radius);
        memcpy(&contact[k], &t, sizeof t);
        memcpy(&contact[k + 2], &u, sizeof u);
        earliest_lower(&e, t, k);
        earliest_lower(&e, u, k + 2);
    }
    return earliest_number(&e);
}

int hd_nearby_contacts(double *contact, hd_nearby *near, const hd_disk *disks, int32_t i,
                       const double box[HD_DIM], const hd_sizes *sizes)
{
    const int_quad self = spread(i), zero = spread(0);
    memcpy(&near->disk[near->count], &self, sizeof self); /* it never meets itself: p = 0 */
    for (int d = 0; d < HD_DIM; d++) memcpy(&near->image[d][near->count], &zero, sizeof zero);
    return listed_contacts(contact, near, disks, i, box, sizes);
}
