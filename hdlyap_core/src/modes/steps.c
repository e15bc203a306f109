/** Resolved sets -> steps: exponents with errors, labels of the vectors, zero modes [T12]. */
#include "modes/steps.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "averages/spectrum.h"
#include "base/check.h"
#include "base/memory.h"
#include "modes/fields.h"
#include "modes/modes.h"
#include "modes/sets.h"
#include "modes/sharing.h"
#include "scene/scene.h"

struct hd_steps {
    const hd_modes *modes;
    hd_half positive, negative;
    hd_sets sets;
    int zero_first, zero_end; /**< columns of the zero modes, as far as they are carried */
    int subspaces, count, vectors;
    int rows;       /**< 4N */
    int zeros;      /**< exponents that vanish, as theory says */
    bool paired;    /**< exponents are in pairs, so that theory says where */
    int most;       /**< most vectors of a step */
    hd_step *step;  /**< [count] */
    int *of_vector; /**< [vectors] */
    double *share;  /**< [count][most]: share of the step in the weight of each vector of its set */
    hd_part *parts; /**< [count * most], workspace */
    hd_set_membership *company; /**< [count] */
    double warmup;              /**< time for which the frame was carried before averaging */
    hd_relation of_t, of_lp;
};

/* ---- creation ------------------------------------------------------------------------------ */

static void step_define(hd_step *step, const hd_fields *fields, int s, bool conjugate)
{
    const hd_subspace *subspace = hd_fields_subspace(fields, s);
    *step = (hd_step){.kind = subspace->kind,
                      .wave = subspace->wave,
                      .subspace = s,
                      .expected = subspace->dimension,
                      .conjugate = conjugate};
}

/** Most vectors of a step: those of the largest set, or all zero modes. */
static int most_of(const hd_scene_def *scene)
{
    const int zeros = hd_scene_zero_exponents(scene);
    return zeros > HD_SET_VECTORS_MAX ? zeros : HD_SET_VECTORS_MAX;
}

double hd_steps_bytes(const hd_scene_def *scene)
{
    const double n = hd_scene_vectors(scene), subspaces = hd_fields_count_of(scene).subspaces;
    const double count = subspaces *
                             (n == 2.0 * hd_scene_coordinates(scene) * scene->number ? 2.0 : 1.0) +
                         1.0;
    const double of_a_vector = sizeof(double) + sizeof(hd_part);
    return count * (sizeof(hd_step) + sizeof(hd_set_membership) + most_of(scene) * of_a_vector) +
           n * (sizeof(int) + sizeof(double));
}

static hd_status steps_allocate(hd_steps *steps)
{
    const size_t count = (size_t)steps->count, n = (size_t)steps->vectors,
                 most = (size_t)steps->most;
    steps->step = hd_memory_alloc(count, sizeof *steps->step);
    steps->of_vector = hd_memory_alloc(n, sizeof *steps->of_vector);
    steps->share = hd_memory_alloc(count * most, sizeof *steps->share);
    steps->parts = hd_memory_alloc(count * most, sizeof *steps->parts);
    steps->company = hd_memory_alloc(count, sizeof *steps->company);
    if (!steps->step || !steps->of_vector || !steps->share || !steps->parts || !steps->company)
        return HD_NO_MEMORY;
    return hd_sets_create(&steps->sets, steps->modes, steps->rows);
}

/** The shares of step k, one for each vector of its set. */
static double *shares_of(const hd_steps *steps, int k)
{
    return steps->share + (size_t)k * (size_t)steps->most;
}

static int smaller(int a, int b) { return a < b ? a : b; }

/** Finds the columns of the two halves and of the zero modes, as far as the frame reaches. */
static void place(hd_steps *steps, int positive, int zero)
{
    const int n = steps->vectors, end = positive + zero;
    steps->positive = (hd_half){0, smaller(n, positive)};
    steps->zero_first = smaller(n, positive);
    steps->zero_end = smaller(n, end);
    steps->negative = (hd_half){end, steps->rows};
}

/** The same where it is told by the exponents alone, as far as it is. */
static void place_by_sign(hd_steps *steps, const hd_spectrum *spectrum)
{
    const hd_signs signs = hd_spectrum_signs(spectrum, steps->zeros);
    if (signs.zero >= steps->zeros && signs.zero <= steps->most)
        place(steps, signs.positive, signs.zero);
}

