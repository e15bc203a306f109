/** Frame -> structure factors of every vector at every wave vector [T20].
 *
 * Sums over the particles of dq_x, dq_y, .. times products of a cosine or sine of each coordinate
 * are one matrix product for the x rows of the frame, one for the y rows, and so on. Some waves are
 * taken at a time, so that their sums stay in cache until they are amplitudes along and across k.
 */
#include "modes/structure.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/arrays.h"
#include "base/check.h"
#include "base/communicator.h"
#include "base/memory.h"
#include "modes/harmonics.h"
#include "modes/modes.h"
#include "modes/structure_terms.h"
#include "scene/ends.h"
#include "scene/scene.h"
#include "scene/wave.h"
#include "tangent/product.h"

enum { AT_ONCE = 16 };

/** A wave vector and, for each component of dq, the columns of its functions; -1 if no amplitude
 * needs one. */
typedef struct planned {
    hd_wave wave;
    hd_modulations modulations[HD_DIRECTIONS];
    /** Column of each function, by its bits, among those of AT_ONCE waves. */
    int column[HD_DIMENSION_MAX][HD_MODULATIONS_MAX];
    double root; /**< product of sqrt(2) for each direction with walls and nodes */
} planned;

struct hd_structure {
    int particles, vectors, waves, threads;
    int dimension, coordinates; /**< dimension of space; coordinates of a particle */
    size_t functions;           /**< number of functions of a wave */
    size_t amplitudes;          /**< most amplitudes of a wave in one direction */
    size_t width;               /**< number of functions of the waves that are taken at once */
    hd_harmonics along[HD_DIMENSION_MAX];
    planned *plan; /**< [waves] */
    size_t stride; /**< distance of rows in each array with an element for each vector */
    double *value[HD_DIMENSION_MAX]; /**< [particles][2 (nodes + 1)]: harmonics of each particle */
    double *factor; /**< [particles][width]: functions of some waves at each particle, for one
                       component of dq */
    /** [width][stride]: sums of dq_x, dq_y, .. times these functions. */
    double *sum[HD_DIMENSION_MAX];
    double *snapshot;  /**< [waves][HD_DIRECTIONS][stride] */
    double *mean;      /**< the mean of snapshot over the samples */
    double *amplitude; /**< [HD_DIRECTIONS][amplitudes][stride] */
    double *work;      /**< [AT_ONCE][stride] */
    int *peak, *shown; /**< [vectors]: strongest wave of the mean now, and at the snapshot */
    long samples;
};

/** Numbers in `mean` and in `snapshot`; in `amplitude`. */
static size_t means(const hd_structure *s) { return (size_t)s->waves * HD_DIRECTIONS * s->stride; }

static size_t amplitudes_of_all(const hd_structure *s)
{
    return HD_DIRECTIONS * s->amplitudes * s->stride;
}

/* ---- creation ------------------------------------------------------------------------------ */

/** The scene, but with all waves that the particles sample. */
static hd_scene_def sampled(const hd_scene_def *def)
{
    hd_scene_def all = *def;
    all.max_wave_number = hd_wave_limits_of(def).largest;
    all.max_mode_number = 0;
    return all;
}

int hd_structure_waves_of(const hd_scene_def *def)
{
    const hd_scene_def all = sampled(def);
    return hd_waves(&all, NULL, 0);
}

static void plan_columns(planned *p, int *used, int dimension)
{
    memset(p->column, -1, sizeof p->column);
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++)
        for (int c = 0; c < p->modulations[e].count; c++)
            for (int d = 0; d < dimension; d++) {
                const hd_structure_term term = hd_structure_term_of(dimension, &p->wave, e,
                                                                    p->modulations[e].bits[c], d);
                int *column = &p->column[d][term.function];
                if (*column < 0 && term.factor != 0) *column = used[d]++;
            }
}

/** Sets the root by which amplitudes between walls are multiplied. */
static void plan_root(planned *p, const hd_scene_def *def)
{
    p->root = 1.0;
    for (int d = 0; d < hd_scene_dimension(def); d++)
        if (hd_is_wall(def->boundary[d]) && p->wave.n[d] > 0) p->root *= sqrt(2.0);
}

