/** Which subspaces share which vectors: windows of columns, one half of the spectrum at a time
 * [T12]. */
#ifndef HD_SETS_H
#define HD_SETS_H

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/steps.h"

/** Most vectors of a set; larger sets are not resolved. */
enum { HD_SET_VECTORS_MAX = 64 };

/** Columns [first, end) of one half of the spectrum. */
typedef struct hd_half {
    int first, end;
} hd_half;

/** A set of vectors; count 0: none. */
typedef struct hd_set {
    int col, count; /**< columns [col, col + count) */
    double trace;   /**< sum of the weights of all members in these columns */
} hd_set;

typedef struct hd_sets {
    const hd_modes *modes;
    int subspaces, rows; /**< rows: 4N */
    hd_set *set;         /**< [subspaces], by the number of a member */
    int *of;             /**< [subspaces]: the set of each subspace; -1: none */
    bool *absent;   /**< [subspaces]: true if the subspace was found too weakly in its set, and left
                       out of it */
    double *weight; /**< [vectors], see hd_sets_weigh */
} hd_sets;

HD_MUST_CHECK hd_status hd_sets_create(hd_sets *sets, const hd_modes *modes, int rows);
void hd_sets_clear(hd_sets *sets);

/** Finds the resolved sets of one half from average weights and exponents. */
void hd_sets_find(hd_sets *sets, const hd_spectrum *spectrum, hd_half half);

/** Sets sets->weight[col] to the average weight of each vector of the half in all members of a set.
 */
void hd_sets_weigh(hd_sets *sets, int set, hd_half half);

/** Trace of the projection onto subspace s over a set. */
double hd_sets_trace(const hd_sets *sets, int s, const hd_set *set);

/** The part of a multiplicity that must be found, for a window of d columns (or fields of d
 * dimensions) out of rows / 2. Random vectors have chance = 2 d / rows on average; of the rest
 * HD_STEPS_THRESHOLD is required. INFINITY if chance is above 1/2. */
double hd_sets_threshold(int rows, int d);

#endif
