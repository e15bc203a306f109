/** Average weights and exponents -> steps and dispersion relation [T12].
 *
 *  A set starts as the window of columns, as long as the expected multiplicity, with the largest trace of one
 *  subspace. Sets whose windows overlap, or which have much of their weight in each other's windows, are merged:
 *  there the steps coincide and the vectors mix. A set is resolved if every member is found in its
 *  window to HD_STEP_THRESHOLD and its exponents are flat. */
#include "hdlyap/steps.h"

#include <math.h>
#include <string.h>

#include "blocks.h"
#include "check.h"
#include "memory.h"

/** Below this part of its multiplicity a subspace is nowhere. */
static const double CANDIDATE = 0.25;
/** Weight of a set in another's window, over that in its own, from which on they mix. */
static const double LEAK = 0.5;
/** Largest deviation of an exponent from the mean of its set, beside 3 standard errors. */
static const double FLAT = 0.1;

/** Columns [first, end) of one half of the spectrum. */
typedef struct half {
    int first, end;
} half;

typedef struct window {
    int col, count;
    double trace;
} window;

struct hd_steps {
    const hd_modes *modes;
    half positive, negative;
    int zero_first, zero_end; /**< columns of the zero modes carried */
    int subspaces, count, vectors;
    int rows;         /**< 4N */
    hd_step *step;    /**< [count] */
    window *set;      /**< [subspaces], scratch: of the sets */
    int *set_of;      /**< [subspaces], scratch: set of each subspace, -1 */
    double *work;     /**< [vectors]: weight in a set */
    int *of_vector;   /**< [vectors] */
    double *share;    /**< [count][HD_STEP_VECTORS_MAX]: of each vector of the set in this step */
    double *sample;   /**< [count] */
    hd_blocks blocks; /**< of the means of all steps */
    double blocks_time;
    long *identity; /**< [count], of which vectors each step consisted */
    long changes;
};

/* ---- creation --------------------------------------------------------------------------------- */

static void step_define(hd_step *step, const hd_fields *fields, int s, bool conjugate)
{
    const hd_subspace *subspace = hd_fields_subspace(fields, s);
    *step = (hd_step){.kind = subspace->kind,
                      .wave = subspace->wave,
                      .subspace = s,
                      .expected = subspace->dimension,
                      .conjugate = conjugate};
}

static hd_status steps_allocate(hd_steps *steps)
{
    const size_t count = (size_t)steps->count, n = (size_t)steps->vectors;
    steps->step = hd_memory_alloc(count, sizeof *steps->step);
    steps->set = hd_memory_alloc(count, sizeof *steps->set);
    steps->set_of = hd_memory_alloc(count, sizeof *steps->set_of);
    steps->work = hd_memory_alloc(n, sizeof *steps->work);
    steps->of_vector = hd_memory_alloc(n, sizeof *steps->of_vector);
    steps->share = hd_memory_alloc(count * HD_STEP_VECTORS_MAX, sizeof *steps->share);
    steps->sample = hd_memory_alloc(count, sizeof *steps->sample);
    steps->identity = hd_memory_alloc(count, sizeof *steps->identity);
    if (!steps->step || !steps->set || !steps->set_of || !steps->work || !steps->of_vector ||
        !steps->share || !steps->sample || !steps->identity)
        return HD_NO_MEMORY;
    return hd_blocks_create(&steps->blocks, steps->count);
}

static int smaller(int a, int b) { return a < b ? a : b; }

/** Where the halves and the zero modes lie; a frame need not reach so far. */
static void place(hd_steps *steps, const hd_scene_def *def)
{
    const int n = steps->vectors, all = 4 * def->disks;
    const int positive = (all - hd_scene_zero_exponents(def)) / 2;
    steps->positive = (half){0, smaller(n, positive)};
    steps->zero_first = smaller(n, positive);
    steps->zero_end = smaller(n, all - positive);
    steps->negative = (half){all - positive, all};
}

hd_status hd_steps_create(hd_steps **out, const hd_scene_def *def, const hd_modes *modes)
{
    hd_steps *steps = hd_memory_alloc(1, sizeof *steps);
    *out = NULL;
    if (!steps) return HD_NO_MEMORY;
    const hd_fields *fields = hd_modes_fields(modes);
    steps->modes = modes;
    steps->vectors = hd_modes_vectors(modes);
    steps->rows = 4 * def->disks;
    steps->subspaces = hd_fields_subspaces(fields);
    const bool all = steps->vectors == 4 * def->disks;
    steps->count = steps->subspaces * (all ? 2 : 1) + 1;
    place(steps, def);
    const hd_status status = steps_allocate(steps);
    if (status != HD_OK) {
        hd_steps_free(steps);
        return status;
    }
    for (int s = 0; s < steps->subspaces; s++) {
        step_define(&steps->step[s], fields, s, false);
        if (all) step_define(&steps->step[steps->subspaces + 1 + s], fields, s, true);
    }
    steps->step[steps->subspaces] = (hd_step){
        .kind = HD_MODE_ZERO, .subspace = -1, .expected = hd_scene_zero_exponents(def)};
    hd_steps_clear(steps);
    *out = steps;
    return HD_OK;
}