static hd_status plan_waves(hd_structure *s, const hd_scene_def *def)
{
    const hd_scene_def all = sampled(def);
    hd_wave *wave = hd_memory_alloc((size_t)s->waves + 1, sizeof *wave);
    s->plan = hd_memory_alloc((size_t)s->waves + 1, sizeof *s->plan);
    if (!wave || !s->plan) {
        hd_memory_free(wave);
        return HD_NO_MEMORY;
    }
    (void)hd_waves(&all, wave, s->waves);
    for (int w = 0, used[HD_DIMENSION_MAX]; w < s->waves; w++) {
        if (w % AT_ONCE == 0) memset(used, 0, sizeof used);
        s->plan[w] = (planned){.wave = wave[w], .modulations = {wave[w].pairs, wave[w].transverse}};
        plan_root(&s->plan[w], def);
        plan_columns(&s->plan[w], used, s->dimension);
        for (int d = 0; d < s->dimension; d++)
            if (wave[w].n[d] > s->along[d].nodes) s->along[d].nodes = wave[w].n[d];
    }
    hd_memory_free(wave);
    return HD_OK;
}

double hd_structure_bytes(const hd_scene_def *scene, double vectors)
{
    const double waves = hd_structure_waves_of(scene), longer = hd_wave_limits_of(scene).node + 1.0,
                 shorter = waves / longer + 1.0;
    const int dimension = hd_scene_dimension(scene);
    const double width = AT_ONCE * HD_MODULATIONS_IN(dimension),
                 amplitudes = HD_TRANSVERSE_IN(dimension);
    return sizeof(double) *
           (2.0 * HD_DIRECTIONS * waves * vectors +
            (dimension * width + AT_ONCE + HD_DIRECTIONS * amplitudes + 1.0) * vectors +
            scene->number * (width + 2.0 * (longer + (dimension - 1) * shorter)));
}

static hd_status prepare(hd_structure *s, const hd_scene_def *def)
{
    const size_t particles = (size_t)def->number, n = s->stride;
    HD_TRY(plan_waves(s, def));
    for (int d = 0; d < s->dimension; d++) {
        const size_t functions = 2 * ((size_t)s->along[d].nodes + 1);
        HD_TRY(hd_harmonics_create(&s->along[d], def, d, s->along[d].nodes));
        s->value[d] = hd_memory_alloc(particles * functions, sizeof(double));
        s->sum[d] = hd_memory_alloc(s->width * n, sizeof(double));
        if (!s->value[d] || !s->sum[d]) return HD_NO_MEMORY;
    }
    struct {
        double **array;
        size_t size;
    } wanted[] = {{&s->factor, particles * s->width},
                  {&s->work, AT_ONCE * n},
                  {&s->snapshot, means(s) + 1},
                  {&s->mean, means(s) + 1},
                  {&s->amplitude, amplitudes_of_all(s)}};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
        if (!(*wanted[k].array = hd_memory_alloc(wanted[k].size, sizeof(double))))
            return HD_NO_MEMORY;
    s->peak = hd_memory_alloc((size_t)s->vectors, sizeof *s->peak);
    s->shown = hd_memory_alloc((size_t)s->vectors, sizeof *s->shown);
    if (!s->peak || !s->shown) return HD_NO_MEMORY;
    hd_structure_clear(s);
    return HD_OK;
}

hd_status hd_structure_create(hd_structure **out, const hd_scene_def *def, int vectors, int threads)
{
    HD_ASSERT(vectors >= 1 && threads >= 1);
    hd_structure *s = hd_memory_alloc(1, sizeof *s);
    *out = NULL;
    if (!s) return HD_NO_MEMORY;
    s->particles = def->number;
    s->dimension = hd_scene_dimension(def);
    s->coordinates = hd_scene_coordinates(def);
    s->functions = (size_t)HD_MODULATIONS_IN(s->dimension);
    s->amplitudes = (size_t)HD_TRANSVERSE_IN(s->dimension);
    s->width = AT_ONCE * s->functions;
    s->vectors = vectors;
    s->threads = threads;
    s->waves = hd_structure_waves_of(def);
    s->stride = (size_t)(vectors + 7) / 8 * 8;
    const hd_status status = prepare(s, def);
    if (status == HD_OK)
        *out = s;
    else
        hd_structure_free(s);
    return status;
}

void hd_structure_free(hd_structure *s)
{
    if (!s) return;
    for (int d = 0; d < HD_DIMENSION_MAX; d++) {
        hd_harmonics_clear(&s->along[d]);
        hd_memory_free(s->value[d]);
        hd_memory_free(s->sum[d]);
    }
    hd_memory_free(s->plan);
    hd_memory_free(s->factor);
    hd_memory_free(s->snapshot);
    hd_memory_free(s->mean);
    hd_memory_free(s->amplitude);
    hd_memory_free(s->work);
    hd_memory_free(s->peak);
    hd_memory_free(s->shown);
    hd_memory_free(s);
}

/* ---- one snapshot -------------------------------------------------------------------------- */

static void fill_values(hd_structure *s, const double *q)
{
    for (int d = 0; d < s->dimension; d++) {
        const size_t size = 2 * ((size_t)s->along[d].nodes + 1);
        for (int j = 0; j < s->particles; j++) {
            hd_harmonics_fill(&s->along[d], q[s->coordinates * j + d]);
            memcpy(s->value[d] + (size_t)j * size, s->along[d].value, size * sizeof(double));
        }
    }
}

