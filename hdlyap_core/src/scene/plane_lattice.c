/** Scene -> start positions in the plane. Tries all kinds of rows; arithmetic is + - * / sqrt only.
 */
#include "scene/plane_lattice.h"

#include <math.h>
#include <stdint.h>

#include "scene/container.h"
#include "scene/ends.h"

/** Sites of `rows` rows. */
static int64_t site_count(int64_t rows, int64_t columns, int odd_short)
{
    return rows * columns - (odd_short ? rows / 2 : 0);
}

/** Distance of neighbouring sites in a line of `count` that must fit into `length`; `half` = 1
 * leaves room for a shift by half a spacing. One site alone has no neighbour: spacing = length. */
static double spacing(double length, int64_t count, int half, hd_boundary boundary)
{
    if (boundary == HD_PERIODIC) return length / (double)count;
    const double gaps = (double)(count - 1) + 0.5 * half;
    return gaps > 0 ? (length - 1.0) / gaps : length;
}

static double smallest_distance(const hd_plane_lattice *l, hd_boundary across)
{
    double d = l->columns > 1 ? l->column : INFINITY;
    if (l->rows == 1) return d;
    const double shift = l->staggered ? 0.5 * l->column : 0.0;
    d = fmin(d, sqrt(shift * shift + l->row * l->row));
    if (l->rows > 2) d = fmin(d, 2.0 * l->row);
    if (across == HD_PERIODIC && l->rows % 2 == 1)
        d = fmin(d, l->row); /* last row meets the first */
    return d;
}

static void try_rows(hd_plane_lattice *best, int particles, int rows, int along, int kind,
                     const double *box, const hd_boundary *boundary)
{
    const hd_boundary in_row = boundary[along], across = boundary[1 - along];
    hd_plane_lattice l = {
        .along = along, .rows = rows, .staggered = kind > 0, .odd_short = kind == 2};
    int64_t columns = (particles + rows - 1) / rows;
    if (site_count(rows, columns, l.odd_short) < particles) columns++;
    if (l.odd_short && (in_row == HD_PERIODIC || columns < 2)) return;
    l.columns = (int)columns;
    l.column = spacing(box[along], columns, l.staggered && !l.odd_short && rows > 1, in_row);
    l.row = spacing(box[1 - along], rows, 0, across);
    l.distance = smallest_distance(&l, across);
    if (l.distance > best->distance) *best = l;
}

hd_plane_lattice hd_plane_lattice_best(int particles, const double *box,
                                       const hd_boundary *boundary)
{
    enum { ROW_KINDS = 3 }; /* in line, staggered, staggered with short odd rows */
    hd_plane_lattice best = {.distance = -1.0};
    for (int along = 0; along < 2; along++)
        for (int rows = 1; rows <= particles; rows++)
            for (int kind = 0; kind < ROW_KINDS; kind++)
                try_rows(&best, particles, rows, along, kind, box, boundary);
    return best;
}

static void place(const hd_plane_lattice *l, double *q, int row, int column, const double *box,
                  const hd_boundary *boundary)
{
    const int along = l->along, across = 1 - along;
    const double shift = l->staggered && row % 2 ? 0.5 : 0.0;
    const double in_row = ((double)column + shift) * l->column;
    const double off_row = (double)row * l->row;
    q[along] = boundary[along] == HD_PERIODIC ? in_row + 0.25 * l->column : 0.5 + in_row;
    q[across] = boundary[across] == HD_PERIODIC ? off_row + 0.5 * l->row : 0.5 + off_row;
    for (int d = 0; d < 2; d++)
        if (hd_is_wall(boundary[d]))
            q[d] = fmin(q[d], box[d] - 0.5); /* the last site, rounded, may lie beyond the wall */
}

void hd_plane_lattice_fill(const hd_plane_lattice *lattice, double *q, int particles,
                           const double *box, const hd_boundary *boundary)
{
    const int64_t sites = site_count(lattice->rows, lattice->columns, lattice->odd_short);
    int64_t site = 0;
    int particle = 0;
    for (int row = 0; row < lattice->rows; row++) {
        const int columns = lattice->columns - (lattice->odd_short && row % 2);
        for (int column = 0; column < columns; column++, site++) {
            if (hd_site_is_spare(site, sites, particles)) continue;
            place(lattice, q + 2 * particle++, row, column, box, boundary);
        }
    }
}
