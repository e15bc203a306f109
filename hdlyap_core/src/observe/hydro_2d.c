/** Vectors of the steps -> response of density, momentum and energy [T15].
 *
 * Each response is a linear functional of (dq, dp): its coefficients at one disk are four numbers,
 * which meet the four rows of the disk in the frame for all vectors of the step at once. */
#include "hdlyap/hydro.h"

#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "modes/archived.h"
#include "modes/sets.h"
#include "observe/observable.h"

enum { RESPONSES = 4 };

/** One response for each vector of each step and each modulation: see entries_of. */
struct hd_hydro {
    hd_boundary boundary[HD_DIM];
    int disks, count;
    hd_hydro_response *response; /**< [count] */
};

/** A modulation at one place: the value and the derivatives that differ from it by more than a
 * factor. */
typedef struct modulation {
    double a, x, y, xy;
} modulation;

/** Coefficients of the four functionals on dq_x, dq_y, dp_x, dp_y of one disk. */
typedef double functionals[RESPONSES][4];

static int modulations_of(const hd_step *step)
{
    return step->kind == HD_MODE_ZERO ? 0 : step->wave.pairs.count;
}

/** Entries of a step: vectors outside, modulations inside. */
static int entries_of(const hd_step *step) { return step->expected * modulations_of(step); }

hd_status hd_hydro_create(hd_hydro **out, const hd_scene_def *def, const hd_steps *steps)
{
    hd_hydro *hydro = hd_memory_alloc(1, sizeof *hydro);
    *out = NULL;
    if (!hydro) return HD_NO_MEMORY;
    memcpy(hydro->boundary, def->boundary, sizeof hydro->boundary);
    hydro->disks = def->disks;
    for (int k = 0; k < hd_steps_count(steps); k++)
        hydro->count += entries_of(hd_steps_step(steps, k));
    hydro->response = hd_memory_alloc((size_t)hydro->count + 1, sizeof *hydro->response);
    if (!hydro->response) {
        hd_hydro_free(hydro);
        return HD_NO_MEMORY;
    }
    *out = hydro;
    return HD_OK;
}

void hd_hydro_free(hd_hydro *hydro)
{
    if (!hydro) return;
    hd_memory_free(hydro->response);
    hd_memory_free(hydro);
}

/** cos or sin of k u, and its derivative. */
static void function_at(double *value, double *derivative, double k, double u, bool sine)
{
    *value = sine ? sin(k * u) : cos(k * u);
    *derivative = k * (sine ? cos(k * u) : -sin(k * u));
}

static modulation modulation_at(const hd_hydro *hydro, const hd_wave *wave, unsigned bits,
                                const double *q)
{
    double f, df, g, dg;
    const double u = q[0] - (hydro->boundary[0] == HD_REFLECTING ? 0.5 : 0.0);
    const double v = q[1] - (hydro->boundary[1] == HD_REFLECTING ? 0.5 : 0.0);
    function_at(&f, &df, wave->k[0], u, bits & HD_SIN_X);
    function_at(&g, &dg, wave->k[1], v, bits & HD_SIN_Y);
    return (modulation){f * g, df * g, f * dg, df * dg};
}

/** [T15]; A of the density, B of the transverse momentum. A_xx = -kx^2 A, A_yy = -ky^2 A. */
static void functionals_at(functionals out, const hd_wave *wave, const modulation *A,
                           const modulation *B, const double *p)
{
    const double k = wave->number, kx2 = wave->k[0] * wave->k[0], ky2 = wave->k[1] * wave->k[1];
    const double p2 = p[0] * p[0] + p[1] * p[1];
    const functionals here = {
        {A->x / k, A->y / k, 0.0, 0.0},
        {(-kx2 * p[0] * A->a + p[1] * A->xy) / k, (p[0] * A->xy - ky2 * p[1] * A->a) / k, A->x / k,
         A->y / k},
        {(p[0] * B->xy + kx2 * p[1] * B->a) / k, (-ky2 * p[0] * B->a - p[1] * B->xy) / k, B->y / k,
         -B->x / k},
        {p2 * A->x, p2 * A->y, 2.0 * p[0] * A->a, 2.0 * p[1] * A->a},
    };
    memcpy(out, here, sizeof here);
}