/** Fills a column with one function of a wave, a product of functions of each coordinate, at all
 * particles. */
static void fill_factor(hd_structure *s, const planned *p, unsigned bits, int column)
{
    const double *of[HD_DIMENSION_MAX];
    size_t size[HD_DIMENSION_MAX];
    for (int d = 0; d < s->dimension; d++) {
        of[d] = s->value[d] + 2 * p->wave.n[d] + (bits >> d & 1);
        size[d] = 2 * ((size_t)s->along[d].nodes + 1);
    }
    for (size_t j = 0; j < (size_t)s->particles; j++) {
        double product = of[0][j * size[0]];
        for (int d = 1; d < s->dimension; d++) product *= of[d][j * size[d]];
        s->factor[j * s->width + (size_t)column] = product;
    }
}

/** Fills factor[particles][width] for component d and waves [from, to); returns the number of
 * columns.
 */
static int fill_factors(hd_structure *s, int d, int from, int to)
{
    int columns = 0;
    for (int w = from; w < to; w++)
        for (unsigned bits = 0; bits < s->functions; bits++) {
            const int column = s->plan[w].column[d][bits];
            if (column < 0) continue;
            fill_factor(s, &s->plan[w], bits, column);
            columns++;
        }
    return columns;
}

static void sum_up(hd_structure *s, hd_columns v, int from, int to)
{
    for (int d = 0; d < s->dimension; d++) {
        const int columns = fill_factors(s, d, from, to);
        if (columns == 0) continue;
        hd_dgemm(CblasNoTrans, CblasTrans, v.count, columns, s->particles, 1.0,
                 v.data + (size_t)d * (size_t)v.stride, 2 * s->coordinates * v.stride, s->factor,
                 (int)s->width, 0.0, s->sum[d] + v.first, (int)s->stride);
    }
}

/** Amplitudes of one modulation, for vectors that are not yet normalised. */
static void amplitudes(const hd_structure *s, double *out, const planned *p, hd_direction e,
                       unsigned bits, hd_columns v)
{
    memset(out, 0, (size_t)v.count * sizeof *out);
    for (int d = 0; d < s->dimension; d++) {
        const hd_structure_term term = hd_structure_term_of(s->dimension, &p->wave, e, bits, d);
        if (term.factor == 0) continue;
        const double *row = s->sum[d] + (size_t)p->column[d][term.function] * s->stride;
        for (int l = 0; l < v.count; l++) out[l] += term.factor * row[v.first + l];
    }
}

static double *snapshot_of(const hd_structure *s, double *rows, int wave, hd_direction e)
{
    return rows + ((size_t)wave * HD_DIRECTIONS + (size_t)e) * s->stride;
}

/** Sums the squares of one wave's amplitudes; keeps the amplitudes of vectors whose peak it is.
 * work[count]. */
static void measure_wave(hd_structure *s, double *work, int w, hd_columns v, const double *dq_norm)
{
    const double root = s->plan[w].root;
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++) {
        const hd_modulations *m = &s->plan[w].modulations[e];
        double *out = snapshot_of(s, s->snapshot, w, e) + v.first;
        memset(out, 0, (size_t)v.count * sizeof *out);
        for (int c = 0; c < m->count; c++) {
            double *kept = s->amplitude + ((size_t)e * s->amplitudes + m->bits[c]) * s->stride;
            amplitudes(s, work, &s->plan[w], e, m->bits[c], v);
            for (int l = 0; l < v.count; l++) {
                const double norm = dq_norm[v.first + l];
                const double a = norm > HD_MODES_DQ_MIN ? root * work[l] / norm : 0.0;
                out[l] += a * a;
                if (s->peak[v.first + l] == w) kept[v.first + l] = a;
            }
        }
    }
}

static void measure_waves(hd_structure *s, int from, int to, hd_columns v, const double *dq_norm)
{
#pragma omp parallel for schedule(static) num_threads(s->threads) if (s->threads > 1)
    for (int w = from; w < to; w++)
        measure_wave(s, s->work + (size_t)(w - from) * s->stride, w, v, dq_norm);
}