hd_status hd_steps_create(hd_steps **out, const hd_scene_def *def, const hd_modes *modes)
{
    hd_steps *steps = hd_memory_alloc(1, sizeof *steps);
    *out = NULL;
    if (!steps) return HD_NO_MEMORY;
    const hd_fields *fields = hd_modes_fields(modes);
    steps->modes = modes;
    steps->vectors = hd_modes_vectors(modes);
    steps->rows = 2 * hd_scene_coordinates(def) * def->number;
    steps->zeros = hd_scene_zero_exponents(def);
    steps->paired = hd_scene_symplectic(def);
    steps->most = most_of(def);
    steps->warmup = hd_scene_parting(def);
    steps->of_t = hd_relation_of(def, HD_MODE_T);
    steps->of_lp = hd_relation_of(def, HD_MODE_LP);
    steps->subspaces = hd_fields_subspaces(fields);
    const bool all = steps->vectors == steps->rows;
    steps->count = steps->subspaces * (all ? 2 : 1) + 1;
    place(steps, hd_scene_positive_exponents(def), steps->zeros);
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
        .kind = HD_MODE_ZERO, .subspace = -1, .expected = steps->zeros};
    hd_steps_clear(steps);
    *out = steps;
    return HD_OK;
}

void hd_steps_free(hd_steps *steps)
{
    if (!steps) return;
    hd_memory_free(steps->step);
    hd_sets_clear(&steps->sets);
    hd_memory_free(steps->parts);
    hd_memory_free(steps->company);
    hd_memory_free(steps->of_vector);
    hd_memory_free(steps->share);
    hd_memory_free(steps);
}

static void step_forget(hd_step *step)
{
    step->resolved = false;
    step->col = step->set = -1;
    step->count = step->members = 0;
    step->multiplicity = step->exponent = 0.0;
    step->std_error = -1.0;
    step->sharing = HD_SHARING_ALONE;
    step->mixing = step->set_time = step->own_part = step->gap = step->gap_error = 0.0;
}

static void steps_forget(hd_steps *steps)
{
    for (int k = 0; k < steps->count; k++) step_forget(&steps->step[k]);
    for (int col = 0; col < steps->vectors; col++) steps->of_vector[col] = -1;
}

void hd_steps_clear(hd_steps *steps)
{
    steps_forget(steps);
    memset(steps->company, 0, (size_t)steps->count * sizeof *steps->company);
}

/* ---- steps --------------------------------------------------------------------------------- */

/** Writes `factor` times the mean exponent of a step's set as parts of a sum, each vector weighted
 * by its share; returns their number. */
static int mean_parts(const hd_steps *steps, int k, double factor, hd_part *parts)
{
    const hd_step *step = &steps->step[k];
    const double *share = shares_of(steps, k);
    double whole = 0.0;
    for (int v = 0; v < step->count; v++) whole += share[v];
    for (int v = 0; v < step->count; v++)
        parts[v] = (hd_part){step->col + v, factor * share[v] / whole};
    return step->count;
}

static void step_measure(const hd_steps *steps, int k, const hd_spectrum *spectrum)
{
    hd_step *step = &steps->step[k];
    const int count = mean_parts(steps, k, 1.0, steps->parts);
    step->exponent = 0.0;
    for (int p = 0; p < count; p++)
        step->exponent += steps->parts[p].factor *
                          hd_spectrum_exponent(spectrum, steps->parts[p].series);
    step->std_error = hd_spectrum_error_of_sum(spectrum, steps->parts, count);
}

double hd_steps_error_of_sum(const hd_steps *steps, const hd_spectrum *spectrum,
                             double (*factor)(const hd_step *, const void *), const void *context)
{
    int count = 0;
    for (int k = 0; k < steps->count; k++) {
        if (!steps->step[k].resolved) continue;
        const double f = factor(&steps->step[k], context);
        if (f != 0) count += mean_parts(steps, k, f, steps->parts + count);
    }
    return hd_spectrum_error_of_sum(spectrum, steps->parts, count);
}