/** A with sines along reflecting directions: what a transverse field with this wave vector has. */
static unsigned transverse_bits(const hd_hydro *hydro, unsigned bits)
{
    if (hydro->boundary[0] == HD_REFLECTING) bits |= HD_SIN_X;
    if (hydro->boundary[1] == HD_REFLECTING) bits |= HD_SIN_Y;
    return bits;
}

/** sum[RESPONSES][HD_SET_VECTORS_MAX]: of the vectors of a step at one modulation. */
static void measure(const hd_hydro *hydro, double sum[RESPONSES][HD_SET_VECTORS_MAX],
                    const hd_step *step, unsigned bits, hd_columns vectors, const double *q,
                    const double *p)
{
    const size_t stride = (size_t)vectors.stride;
    memset(sum, 0, RESPONSES * sizeof *sum);
    for (int j = 0; j < hydro->disks; j++) {
        const modulation a = modulation_at(hydro, &step->wave, bits, q + HD_DIM * j);
        const modulation b = modulation_at(hydro, &step->wave, transverse_bits(hydro, bits),
                                           q + HD_DIM * j);
        const double *row = vectors.data + HD_ROWS * (size_t)j * stride +
                            (step->col - vectors.first);
        functionals f;
        functionals_at(f, &step->wave, &a, &b, p + HD_DIM * j);
        for (int r = 0; r < RESPONSES; r++)
            for (int d = 0; d < 4; d++)
                for (int v = 0; v < step->count; v++)
                    sum[r][v] += f[r][d] * row[(size_t)d * stride + (size_t)v];
    }
}

/** The vectors that belong to the step, one after the other. */
static void step_measure(hd_hydro *hydro, hd_hydro_response *out, const hd_steps *steps, int index,
                         hd_columns vectors, const double *q, const double *p)
{
    const hd_step *step = hd_steps_step(steps, index);
    const hd_modulations m = step->wave.pairs;
    const double scale = 1.0 / sqrt(0.5 * hydro->disks);
    double sum[RESPONSES][HD_SET_VECTORS_MAX];
    for (int c = 0; c < m.count; c++) {
        int found = 0;
        measure(hydro, sum, step, m.bits[c], vectors, q, p);
        for (int v = 0; v < step->count && found < step->expected; v++) {
            if (hd_steps_of_vector(steps, step->col + v) != index) continue;
            out[found++ * m.count + c] = (hd_hydro_response){index,
                                                             step->col + v,
                                                             m.bits[c],
                                                             scale * sum[0][v],
                                                             scale * sum[1][v],
                                                             scale * sum[2][v],
                                                             scale * sum[3][v]};
        }
    }
}

static void entries_clear(hd_hydro_response *out, const hd_step *step, int index)
{
    const hd_modulations m = step->wave.pairs;
    for (int e = 0; e < entries_of(step); e++)
        out[e] = (hd_hydro_response){.step = index, .col = -1, .modulation = m.bits[e % m.count]};
}

void hd_hydro_measure(hd_hydro *hydro, const hd_steps *steps, hd_columns vectors, const double *q,
                      const double *p)
{
    hd_hydro_response *out = hydro->response;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (modulations_of(step) == 0) continue;
        entries_clear(out, step, k);
        if (step->resolved) step_measure(hydro, out, steps, k, vectors, q, p);
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

/** A wave with d pairs has 2 d vectors of LP and at most as many of T, each with d responses. */
static double hydro_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(hd_hydro_response) * 2.0 * hd_fields_count_of(scene).lp_phases;
}

static hd_status hydro_create(void **self, const hd_observing *with)
{
    return hd_hydro_create((hd_hydro **)self, with->scene, with->part[HD_OBSERVED_steps]);
}

static void hydro_free(void *self) { hd_hydro_free(self); }

static void hydro_report(void *self, const hd_observing *with, const hd_view *state)
{
    hd_hydro_measure(self, with->part[HD_OBSERVED_steps], state->vectors[0], state->q, state->p);
}

const hd_observable hd_hydro_row = {.asked = HD_OBSERVE_HYDRO,
                                    .needs = HD_NEEDS_FRAME | HD_NEEDS_MODES | HD_NEEDS_REPORTS |
                                             HD_NEEDS_ALL,
                                    .bytes = hydro_bytes,
                                    .create = hydro_create,
                                    .free = hydro_free,
                                    .report = hydro_report};