hd_status hd_structure_measure(hd_structure *s, hd_columns v, const double *q,
                               const double *dq_norm)
{
    HD_ASSERT(v.first >= 0 && v.first + v.count <= s->vectors);
    memcpy(s->shown, s->peak, (size_t)s->vectors * sizeof *s->shown);
    fill_values(s, q);
    for (size_t row = 0; row < HD_DIRECTIONS * s->amplitudes; row++)
        memset(s->amplitude + row * s->stride + v.first, 0, (size_t)v.count * sizeof(double));
    for (int from = 0; from < s->waves; from += AT_ONCE) {
        const int to = from + AT_ONCE < s->waves ? from + AT_ONCE : s->waves;
        sum_up(s, v, from, to);
        measure_waves(s, from, to, v, dq_norm);
    }
    return hd_all_finite(s->snapshot, means(s)) ? HD_OK : HD_NOT_FINITE;
}

hd_status hd_structure_share(hd_structure *s, hd_communicator *communicator, int width, int carried)
{
    const size_t rows = (size_t)s->waves * HD_DIRECTIONS, n = (size_t)s->vectors;
    hd_shared own = {rows, s->stride, (size_t)width, (size_t)carried, 0};
    HD_TRY(hd_communicator_share_halves(communicator, s->snapshot, own, n));
    own.rows = HD_DIRECTIONS * s->amplitudes;
    return hd_communicator_share_halves(communicator, s->amplitude, own, n);
}

/* ---- means --------------------------------------------------------------------------------- */

static void find_peaks(hd_structure *s)
{
    double *largest = s->sum[0];
    for (int l = 0; l < s->vectors; l++) largest[l] = 0.0;
    for (int w = 0; w < s->waves; w++) {
        const double *along = snapshot_of(s, s->mean, w, HD_ALONG), *across = along + s->stride;
        for (int l = 0; l < s->vectors; l++)
            if (along[l] + across[l] > largest[l]) {
                largest[l] = along[l] + across[l];
                s->peak[l] = w;
            }
    }
}

void hd_structure_add(hd_structure *s)
{
    s->samples++;
    hd_mean_add(s->mean, s->snapshot, means(s), s->samples);
    find_peaks(s);
}

void hd_structure_clear(hd_structure *s)
{
    s->samples = 0;
    memset(s->mean, 0, means(s) * sizeof *s->mean);
    memset(s->snapshot, 0, means(s) * sizeof *s->snapshot);
    memset(s->amplitude, 0, amplitudes_of_all(s) * sizeof *s->amplitude);
    for (int l = 0; l < s->vectors; l++) s->peak[l] = s->shown[l] = -1;
}

/* ---- what can be read ---------------------------------------------------------------------- */

long hd_structure_samples(const hd_structure *s) { return s->samples; }
int hd_structure_vectors(const hd_structure *s) { return s->vectors; }
int hd_structure_waves(const hd_structure *s) { return s->waves; }

const hd_wave *hd_structure_wave(const hd_structure *s, int wave)
{
    HD_ASSERT(wave >= 0 && wave < s->waves);
    return &s->plan[wave].wave;
}

const double *hd_structure_snapshot(const hd_structure *s, int wave, hd_direction e)
{
    HD_ASSERT(wave >= 0 && wave < s->waves && e < HD_DIRECTIONS);
    return snapshot_of(s, s->snapshot, wave, e);
}

const double *hd_structure_mean(const hd_structure *s, int wave, hd_direction e)
{
    HD_ASSERT(wave >= 0 && wave < s->waves && e < HD_DIRECTIONS);
    return snapshot_of(s, s->mean, wave, e);
}

int hd_structure_peak(const hd_structure *s, int col)
{
    HD_ASSERT(col >= 0 && col < s->vectors);
    return s->shown[col];
}

const double *hd_structure_amplitude(const hd_structure *s, hd_direction e, unsigned modulation)
{
    HD_ASSERT(e < HD_DIRECTIONS && modulation < s->amplitudes);
    return s->amplitude + ((size_t)e * s->amplitudes + modulation) * s->stride;
}

/** Reads or writes the means, and the snapshot, which reports state until the next one. */
void hd_structure_archive(hd_structure *s, hd_archive *archive)
{
    hd_archive_long(archive, "structure samples", &s->samples, 0, LONG_MAX / 2);
    hd_archive_doubles(archive, "structure mean", s->mean, means(s));
    hd_archive_doubles(archive, "structure snapshot", s->snapshot, means(s));
    hd_archive_doubles(archive, "structure amplitude", s->amplitude, amplitudes_of_all(s));
    hd_archive_of_ints(archive, "structure peak", (size_t)s->vectors);
    for (int l = 0; l < s->vectors; l++)
        hd_archive_next_int(archive, &s->shown[l], -1, s->waves - 1);
    bool positive = true;
    for (size_t k = 0; k < means(s) && hd_archive_good(archive); k++) positive &= s->mean[k] >= 0;
    hd_archive_expect(archive, positive, "structure mean", "it is negative");
    if (!archive->writing && hd_archive_good(archive) && s->samples > 0) find_peaks(s);
}
