/** Vectors of the steps -> response of density, momentum and energy [T15].
 *
 * Each response is a linear functional of (dq, dp). Its coefficients at one particle multiply the
 * particle's rows of the frame, for all vectors of the step at once. */
#include "observe/hydro.h"

#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "modes/fields.h"
#include "modes/steps.h"
#include "modes/sets.h"
#include "observe/functionals.h"
#include "observe/observable.h"
#include "scene/kinds.h"
#include "scene/scene.h"

/** Holds a response for each vector of each step and each modulation; see entries_of. */
struct hd_hydro {
    hd_boundary boundary[HD_DIMENSION_MAX];
    int dimension, particles, vectors, count;
    hd_kinds kinds;
    hd_hydro_response *response; /**< [count] */
};

static int modulations_of(const hd_step *step)
{
    return step->kind == HD_MODE_ZERO ? 0 : step->wave.pairs.count;
}

/** Number of entries of a step: its vectors, and for each one its modulations. */
static int entries_of(const hd_step *step) { return step->expected * modulations_of(step); }

/** Names the entries of all steps: none has been measured. */
static void entries_name(hd_hydro_response *out, const hd_steps *steps)
{
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        const hd_modulations m = step->wave.pairs;
        for (int e = 0; e < entries_of(step); e++)
            *out++ = (hd_hydro_response){.step = k, .col = -1, .modulation = m.bits[e % m.count]};
    }
}

hd_status hd_hydro_create(hd_hydro **out, const hd_scene_def *def, const hd_steps *steps)
{
    hd_hydro *hydro = hd_memory_alloc(1, sizeof *hydro);
    *out = NULL;
    if (!hydro) return HD_NO_MEMORY;
    memcpy(hydro->boundary, def->boundary, sizeof hydro->boundary);
    hydro->dimension = hd_scene_dimension(def);
    hydro->particles = def->number;
    hydro->vectors = hd_scene_vectors(def);
    hydro->kinds = hd_kinds_of(def);
    for (int k = 0; k < hd_steps_count(steps); k++)
        hydro->count += entries_of(hd_steps_step(steps, k));
    hydro->response = hd_memory_alloc((size_t)hydro->count + 1, sizeof *hydro->response);
    if (!hydro->response) {
        hd_hydro_free(hydro);
        return HD_NO_MEMORY;
    }
    entries_name(hydro->response, steps);
    *out = hydro;
    return HD_OK;
}

void hd_hydro_free(hd_hydro *hydro)
{
    if (!hydro) return;
    hd_memory_free(hydro->response);
    hd_memory_free(hydro);
}

/** Coefficients of a displacement and of a change of p -> of the weighted ones [T26]. With the
 * weighted momentum in place of p, those of the momentum's sums lack the root of the mass. */
static void weigh(hd_functionals f, int dimension, double root)
{
    for (int r = 0; r < HD_FUNCTIONALS_IN(dimension); r++) {
        const double of_sum = r > 0 && r <= dimension ? root : 1.0;
        for (int d = 0; d < 2 * dimension; d++) f[r][d] *= d < dimension ? of_sum / root : of_sum;
    }
}

/** Fills sum[functionals][HD_SET_VECTORS_MAX] for the vectors of a step, at one modulation. */
static void measure(const hd_hydro *hydro, double sum[HD_FUNCTIONALS_MAX][HD_SET_VECTORS_MAX],
                    const hd_step *step, unsigned bits, hd_columns vectors, const double *q,
                    const double *p)
{
    const size_t stride = (size_t)vectors.stride;
    const int dimension = hydro->dimension, rows = 2 * dimension;
    memset(sum, 0, HD_FUNCTIONALS_MAX * sizeof *sum);
    for (int j = 0; j < hydro->particles; j++) {
        const double *row = vectors.data + (size_t)(rows * j) * stride +
                            (step->col - vectors.first);
        hd_functionals f;
        hd_functionals_at(f, dimension, &step->wave, bits, hydro->boundary, q + dimension * j,
                          p + dimension * j);
        weigh(f, dimension, hd_kinds_root(&hydro->kinds, j));
        for (int r = 0; r < HD_FUNCTIONALS_IN(dimension); r++)
            for (int d = 0; d < rows; d++)
                for (int v = 0; v < step->count; v++)
                    sum[r][v] += f[r][d] * row[(size_t)d * stride + (size_t)v];
    }
}