void hd_steps_free(hd_steps *steps)
{
    if (!steps) return;
    hd_memory_free(steps->step);
    hd_memory_free(steps->set);
    hd_memory_free(steps->set_of);
    hd_memory_free(steps->work);
    hd_memory_free(steps->of_vector);
    hd_memory_free(steps->share);
    hd_memory_free(steps->sample);
    hd_memory_free(steps->identity);
    hd_blocks_clear(&steps->blocks);
    hd_memory_free(steps);
}

static void step_forget(hd_step *step)
{
    step->resolved = false;
    step->col = step->set = -1;
    step->count = step->members = 0;
    step->multiplicity = step->exponent = 0.0;
    step->std_error = -1.0;
}

static void steps_forget(hd_steps *steps)
{
    for (int k = 0; k < steps->count; k++) step_forget(&steps->step[k]);
    for (int col = 0; col < steps->vectors; col++) steps->of_vector[col] = -1;
}

static void errors_restart(hd_steps *steps)
{
    hd_blocks_restart(&steps->blocks);
    steps->blocks_time = 0.0;
}

void hd_steps_clear(hd_steps *steps)
{
    steps_forget(steps);
    errors_restart(steps);
    steps->changes++;
}

/* ---- sets of one half ------------------------------------------------------------------------- */

/** steps->work[col] = average weight of every vector in all members of a set. */
static void weigh(hd_steps *steps, int set, half h)
{
    for (int col = h.first; col < h.end; col++) steps->work[col] = 0.0;
    for (int s = 0; s < steps->subspaces; s++) {
        if (steps->set_of[s] != set) continue;
        const double *weight = hd_modes_average(steps->modes, s, HD_WEIGHT);
        for (int col = h.first; col < h.end; col++) steps->work[col] += weight[col];
    }
}

/** Window of `count` columns with the largest sum of work. */
static window best_window(const double *work, half h, int count)
{
    window best = {h.first, count, -1.0};
    double trace = 0.0;
    for (int col = h.first; col < h.end; col++) {
        trace += work[col];
        if (col - count >= h.first) trace -= work[col - count];
        if (col - count + 1 >= h.first && trace > best.trace)
            best = (window){col - count + 1, count, trace};
    }
    return best;
}

static bool inside(const window *w, int col) { return col >= w->col && col < w->col + w->count; }

/** Weight of set a (in work) within the window of b but outside its own. */
static double leak(const hd_steps *steps, int a, int b)
{
    double sum = 0.0;
    for (int k = 0; k < steps->set[b].count; k++) {
        const int col = steps->set[b].col + k;
        if (!inside(&steps->set[a], col)) sum += steps->work[col];
    }
    return sum;
}

static bool overlap(const window *a, const window *b)
{
    return a->col < b->col + b->count && b->col < a->col + a->count;
}

static double mean_exponent(const hd_spectrum *spectrum, const window *w)
{
    double sum = 0.0;
    for (int k = 0; k < w->count; k++) sum += hd_spectrum_exponent(spectrum, w->col + k);
    return sum / w->count;
}

/** The set that set a mixes with, -1 if none. The weights of a are in work. */
static int partner(const hd_steps *steps, const hd_spectrum *spectrum, int a)
{
    const window *own = &steps->set[a];
    for (int b = 0; b < steps->subspaces; b++) {
        const window *other = &steps->set[b];
        if (b == a || other->count == 0) continue;
        const double here = mean_exponent(spectrum, own), there = mean_exponent(spectrum, other);
        const bool near = fabs(here - there) <= FLAT * fabs(here);
        if (overlap(own, other) || (near && leak(steps, a, b) > LEAK * own->trace)) return b;
    }
    return -1;
}

/** Set b takes in set a and moves to its new window; more vectors than there are cannot be named. */
static void absorb(hd_steps *steps, half h, int a, int b)
{
    for (int s = 0; s < steps->subspaces; s++)
        if (steps->set_of[s] == a) steps->set_of[s] = b;
    const int count = steps->set[a].count + steps->set[b].count;
    steps->set[a].count = 0;
    weigh(steps, b, h);
    steps->set[b] = count <= h.end - h.first ? best_window(steps->work, h, count) : (window){0};
}

