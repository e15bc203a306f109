/** Scene -> start positions in space: the sites of a cubic lattice on a grid whose spacing is
 * about the same in all directions. Arithmetic is + - * / sqrt only. */
#include "scene/space_lattice.h"

#include <math.h>
#include <stdint.h>

#include "scene/container.h"

enum { KINDS = 3 };

static bool is_site(int kind, int x, int y, int z)
{
    if (kind == HD_LATTICE_FACES) return (x + y + z) % 2 == 0;
    return kind == HD_LATTICE_SIMPLE || (x % 2 == y % 2 && y % 2 == z % 2);
}

static int64_t site_count(int kind, const int *n)
{
    const int64_t all = (int64_t)n[0] * n[1] * n[2];
    const int64_t even = (int64_t)((n[0] + 1) / 2) * ((n[1] + 1) / 2) * ((n[2] + 1) / 2);
    const int64_t odd = (int64_t)(n[0] / 2) * (n[1] / 2) * (n[2] / 2);
    if (kind == HD_LATTICE_BODY) return even + odd;
    return kind == HD_LATTICE_FACES ? (all + 1) / 2 : all;
}

/** Spacing of `count` points in `length`; a single point has no neighbour. */
static double spacing(double length, int count, hd_boundary boundary)
{
    if (boundary == HD_PERIODIC) return length / count;
    return count > 1 ? (length - 1.0) / (count - 1) : length;
}

/** Distance of two sites that are step[d] points apart along each direction. */
static double apart(const hd_space_lattice *l, const int *step, const hd_boundary *boundary)
{
    double square = 0.0;
    for (int d = 0; d < 3; d++) {
        if (step[d] >= l->size[d] && boundary[d] != HD_PERIODIC) return INFINITY;
        square += step[d] * step[d] * l->spacing[d] * l->spacing[d];
    }
    return sqrt(square);
}

static double smallest_distance(const hd_space_lattice *l, const hd_boundary *boundary)
{
    double least = INFINITY;
    for (int k = 1; k < 27; k++) {
        const int step[3] = {k % 3, k / 3 % 3, k / 9};
        if (is_site(l->kind, step[0], step[1], step[2]))
            least = fmin(least, apart(l, step, boundary));
    }
    return least;
}

/** Whether taking every other point agrees with the periodic images: numbers of points are even. */
static bool is_even(const hd_space_lattice *l, const hd_boundary *boundary)
{
    for (int d = 0; d < 3; d++)
        if (l->kind != HD_LATTICE_SIMPLE && boundary[d] == HD_PERIODIC && l->size[d] % 2 != 0)
            return false;
    return true;
}

static void try_size(hd_space_lattice *best, int particles, int kind, const int *size,
                     const double *box, const hd_boundary *boundary)
{
    hd_space_lattice l = {.kind = kind};
    for (int d = 0; d < 3; d++) {
        if (size[d] < 1) return;
        l.size[d] = size[d];
        l.spacing[d] = spacing(box[d], size[d], boundary[d]);
    }
    if (!is_even(&l, boundary) || site_count(kind, size) < particles) return;
    l.distance = smallest_distance(&l, boundary);
    if (l.distance > best->distance) *best = l;
}

/** A number of points that stays fixed along one axis whatever the spacing is; axis -1: none. */
typedef struct held {
    int axis, points;
} held;

/** Points of the finest grid whose spacing is not below `least`. */
static void size_of(int *size, double least, held h, const double *box, const hd_boundary *boundary)
{
    for (int d = 0; d < 3; d++) {
        const double room = boundary[d] == HD_PERIODIC ? box[d] / least
                                                       : (box[d] - 1.0) / least + 1;
        size[d] = d == h.axis ? h.points : (int)fmax(1.0, fmin(floor(room), 4e6));
    }
}

/** The spacing at which just enough sites of this kind fit. */
static double spacing_of(int particles, int kind, held h, const double *box,
                         const hd_boundary *boundary)
{
    enum { BISECTIONS = 60 };
    double low = 0.0, high = fmax(box[0], fmax(box[1], box[2]));
    for (int k = 0; k < BISECTIONS; k++) {
        const double middle = 0.5 * (low + high);
        int size[3];
        size_of(size, middle, h, box, boundary);
        const double sites = (double)size[0] * size[1] * size[2];
        const bool enough = sites > 8.0 * particles || site_count(kind, size) >= particles;
        *(enough ? &low : &high) = middle;
    }
    return low;
}

static void try_around(hd_space_lattice *best, int particles, int kind, held h, const double *box,
                       const hd_boundary *boundary)
{
    enum { AROUND = 3, WIDTH = 2 * AROUND + 1 }; /* points more or fewer along each direction */
    int size[3];
    size_of(size, spacing_of(particles, kind, h, box, boundary), h, box, boundary);
    for (int k = 0; k < WIDTH * WIDTH * WIDTH; k++) {
        const int near[3] = {size[0] + k % WIDTH - AROUND, size[1] + k / WIDTH % WIDTH - AROUND,
                             size[2] + k / (WIDTH * WIDTH) - AROUND};
        if (h.axis < 0 || near[h.axis] == h.points)
            try_size(best, particles, kind, near, box, boundary);
    }
}

/** Also tries grids with few layers between walls, which may lie farther apart than their sites. */
hd_space_lattice hd_space_lattice_best(int particles, const double *box,
                                       const hd_boundary *boundary)
{
    enum { LAYERS = 6 };
    hd_space_lattice best = {.distance = -1.0};
    for (int kind = 0; kind < KINDS; kind++) {
        try_around(&best, particles, kind, (held){-1, 0}, box, boundary);
        for (int axis = 0; axis < 3; axis++)
            for (int layers = 1; layers <= LAYERS && boundary[axis] != HD_PERIODIC; layers++)
                try_around(&best, particles, kind, (held){axis, layers}, box, boundary);
    }
    return best;
}

static void place(const hd_space_lattice *l, double *q, const int *at, const double *box,
                  const hd_boundary *boundary)
{
    for (int d = 0; d < 3; d++) {
        const bool periodic = boundary[d] == HD_PERIODIC;
        const double along = (at[d] + (periodic ? 0.5 : 0.0)) * l->spacing[d];
        /* the last site, rounded, may lie beyond the wall */
        q[d] = periodic ? along : fmin(0.5 + along, box[d] - 0.5);
    }
}

void hd_space_lattice_fill(const hd_space_lattice *l, double *q, int particles, const double *box,
                           const hd_boundary *boundary)
{
    const int64_t sites = site_count(l->kind, l->size);
    int64_t site = 0;
    int at[3];
    for (at[2] = 0; at[2] < l->size[2]; at[2]++)
        for (at[1] = 0; at[1] < l->size[1]; at[1]++)
            for (at[0] = 0; at[0] < l->size[0]; at[0]++) {
                if (!is_site(l->kind, at[0], at[1], at[2])) continue;
                if (hd_site_is_spare(site++, sites, particles)) continue;
                place(l, q, at, box, boundary);
                q += 3;
            }
}
