/** Scene -> start positions of dumbbells. It tries rows along either direction, in line or
 * staggered, with bonds along the rows or across them, and takes the rows with the largest gap. It
 * uses + - * / sqrt only. */
#include "dynamics/dumbbells/dumbbells.h"

#include <math.h>
#include <stdbool.h>

#include "scene/container.h"
#include "scene/scene.h"

/** Gap between the last row and a wall, over the distance of rows. Without it, dumbbells would
 * start in contact with the wall. */
static const double AT_WALL = 0.1;

typedef struct rows {
    int along; /**< direction of the rows */
    int lies;  /**< direction of the bonds */
    int rows, columns;
    double shift;                 /**< shift of every other row, over the distance of columns */
    double column, row, first[2]; /**< distances; first site, along and across the rows */
    double gap;                   /**< least gap between two dumbbells */
} rows;

/** The distance of `count` sites along an edge of this length; negative if there is no room. first:
 * place of the first site. Between walls, sites are at least `reach` away from a wall, and there is
 * room for the shift of every other row, `more` distances. Without walls the edge must be above
 * `least`. */
static double spacing(double *first, double length, int count, double more, hd_boundary boundary,
                      double reach, double least)
{
    const double room = length - 2.0 * reach, gaps = count - 1 + more + 2.0 * AT_WALL;
    *first = boundary == HD_PERIODIC ? 0.25 * length / count : reach + room * AT_WALL / gaps;
    if (boundary == HD_PERIODIC) return length > least ? length / count : -1.0;
    return room >= HD_MEMORY_LIMIT_MIN ? room / gaps : -1.0;
}

/** The gap between two parallel dumbbells whose centres are (x, y) apart, x along the bonds. */
static double gap_of(double x, double y, double bond)
{
    double least = INFINITY;
    for (int k = -1; k <= 1; k++) least = fmin(least, (x + k * bond) * (x + k * bond) + y * y);
    return sqrt(least) - 1.0;
}

/** How many sites after one, this far apart, could hold what touches it: as far as there are sites,
 * or all round. */
static int sites_near(double length, double apart, int count)
{
    return (int)fmin(1.0 + length / apart, count);
}

/** The least gap between a dumbbell and those that come after it and could touch it. It stops at a
 * gap of at most `lost`, which is no better than the best rows so far. */
static double least_gap(const rows *r, const hd_boundary *boundary, double bond, double lost)
{
    const bool round[2] = {boundary[r->along] == HD_PERIODIC,
                           boundary[1 - r->along] == HD_PERIODIC};
    const int far[2] = {1 + sites_near(1.0 + bond, r->column, r->columns),
                        sites_near(1.0 + bond, r->row, r->rows)};
    double least = INFINITY;
    for (int n = 0; n <= far[1] && least > lost; n++)
        for (int c = -far[0]; c <= far[0] && least > lost; c++) {
            const bool other = n > 0 || c > 0;
            const bool is_there = (n < r->rows || round[1]) &&
                                  ((c < r->columns && -c <= r->columns) || round[0]);
            const double x = (c + r->shift * (n % 2)) * r->column, y = n * r->row;
            if (!other || !is_there) continue;
            least = fmin(least, r->lies == r->along ? gap_of(x, y, bond) : gap_of(y, x, bond));
        }
    return least;
}

static void try_rows(rows *best, const hd_scene_def *def, const double *box, rows r)
{
    const double bond = hd_dumbbell_bond(def);
    const hd_boundary *boundary = def->boundary;
    const double reach[2] = {0.5 + (r.lies == r.along ? 0.5 * bond : 0.0),
                             0.5 + (r.lies == r.along ? 0.0 : 0.5 * bond)};
    r.columns = (int)(((int64_t)def->number + r.rows - 1) / r.rows);
    if (r.shift > 0 && (r.rows == 1 || (boundary[1 - r.along] == HD_PERIODIC && r.rows % 2 == 1)))
        return;
    r.column = spacing(&r.first[0], box[r.along], r.columns, r.shift, boundary[r.along], reach[0],
                       1.0 + bond);
    r.row = spacing(&r.first[1], box[1 - r.along], r.rows, 0, boundary[1 - r.along], reach[1],
                    1.0 + bond);
    const double lost = fmax(best->gap, 0.0); /* dumbbells that touch are of no use */
    r.gap = r.column > 0 && r.row > 0 ? least_gap(&r, boundary, bond, lost) : -1.0;
    if (r.gap > best->gap) *best = r;
}

/** Tries all numbers of rows for which the distances of rows and of columns are within a factor of
 * 9; others are never dense. */
static void try_shift(rows *best, const hd_scene_def *def, const double *box, rows r)
{
    const double most = 9.0, square = def->number * box[1 - r.along] / box[r.along];
    const int least = (int)fmin(def->number, fmax(1.0, sqrt(square / most)));
    const int last = (int)fmin(def->number, 1.0 + sqrt(square * most));
    for (r.rows = least; r.rows <= last; r.rows++) try_rows(best, def, box, r);
}

/** Tries rows that interlock: with long bonds, the disks of every other row fit into the gaps of
 * the row before. */
static void interlock(rows *best, const hd_scene_def *def, const double *box, int along)
{
    const double bond = hd_dumbbell_bond(def);
    for (int k = 0; k <= 8; k++) {
        const double column = 1.0 + bond + 0.125 * k * (bond - 1.0),
                     between = fmin(bond, column - bond);
        try_shift(best, def, box,
                  (rows){.along = along, .lies = along, .shift = 0.5 * between / column});
    }
}

static rows best_of(const hd_scene_def *def)
{
    rows best = {.gap = -1.0};
    double box[HD_DIMENSION_MAX];
    hd_scene_box(def, box);
    for (int kind = 0; kind < 8; kind++)
        try_shift(&best, def, box,
                  (rows){.along = kind & 1, .lies = kind >> 1 & 1, .shift = kind >> 2 ? 0.5 : 0.0});
    for (int along = 0; along < 2 && best.gap < HD_START_DISTANCE_MIN - 1.0; along++)
        interlock(&best, def, box, along);
    return best;
}

double hd_dumbbell_start_gap(const hd_scene_def *def) { return best_of(def).gap; }

double hd_dumbbell_density_max(const hd_scene_def *def)
{
    enum { BISECTIONS = 30 };
    hd_scene_def trial = *def;
    double low = 0.0, high = 2.0;
    for (int k = 0; k < BISECTIONS; k++) {
        trial.density = 0.5 * (low + high);
        *(best_of(&trial).gap >= HD_START_DISTANCE_MIN - 1.0 ? &low : &high) = trial.density;
    }
    return low;
}

void hd_dumbbell_start(const hd_scene_def *def, double *q)
{
    const rows r = best_of(def);
    const int64_t sites = (int64_t)r.rows * r.columns;
    const double turned = r.lies == 0 ? 0.0 : 1.57079632679489661923; /* pi / 2 */
    int64_t site = 0;
    for (int row = 0; row < r.rows; row++)
        for (int column = 0; column < r.columns; column++, site++) {
            if (hd_site_is_spare(site, sites, def->number)) continue;
            q[r.along] = r.first[0] + (column + r.shift * (row % 2)) * r.column;
            q[1 - r.along] = r.first[1] + row * r.row;
            q[2] = turned * sqrt(hd_dumbbell_inertia(def));
            q += 3;
        }
}
