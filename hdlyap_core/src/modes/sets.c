/** Average weights and exponents -> sets of vectors [T12].
 *
 * A set starts as the window of columns, as long as a subspace has dimensions, with the largest
 * trace of that subspace. Sets whose windows overlap, or which have much of their weight in each
 * other's windows, are merged: there the steps coincide and the vectors mix. A set is resolved if
 * every member is found in its window and its exponents are flat. A set that is not loses its
 * weakest member, and the search begins anew. */
#include "modes/sets.h"

#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "modes/modes.h"

/** A subspace of which less than this part of its multiplicity is found has no set. */
static const double CANDIDATE = 0.25;
/** Two sets mix if the weight of one in the columns of the other's window alone, over that in its
 * own window, is above this. */
static const double LEAK = 0.25;
/** Exponents of a set may differ from their mean by this part of it, plus 3 standard errors. */
static const double FLAT = 0.1;

hd_status hd_sets_create(hd_sets *sets, const hd_modes *modes, int rows)
{
    const size_t subspaces = (size_t)hd_fields_subspaces(hd_modes_fields(modes));
    *sets = (hd_sets){.modes = modes, .subspaces = (int)subspaces, .rows = rows};
    sets->set = hd_memory_alloc(subspaces + 1, sizeof *sets->set);
    sets->of = hd_memory_alloc(subspaces + 1, sizeof *sets->of);
    sets->absent = hd_memory_alloc(subspaces + 1, sizeof *sets->absent);
    sets->weight = hd_memory_alloc((size_t)hd_modes_vectors(modes), sizeof *sets->weight);
    return sets->set && sets->of && sets->absent && sets->weight ? HD_OK : HD_NO_MEMORY;
}

void hd_sets_clear(hd_sets *sets)
{
    hd_memory_free(sets->set);
    hd_memory_free(sets->of);
    hd_memory_free(sets->absent);
    hd_memory_free(sets->weight);
    *sets = (hd_sets){0};
}

/* ---- weights ------------------------------------------------------------------------------- */

static int dimension(const hd_sets *sets, int s)
{
    return hd_fields_subspace(hd_modes_fields(sets->modes), s)->dimension;
}

void hd_sets_weigh(hd_sets *sets, int set, hd_half half)
{
    for (int col = half.first; col < half.end; col++) sets->weight[col] = 0.0;
    for (int s = 0; s < sets->subspaces; s++) {
        if (sets->of[s] != set) continue;
        const double *weight = hd_modes_average(sets->modes, s, HD_WEIGHT);
        for (int col = half.first; col < half.end; col++) sets->weight[col] += weight[col];
    }
}

double hd_sets_trace(const hd_sets *sets, int s, const hd_set *set)
{
    const double *weight = hd_modes_average(sets->modes, s, HD_WEIGHT);
    double trace = 0.0;
    for (int k = 0; k < set->count; k++) trace += weight[set->col + k];
    return trace;
}

double hd_sets_threshold(int rows, int d)
{
    const double chance = 2.0 * d / rows;
    return chance > 0.5 ? INFINITY : chance + HD_STEPS_THRESHOLD * (1.0 - chance);
}

/** Window of `count` columns with the largest sum of weights. */
static hd_set best_window(const double *weight, hd_half half, int count)
{
    hd_set best = {half.first, count, -1.0};
    double trace = 0.0;
    for (int col = half.first; col < half.end; col++) {
        trace += weight[col];
        if (col - count >= half.first) trace -= weight[col - count];
        if (col - count + 1 >= half.first && trace > best.trace)
            best = (hd_set){col - count + 1, count, trace};
    }
    return best;
}

static double mean_exponent(const hd_spectrum *spectrum, const hd_set *set)
{
    double sum = 0.0;
    for (int k = 0; k < set->count; k++) sum += hd_spectrum_exponent(spectrum, set->col + k);
    return sum / set->count;
}

/* ---- merging ------------------------------------------------------------------------------- */

static bool inside(const hd_set *set, int col)
{
    return col >= set->col && col < set->col + set->count;
}

/** Weight of set a (see hd_sets_weigh) within the window of b but outside its own. */
static double leak(const hd_sets *sets, int a, int b)
{
    double sum = 0.0;
    for (int k = 0; k < sets->set[b].count; k++) {
        const int col = sets->set[b].col + k;
        if (!inside(&sets->set[a], col)) sum += sets->weight[col];
    }
    return sum;
}

static bool overlap(const hd_set *a, const hd_set *b)
{
    return a->col < b->col + b->count && b->col < a->col + a->count;
}