/** Adds what mixing does to the error of step k, whose neighbours' exponents are known. */
static void step_mix(const hd_steps *steps, int k, const hd_spectrum *spectrum)
{
    hd_step *step = &steps->step[k];
    if (!(step->std_error >= 0)) return;
    step->mixing = hd_sharing_mixing(steps->step, steps->count, k, steps->modes, spectrum,
                                     steps->rows);
    step->std_error = hypot(step->std_error, step->mixing);
}

/** Says that a vector belongs to step k, unless another step has more weight in it. */
static void label(hd_steps *steps, int col, int k, const double *weight)
{
    const int now = steps->of_vector[col];
    if (now >= 0) {
        const double *before = hd_modes_average(steps->modes, steps->step[now].subspace, HD_WEIGHT);
        if (before[col] >= weight[col]) return;
    }
    steps->of_vector[col] = k;
}

/** Fills step k, whose subspace s is in this resolved set; the set has been weighed. */
static void step_fill(hd_steps *steps, int k, int s, int set)
{
    const hd_set *w = &steps->sets.set[set];
    const double *weight = hd_modes_average(steps->modes, s, HD_WEIGHT);
    const double least = hd_sets_threshold(steps->rows, w->count);
    hd_step *step = &steps->step[k];
    step->resolved = true;
    step->col = w->col;
    step->count = w->count;
    for (int other = 0; other < steps->subspaces; other++)
        step->members += steps->sets.of[other] == set;
    step->multiplicity = hd_sets_trace(&steps->sets, s, w);
    for (int v = 0; v < w->count; v++) {
        const double whole = steps->sets.weight[w->col + v];
        shares_of(steps, k)[v] = weight[w->col + v] / fmax(whole, DBL_MIN);
        if (whole >= least) label(steps, w->col + v, k, weight);
    }
}

/** Finds the steps of one half of the spectrum; offset: index of its first step. */
static void half_find(hd_steps *steps, const hd_spectrum *spectrum, hd_half half, int offset,
                      int *number)
{
    hd_sets *sets = &steps->sets;
    hd_sets_find(sets, spectrum, half);
    for (int set = 0; set < steps->subspaces; set++) {
        if (sets->set[set].count == 0) continue;
        hd_sets_weigh(sets, set, half);
        for (int s = 0; s < steps->subspaces; s++) {
            if (sets->of[s] != set) continue;
            step_fill(steps, offset + s, s, set);
            steps->step[offset + s].set = *number;
        }
        ++*number;
    }
}

static double null_weight(const hd_steps *steps, int col)
{
    const int nulls = hd_fields_nulls(hd_modes_fields(steps->modes));
    double sum = 0.0;
    for (int k = 0; k < nulls; k++) sum += hd_modes_null_average(steps->modes, k)[col];
    return sum;
}

/** Fills the step of zero modes, in the middle of the spectrum, as far as the frame reaches. */
static void zero_find(hd_steps *steps, int *sets)
{
    const int k = steps->subspaces, count = steps->zero_end - steps->zero_first;
    hd_step *step = &steps->step[k];
    double trace = 0.0;
    for (int col = steps->zero_first; col < steps->zero_end; col++)
        trace += null_weight(steps, col);
    const double chance = (double)step->expected / steps->rows;
    const double least = chance + HD_STEPS_THRESHOLD * (1.0 - chance);
    if (count == 0 || !(trace >= least * count)) return;
    step->resolved = true;
    step->col = steps->zero_first;
    step->count = count;
    step->members = 1;
    step->set = (*sets)++;
    step->multiplicity = fmin(trace, step->expected); /* a damped momentum is in null fields, too */
    for (int v = 0; v < count; v++) {
        shares_of(steps, k)[v] = 1.0;
        if (null_weight(steps, step->col + v) >= least) steps->of_vector[step->col + v] = k;
    }
}

void hd_steps_find(hd_steps *steps, const hd_spectrum *spectrum)
{
    int sets = 0;
    steps_forget(steps);
    if (hd_modes_samples(steps->modes) == 0) return;
    if (!steps->paired) place_by_sign(steps, spectrum);
    half_find(steps, spectrum, steps->positive, 0, &sets);
    zero_find(steps, &sets);
    if (steps->count > steps->subspaces + 1)
        half_find(steps, spectrum, steps->negative, steps->subspaces + 1, &sets);
    for (int k = 0; k < steps->count; k++)
        if (steps->step[k].resolved) step_measure(steps, k, spectrum);
    for (int k = 0; k < steps->count; k++) step_mix(steps, k, spectrum);
    hd_sharing_find(steps->step, steps->company, steps->count, steps->modes, spectrum,
                    steps->warmup + hd_spectrum_time(spectrum));
}

