/** Steps that share a set -> whether they coincide or still mix [T12].
 *
 * Columns are in the order of their exponents, whatever vectors they hold. So each member of a set,
 * in the order of the members' exponents, has columns of its own: as many as it has dimensions. The
 * exponents of these columns differ if those of the members do, even while the vectors mix. */
#include "modes/sharing.h"

#include <math.h>

#include "averages/spectrum.h"
#include "modes/modes.h"
#include "modes/sets.h"

/** Exponents differ if their difference exceeds this many standard errors. */
static const double DIFFERENT = 3.0;
/** Exponents are called the same only if three standard errors of their gap are below this part of
 * the exponent. */
static const double PRECISE = 0.03;
/** Vectors separate like exp(-gap t): once gap t exceeds this they have had the time. */
static const double FOLDS = 10.0;

/** Vectors mix if their exponents differ by less than this part. */
static const double NEAR = 0.2;

/** A member's own columns; count 0: no member. */
typedef struct group {
    int col, count;
} group;

/** Step a comes before b in their set. */
static bool before(const hd_step *step, int a, int b)
{
    if (step[a].exponent != step[b].exponent) return step[a].exponent > step[b].exponent;
    return a < b;
}

/** The own columns of step k; next: the members before and after it (-1: none). */
static group own_columns(const hd_step *step, int count, int k, int next[2])
{
    group own = {step[k].col, step[k].expected};
    next[0] = next[1] = -1;
    for (int other = 0; other < count; other++) {
        if (other == k || step[other].set != step[k].set) continue;
        const int side = before(step, other, k) ? 0 : 1;
        if (side == 0) own.col += step[other].expected;
        if (next[side] < 0 || before(step, next[side], other) == (side == 0)) next[side] = other;
    }
    return own;
}

static double group_mean(const hd_spectrum *spectrum, group g)
{
    double sum = 0.0;
    for (int v = 0; v < g.count; v++) sum += hd_spectrum_exponent(spectrum, g.col + v);
    return sum / g.count;
}

/** Standard error of the difference of two members' mean exponents. */
static double gap_error(const hd_spectrum *spectrum, group a, group b)
{
    hd_part parts[2 * HD_SET_VECTORS_MAX];
    int count = 0;
    for (int v = 0; v < a.count; v++) parts[count++] = (hd_part){a.col + v, 1.0 / a.count};
    for (int v = 0; v < b.count; v++) parts[count++] = (hd_part){b.col + v, -1.0 / b.count};
    return hd_spectrum_error_of_sum(spectrum, parts, count);
}

/** Smallest gap to a member next to step k. */
static void find_gap(hd_step *step, int count, int k, const hd_spectrum *spectrum)
{
    int next[2], none[2];
    const group own = own_columns(step, count, k, next);
    step[k].gap = INFINITY;
    for (int side = 0; side < 2; side++) {
        if (next[side] < 0) continue;
        const group other = own_columns(step, count, next[side], none);
        const double gap = fabs(group_mean(spectrum, own) - group_mean(spectrum, other));
        if (gap >= step[k].gap) continue;
        step[k].gap = gap;
        step[k].gap_error = gap_error(spectrum, own, other);
    }
}

/** Part of the step's weight in its set that lies in its own columns. */
static double own_part(const hd_step *step, int count, int k, const hd_modes *modes)
{
    const double *weight = hd_modes_average(modes, step[k].subspace, HD_WEIGHT);
    int next[2];
    const group own = own_columns(step, count, k, next);
    double sum = 0.0;
    for (int v = 0; v < own.count; v++) sum += weight[own.col + v];
    return step[k].multiplicity > 0 ? fmin(sum / step[k].multiplicity, 1.0) : 0.0;
}

static hd_sharing sharing_of(const hd_step *step, double age)
{
    const double least = DIFFERENT * step->gap_error;
    if (step->gap_error < 0) return HD_SHARING_UNKNOWN;
    if (!(step->gap > least))
        return least <= PRECISE * fabs(step->exponent) ? HD_SHARING_COINCIDENT : HD_SHARING_UNKNOWN;
    return step->gap * age < FOLDS ? HD_SHARING_MIXING : HD_SHARING_BLENDED;
}

/** The mean exponent of a step's own columns is what it has if columns are its vectors; that of all
 * near columns, weighted by what they hold of its fields, if its vectors follow the fields. The
 * truth may be anywhere between them, and the exponent at either end. */
double hd_sharing_mixing(const hd_step *step, int count, int k, const hd_modes *modes,
                         const hd_spectrum *spectrum, int rows)
{
    if (step[k].subspace < 0) return 0.0;
    const double *weight = hd_modes_average(modes, step[k].subspace, HD_WEIGHT);
    const double chance = 2.0 * step[k].expected / rows;
    int next[2];
    const double own = group_mean(spectrum, own_columns(step, count, k, next));
    double whole = 0.0, off = 0.0;
    for (int col = 0; col < hd_modes_vectors(modes); col++) {
        const double apart = hd_spectrum_exponent(spectrum, col) - own;
        if (fabs(apart) > NEAR * fabs(own)) continue;
        const double found = weight[col] - chance;
        whole += found;
        off += found * apart;
    }
    return whole > 0 ? fabs(off / whole) / sqrt(3.0) : 0.0;
}

static uint64_t members_of(const hd_step *step, int count, int k)
{
    uint64_t members = 0;
    for (int other = 0; other < count; other++)
        if (step[k].resolved && step[other].set == step[k].set)
            members = 1000003 * members + (uint64_t)other + 1;
    return members;
}

void hd_sharing_find(hd_step *step, hd_set_membership *company, int count, const hd_modes *modes,
                     const hd_spectrum *spectrum, double age)
{
    const double now = hd_spectrum_time(spectrum);
    for (int k = 0; k < count; k++) {
        const uint64_t members = members_of(step, count, k);
        if (members != company[k].members) company[k] = (hd_set_membership){members, now};
        if (!step[k].resolved) continue;
        step[k].set_time = now - company[k].since;
        step[k].own_part = 1.0;
        if (step[k].members < 2) continue;
        find_gap(step, count, k, spectrum);
        step[k].own_part = own_part(step, count, k, modes);
        step[k].sharing = sharing_of(&step[k], age);
    }
}

void hd_set_membership_archive(hd_set_membership *company, hd_archive *archive)
{
    hd_archive_bits(archive, "step company", &company->members);
    hd_archive_double(archive, "step company since", &company->since);
}