/** The set that set a mixes with, -1 if none. a has been weighed. */
static int partner(const hd_sets *sets, const hd_spectrum *spectrum, int a)
{
    const hd_set *own = &sets->set[a];
    for (int b = 0; b < sets->subspaces; b++) {
        const hd_set *other = &sets->set[b];
        if (b == a || other->count == 0) continue;
        const double here = mean_exponent(spectrum, own), there = mean_exponent(spectrum, other);
        const bool near = fabs(here - there) <= FLAT * fabs(here);
        if (overlap(own, other) || (near && leak(sets, a, b) > LEAK * own->trace)) return b;
    }
    return -1;
}

/** Merges set a into set b and moves b to its new window. If the half has too few vectors for it, b
 * is empty. */
static void absorb(hd_sets *sets, hd_half half, int a, int b)
{
    const int count = sets->set[a].count + sets->set[b].count;
    for (int s = 0; s < sets->subspaces; s++)
        if (sets->of[s] == a) sets->of[s] = b;
    sets->set[a].count = 0;
    hd_sets_weigh(sets, b, half);
    const bool fits = count <= half.end - half.first;
    sets->set[b] = fits ? best_window(sets->weight, half, count) : (hd_set){0};
}

/** Makes one set, of the same number, for each subspace that is found anywhere. */
static void begin(hd_sets *sets, hd_half half)
{
    for (int s = 0; s < sets->subspaces; s++) {
        const int d = dimension(sets, s);
        sets->set[s] = (hd_set){0};
        sets->of[s] = -1;
        if (sets->absent[s] || d > half.end - half.first) continue;
        const hd_set set = best_window(hd_modes_average(sets->modes, s, HD_WEIGHT), half, d);
        if (set.trace < CANDIDATE * d) continue;
        sets->set[s] = set;
        sets->of[s] = s;
    }
}

/** Merges sets until none mixes with another. */
static void merge(hd_sets *sets, const hd_spectrum *spectrum, hd_half half)
{
    for (int a = 0; a < sets->subspaces; a++) {
        if (sets->set[a].count == 0) continue;
        hd_sets_weigh(sets, a, half);
        const int b = partner(sets, spectrum, a);
        if (b < 0) continue;
        absorb(sets, half, a, b);
        a = -1; /* starts again with the first set */
    }
}

/* ---- what is resolved ---------------------------------------------------------------------- */

static bool is_flat(const hd_spectrum *spectrum, const hd_set *set)
{
    const double mean = mean_exponent(spectrum, set);
    for (int col = set->col; col < set->col + set->count; col++) {
        const double error = fmax(hd_spectrum_std_error(spectrum, col), 0.0);
        if (!(fabs(hd_spectrum_exponent(spectrum, col) - mean) <= FLAT * fabs(mean) + 3.0 * error))
            return false;
    }
    return true;
}

/** The member of a set of which least was found, relative to its threshold. */
static int weakest(const hd_sets *sets, int set, double *part)
{
    const double least = hd_sets_threshold(sets->rows, sets->set[set].count);
    int worst = -1;
    *part = INFINITY;
    for (int s = 0; s < sets->subspaces; s++) {
        if (sets->of[s] != set) continue;
        const int d = dimension(sets, s);
        const double found = hd_sets_trace(sets, s, &sets->set[set]) / (d * least);
        if (worst >= 0 && !(found < *part)) continue;
        worst = s;
        *part = found;
    }
    return worst;
}

/** Member to leave out of a set so that the rest may be resolved; -1 if it is resolved, or empty.
 */
static int to_leave_out(const hd_sets *sets, const hd_spectrum *spectrum, int set)
{
    const hd_set *w = &sets->set[set];
    double part;
    const int s = weakest(sets, set, &part);
    if (s < 0) return -1;
    const bool nameable = w->count > 0 && w->count <= HD_SET_VECTORS_MAX;
    return nameable && part >= 1.0 && is_flat(spectrum, w) ? -1 : s;
}

void hd_sets_find(hd_sets *sets, const hd_spectrum *spectrum, hd_half half)
{
    for (int s = 0; s < sets->subspaces; s++) sets->absent[s] = false;
    for (bool changed = true; changed;) {
        begin(sets, half);
        merge(sets, spectrum, half);
        changed = false;
        for (int set = 0; set < sets->subspaces; set++) {
            const int s = to_leave_out(sets, spectrum, set);
            if (s < 0) continue;
            sets->absent[s] = changed = true;
        }
    }
}