/** Measures the vectors that belong to a step, one after the other. */
static void step_measure(hd_hydro *hydro, hd_hydro_response *out, const hd_steps *steps, int index,
                         hd_columns vectors, const double *q, const double *p)
{
    const hd_step *step = hd_steps_step(steps, index);
    const hd_modulations m = step->wave.pairs;
    const double scale = 1.0 / sqrt(0.5 * hydro->particles);
    double sum[HD_FUNCTIONALS_MAX][HD_SET_VECTORS_MAX];
    for (int c = 0; c < m.count; c++) {
        int found = 0;
        measure(hydro, sum, step, m.bits[c], vectors, q, p);
        for (int v = 0; v < step->count && found < step->expected; v++) {
            if (hd_steps_of_vector(steps, step->col + v) != index) continue;
            hd_hydro_response *r = &out[found++ * m.count + c];
            double *const of[] = {&r->density, &r->along, &r->across,
                                  hydro->dimension == 3 ? &r->across_second : &r->energy,
                                  &r->energy};
            r->col = step->col + v;
            for (int k = 0; k < HD_FUNCTIONALS_IN(hydro->dimension); k++)
                *of[k] = scale * sum[k][v];
        }
    }
}

void hd_hydro_clear(hd_hydro *hydro)
{
    for (int k = 0; k < hydro->count; k++) {
        hd_hydro_response *r = &hydro->response[k];
        *r = (hd_hydro_response){.step = r->step, .col = -1, .modulation = r->modulation};
    }
}

void hd_hydro_measure(hd_hydro *hydro, const hd_steps *steps, hd_columns vectors, const double *q,
                      const double *p)
{
    hd_hydro_response *out = hydro->response;
    hd_hydro_clear(hydro);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->resolved && modulations_of(step) > 0)
            step_measure(hydro, out, steps, k, vectors, q, p);
        out += entries_of(step);
    }
}

int hd_hydro_count(const hd_hydro *hydro) { return hydro->count; }

const hd_hydro_response *hd_hydro_at(const hd_hydro *hydro, int index)
{
    HD_ASSERT(index >= 0 && index < hydro->count);
    return &hydro->response[index];
}

/* ---- as an observable ---------------------------------------------------------------------- */

/** Bytes: a wave with d pairs has 2 d vectors of LP and at most as many of T, each with d
 * responses. */
static double hydro_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(hd_hydro_response) * 2.0 * hd_fields_count_of(scene).lp_phases;
}

static void hydro_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    (void)scene;
    if (self) extent->responses = hd_hydro_count(self);
}

static void *hydro_create(const hd_observing *with, hd_status *status)
{
    hd_hydro *made;
    *status = hd_hydro_create(&made, with->scene, with->part[HD_OBSERVED_steps]);
    return made;
}

static void hydro_free(void *self) { hd_hydro_free(self); }

static void hydro_clear(void *self, const hd_moment *now)
{
    (void)now;
    hd_hydro_clear(self);
}

static void hydro_report(void *self, const hd_moment *now)
{
    hd_hydro_measure(self, now->with->part[HD_OBSERVED_steps], now->vectors[0], now->q, now->p);
}

static int hydro_first(void *self, const hd_moment *now)
{
    (void)self;
    return hd_steps_first(now->with->part[HD_OBSERVED_steps]);
}

/** Reads or writes the responses of the last report. */
static void hydro_archive(void *self, const hd_moment *now)
{
    hd_hydro *hydro = self;
    hd_archive *archive = now->archive;
    hd_archive_of_ints(archive, "hydro col", (size_t)hydro->count);
    for (int k = 0; k < hydro->count; k++)
        hd_archive_next_int(archive, &hydro->response[k].col, -1, hydro->vectors - 1);
    hd_archive_of_doubles(archive, "hydro response", 5 * (size_t)hydro->count);
    for (int k = 0; k < hydro->count; k++) {
        hd_hydro_response *r = &hydro->response[k];
        double *const numbers[] = {&r->density, &r->along, &r->across, &r->energy,
                                   &r->across_second};
        for (int n = 0; n < 5; n++) hd_archive_next_doubles(archive, numbers[n], 1);
    }
}

/** Refuses particles with other coordinates than places, or with a potential: functionals know only
 * positions, their momenta, and kinetic energy. */
static hd_status hydro_check(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    const bool turn = hd_scene_coordinates(scene) > hd_scene_dimension(scene);
    if (!turn && of->scale_invariant) return HD_OK;
    return hd_refuse(message, size,
                     "observables = hydro: must not be given with particles = %s, %s",
                     of->particles, turn ? "which turn" : "whose energy is not kinetic alone");
}

const hd_observable hd_hydro_row = {.with = HD_OBSERVE_STEPS,
                                    .needs = HD_NEEDS_FRAME | HD_NEEDS_VECTORS | HD_NEEDS_REPORTS |
                                             HD_NEEDS_STATE | HD_NEEDS_ALL | HD_NEEDS_EDGES,
                                    .check = hydro_check,
                                    .bytes = hydro_bytes,
                                    .extend = hydro_extend,
                                    .create = hydro_create,
                                    .free = hydro_free,
                                    .clear = hydro_clear,
                                    .report = hydro_report,
                                    .first = hydro_first,
                                    .archive = hydro_archive};