/** One set per subspace that is somewhere, numbered like it. */
static void sets_begin(hd_steps *steps, half h)
{
    for (int s = 0; s < steps->subspaces; s++) {
        const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(steps->modes), s);
        const int d = subspace->dimension;
        steps->set[s] = (window){0};
        steps->set_of[s] = -1;
        if (d > h.end - h.first) continue;
        const double *weight = hd_modes_average(steps->modes, s, HD_WEIGHT);
        const window w = best_window(weight, h, d);
        if (w.trace < CANDIDATE * d) continue;
        steps->set[s] = w;
        steps->set_of[s] = s;
    }
}

/** Merges until no set mixes with another. */
static void sets_merge(hd_steps *steps, const hd_spectrum *spectrum, half h)
{
    for (int a = 0; a < steps->subspaces; a++) {
        if (steps->set[a].count == 0) continue;
        weigh(steps, a, h);
        const int b = partner(steps, spectrum, a);
        if (b < 0) continue;
        absorb(steps, h, a, b);
        a = -1; /* once more from the first */
    }
}

/* ---- steps ------------------------------------------------------------------------------------ */

/** Least weight that counts as found in d dimensions: random vectors have chance = d / 2N on average, of the
 *  rest HD_STEP_THRESHOLD is asked. Fields that fill half of the space tell nothing. */
static double threshold(const hd_steps *steps, int d)
{
    const double chance = d / (0.5 * steps->rows);
    return chance > 0.5 ? INFINITY : chance + HD_STEP_THRESHOLD * (1.0 - chance);
}

static bool is_flat(const hd_spectrum *spectrum, const window *w)
{
    const double mean = mean_exponent(spectrum, w);
    for (int col = w->col; col < w->col + w->count; col++) {
        const double error = fmax(hd_spectrum_std_error(spectrum, col), 0.0);
        if (!(fabs(hd_spectrum_exponent(spectrum, col) - mean) <= FLAT * fabs(mean) + 3.0 * error))
            return false;
    }
    return true;
}

static double trace_in(const hd_steps *steps, int s, const window *w)
{
    const double *weight = hd_modes_average(steps->modes, s, HD_WEIGHT);
    double trace = 0.0;
    for (int k = 0; k < w->count; k++) trace += weight[w->col + k];
    return trace;
}

static bool is_resolved(const hd_steps *steps, const hd_spectrum *spectrum, int set)
{
    const window *w = &steps->set[set];
    if (w->count == 0 || w->count > HD_STEP_VECTORS_MAX || !is_flat(spectrum, w)) return false;
    for (int s = 0; s < steps->subspaces; s++) {
        if (steps->set_of[s] != set) continue;
        const int d = hd_fields_subspace(hd_modes_fields(steps->modes), s)->dimension;
        if (!(trace_in(steps, s, w) >= threshold(steps, d) * d)) return false;
    }
    return true;
}

/** Mean of values over the set of a step, each vector by its share. */
static double shared_mean(const hd_steps *steps, int k, double (*value)(const hd_spectrum *, int),
                          const hd_spectrum *spectrum)
{
    const double *share = steps->share + (size_t)k * HD_STEP_VECTORS_MAX;
    double sum = 0.0, weight = 0.0;
    for (int v = 0; v < steps->step[k].count; v++) {
        sum += share[v] * value(spectrum, steps->step[k].col + v);
        weight += share[v];
    }
    return sum / weight;
}

/** Error of the running mean: from blocks of the step's own mean, which know how its vectors fluctuate
 *  together, scaled to the whole time if the set is younger; until then as if all went together. */
static double step_error(const hd_steps *steps, int k, const hd_spectrum *spectrum)
{
    const double error = hd_blocks_std_error(&steps->blocks, k);
    if (error >= 0) return error * sqrt(steps->blocks_time / hd_spectrum_time(spectrum));
    for (int v = 0; v < steps->step[k].count; v++)
        if (hd_spectrum_std_error(spectrum, steps->step[k].col + v) < 0) return -1.0;
    return shared_mean(steps, k, hd_spectrum_std_error, spectrum);
}