int hd_steps_count(const hd_steps *steps) { return steps->count; }
const hd_modes *hd_steps_modes(const hd_steps *steps) { return steps->modes; }

const hd_relation *hd_steps_relation(const hd_steps *steps, hd_mode_kind kind)
{
    return kind == HD_MODE_T ? &steps->of_t : &steps->of_lp;
}

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

int hd_steps_example(const hd_steps *steps, int index)
{
    const hd_step *step = hd_steps_step(steps, index);
    for (int col = step->col; col < step->col + step->count; col++)
        if (steps->of_vector[col] == index) return col;
    return step->col;
}

static bool is_positive(const hd_step *step) { return step->resolved && !step->conjugate; }

bool hd_steps_is_shown(const hd_steps *steps, int index)
{
    const hd_step *step = hd_steps_step(steps, index);
    if (!is_positive(step) || step->kind == HD_MODE_ZERO) return false;
    for (int k = 0; k < index; k++) {
        const hd_step *before = hd_steps_step(steps, k);
        if (before->resolved && before->set == step->set) return false;
    }
    return true;
}

int hd_steps_lowest(const hd_steps *steps, hd_mode_kind kind)
{
    int lowest = -1;
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        if (step->kind != kind || !is_positive(step)) continue;
        if (lowest < 0 || step->exponent < hd_steps_step(steps, lowest)->exponent) lowest = s;
    }
    return lowest;
}

int hd_steps_first(const hd_steps *steps)
{
    int first = INT_MAX;
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        if (step->resolved && step->col < first) first = step->col;
    }
    return first;
}

/* ---- file ---------------------------------------------------------------------------------- */

/** Reads or writes the members of a step that are not determined by its scene. */
static void step_archive(hd_steps *steps, hd_step *step, hd_archive *archive)
{
    int resolved = step->resolved;
    hd_archive_int(archive, "step resolved", &resolved, 0, 1);
    step->resolved = resolved;
    hd_archive_int(archive, "step col", &step->col, -1, steps->vectors - 1);
    hd_archive_int(archive, "step count", &step->count, 0, steps->most);
    hd_archive_int(archive, "step set", &step->set, -1, steps->count - 1);
    hd_archive_int(archive, "step members", &step->members, 0, steps->count);
    hd_archive_double(archive, "step multiplicity", &step->multiplicity);
    hd_archive_double(archive, "step exponent", &step->exponent);
    hd_archive_double(archive, "step error", &step->std_error);
    hd_archive_double(archive, "step mixing", &step->mixing);
    int sharing = (int)step->sharing;
    hd_archive_int(archive, "step sharing", &sharing, HD_SHARING_ALONE, HD_SHARING_COINCIDENT);
    step->sharing = (hd_sharing)sharing;
    hd_archive_double(archive, "step set time", &step->set_time);
    hd_archive_double(archive, "step own part", &step->own_part);
    hd_archive_double(archive, "step gap", &step->gap);
    hd_archive_double(archive, "step gap error", &step->gap_error);
    const int least = step->kind == HD_MODE_ZERO ? 1 : step->expected;
    const bool whole = step->col >= 0 && step->count >= least && step->set >= 0 &&
                       step->col + step->count <= steps->vectors;
    hd_archive_expect(archive, whole || !step->resolved, "step",
                      "its vectors are too few, or are not carried");
}

/** Reads or writes steps without their sets, which are found again from the averages. */
void hd_steps_archive(hd_steps *steps, hd_archive *archive)
{
    const size_t count = (size_t)steps->count;
    for (size_t k = 0; k < count; k++) step_archive(steps, &steps->step[k], archive);
    for (size_t k = 0; k < count; k++) hd_set_membership_archive(&steps->company[k], archive);
    hd_archive_doubles(archive, "steps share", steps->share, count * (size_t)steps->most);
    hd_archive_of_ints(archive, "steps of vector", (size_t)steps->vectors);
    for (int col = 0; col < steps->vectors; col++)
        hd_archive_next_int(archive, &steps->of_vector[col], -1, steps->count - 1);
}