/** Fills step k, of subspace s in a resolved set; steps->work holds the weights in the set. */
static void step_fill(hd_steps *steps, int k, int s, int set)
{
    const window *w = &steps->set[set];
    const double *weight = hd_modes_average(steps->modes, s, HD_WEIGHT);
    hd_step *step = &steps->step[k];
    step->resolved = true;
    step->col = w->col;
    step->count = w->count;
    step->members = 0;
    for (int other = 0; other < steps->subspaces; other++)
        step->members += steps->set_of[other] == set;
    step->multiplicity = trace_in(steps, s, w);
    for (int v = 0; v < w->count; v++) {
        const int col = w->col + v, now = steps->of_vector[col];
        const double share = weight[col] / fmax(steps->work[col], 1e-300);
        steps->share[(size_t)k * HD_STEP_VECTORS_MAX + (size_t)v] = share;
        if (!(steps->work[col] >= threshold(steps, w->count))) continue;
        if (now < 0 ||
            weight[col] > hd_modes_average(steps->modes, steps->step[now].subspace, HD_WEIGHT)[col])
            steps->of_vector[col] = k;
    }
}

/** offset: of the half's steps among all. */
static void half_find(hd_steps *steps, const hd_spectrum *spectrum, half h, int offset, int *sets)
{
    sets_begin(steps, h);
    sets_merge(steps, spectrum, h);
    for (int set = 0; set < steps->subspaces; set++) {
        if (!is_resolved(steps, spectrum, set)) continue;
        weigh(steps, set, h);
        for (int s = 0; s < steps->subspaces; s++) {
            if (steps->set_of[s] != set) continue;
            step_fill(steps, offset + s, s, set);
            steps->step[offset + s].set = *sets;
        }
        ++*sets;
    }
}

static double null_weight(const hd_steps *steps, int col)
{
    double sum = 0.0;
    for (int k = 0; k < HD_NULLS; k++) sum += hd_modes_null_average(steps->modes, k)[col];
    return sum;
}

/** The zero modes lie where the spectrum is symmetric, as far as the frame reaches. */
static void zero_find(hd_steps *steps, int *sets)
{
    const int k = steps->subspaces, count = steps->zero_end - steps->zero_first;
    hd_step *step = &steps->step[k];
    double trace = 0.0;
    for (int col = steps->zero_first; col < steps->zero_end; col++)
        trace += null_weight(steps, col);
    const double chance = (double)step->expected / steps->rows;
    const double least = chance + HD_STEP_THRESHOLD * (1.0 - chance);
    if (count == 0 || !(trace >= least * count)) return;
    step->resolved = true;
    step->col = steps->zero_first;
    step->count = count;
    step->members = 1;
    step->set = (*sets)++;
    step->multiplicity = trace;
    for (int v = 0; v < count; v++) {
        steps->share[(size_t)k * HD_STEP_VECTORS_MAX + (size_t)v] = 1.0;
        if (null_weight(steps, step->col + v) >= least) steps->of_vector[step->col + v] = k;
    }
}

/** True if any step consists of other vectors than the last time. */
static bool sets_changed(hd_steps *steps)
{
    bool changed = false;
    for (int k = 0; k < steps->count; k++) {
        const long identity = steps->step[k].col * 1000L + steps->step[k].count;
        changed |= identity != steps->identity[k];
        steps->identity[k] = identity;
    }
    return changed;
}

void hd_steps_find(hd_steps *steps, const hd_spectrum *spectrum)
{
    int sets = 0;
    steps_forget(steps);
    if (hd_modes_samples(steps->modes) == 0) return;
    half_find(steps, spectrum, steps->positive, 0, &sets);
    zero_find(steps, &sets);
    if (steps->count > steps->subspaces + 1)
        half_find(steps, spectrum, steps->negative, steps->subspaces + 1, &sets);
    if (sets_changed(steps)) {
        errors_restart(steps);
        steps->changes++;
    }
    for (int k = 0; k < steps->count; k++) {
        hd_step *step = &steps->step[k];
        if (!step->resolved) continue;
        step->exponent = shared_mean(steps, k, hd_spectrum_exponent, spectrum);
        step->std_error = step_error(steps, k, spectrum);
    }
}

void hd_steps_sample(hd_steps *steps, const hd_spectrum *spectrum, double length)
{
    for (int k = 0; k < steps->count; k++)
        steps->sample[k] = steps->step[k].resolved
                               ? shared_mean(steps, k, hd_spectrum_local, spectrum)
                               : 0.0;
    hd_blocks_add(&steps->blocks, steps->sample);
    steps->blocks_time += length;
}

int hd_steps_count(const hd_steps *steps) { return steps->count; }
const hd_modes *hd_steps_modes(const hd_steps *steps) { return steps->modes; }
long hd_steps_changes(const hd_steps *steps) { return steps->changes; }

const hd_step *hd_steps_step(const hd_steps *steps, int index)
{
    HD_ASSERT(index >= 0 && index < steps->count);
    return &steps->step[index];
}

int hd_steps_of_vector(const hd_steps *steps, int col)
{
    HD_ASSERT(col >= 0 && col < steps->vectors);
    return steps->of_vector[col];
}
