/** Frame -> weights of every vector in every subspace [T11].
 *
 * With B (D columns, row-major) the sampled fields of all subspaces and U (n columns) the dq
 * halves, the overlaps B^T U are one product for the x rows of the frame, one for the y rows, and
 * so on, without copying. Least squares on one subspace: its Gram matrix G = E L E^T (dgesvd),
 * coefficients c = G^+ B^T u, weight = |L^(-1/2) E^T B^T u|^2; directions that the particles do not
 * sample (L below RANK) are left out. */
#include "modes/modes.h"

#include <cblas.h>
#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arrays.h"
#include "base/check.h"
#include "base/communicator.h"
#include "base/memory.h"
#include "dynamics/dynamics.h"
#include "modes/fields.h"
#include "modes/shares.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "tangent/product.h"

/** Eigenvalues of a Gram matrix of unit fields below this are unsampled directions, not small ones.
 */
static const double RANK = 1e-6;

enum { DIMENSION_MAX = HD_FIELDS_MAX, BLOCK = 128 };

struct hd_modes {
    hd_fields *fields;
    hd_scene_def scene;
    int particles, vectors, threads;
    int dimension, coordinates; /**< dimension of space; coordinates of a particle */
    int widest;                 /**< number of fields of the largest subspace that there may be */
    size_t stride; /**< distance of rows in each array with an element for each vector */
    double *gram; /**< [columns][widest]: products of a field with the fields of its own subspace */
    double *coefficient; /**< [columns][stride]: overlaps, then coefficients */
    double *work;        /**< [widest][stride] */
    double *dq_norm;     /**< [stride] */
    double *null_dp;     /**< [nulls][stride]: overlaps of the dp halves with the null fields */
    double *known; /**< [known_most][rows]: null vectors that are no fields; NULL: there are none */
    double *snapshot; /**< [subspaces * HD_WEIGHTS + nulls + shares][stride] */
    double *average;  /**< same, over samples */
    long samples;
};

/* ---- creation ------------------------------------------------------------------------------ */

static size_t nulls_of(const hd_modes *modes) { return (size_t)hd_fields_nulls(modes->fields); }

/** The first row of the parts in the null space; the rows of shares follow them. */
static size_t null_row(const hd_modes *modes)
{
    return (size_t)hd_fields_subspaces(modes->fields) * HD_WEIGHTS;
}

static size_t weight_rows(const hd_modes *modes)
{
    return null_row(modes) + nulls_of(modes) + hd_shares_before(&modes->scene, HD_SHARES);
}

/** Null vectors that the row may know, beside the translations and their momenta; 0: fields are
 * all of them. */
static size_t known_most(const hd_scene_def *scene)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    const int translations = 2 * hd_null_space_of(scene).count;
    return of->scale_invariant || !of->null_vectors
               ? 0
               : (size_t)(translations + hd_scene_counts(scene).zero + HD_NULL_SPARE);
}

static size_t rows_of(const hd_scene_def *scene)
{
    return 2 * (size_t)(hd_scene_coordinates(scene) * scene->number);
}

double hd_modes_bytes(const hd_scene_def *scene, double vectors)
{
    const hd_fields_count count = hd_fields_count_of(scene);
    const double dimension = hd_scene_dimension(scene), nulls = dimension + 1.0,
                 widest = HD_FIELDS_IN(hd_scene_dimension(scene)),
                 shares = (double)hd_shares_before(scene, HD_SHARES);
    const double columns = count.columns + nulls,
                 rows = count.subspaces * HD_WEIGHTS + nulls + shares,
                 known = (double)(known_most(scene) * rows_of(scene)),
                 fields = hd_scene_coordinates(scene) * (double)scene->number * (columns + 4.0);
    return sizeof(double) * (fields + known + widest * columns +
                             (columns + widest + 1.0 + nulls + 2.0 * rows) * vectors);
}

static hd_status modes_allocate(hd_modes *modes, const hd_scene_def *def)
{
    HD_TRY(hd_fields_create(&modes->fields, def));
    const size_t columns = (size_t)hd_fields_columns(modes->fields), rows = weight_rows(modes);
    const size_t n = modes->stride, widest = (size_t)modes->widest;
    struct {
        double **array;
        size_t size;
    } wanted[] = {{&modes->gram, columns * widest},
                  {&modes->coefficient, columns * n},
                  {&modes->work, widest * n},
                  {&modes->dq_norm, n},
                  {&modes->null_dp, nulls_of(modes) * n},
                  {&modes->known, known_most(def) * rows_of(def)},
                  {&modes->snapshot, rows * n},
                  {&modes->average, rows * n}};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
        if (wanted[k].size > 0 &&
            !(*wanted[k].array = hd_memory_alloc(wanted[k].size, sizeof(double))))
            return HD_NO_MEMORY;
    return HD_OK;
}

hd_status hd_modes_create(hd_modes **out, const hd_scene_def *def, int vectors, int threads)
{
    HD_ASSERT(vectors >= 1 && threads >= 1);
    hd_modes *modes = hd_memory_alloc(1, sizeof *modes);
    *out = NULL;
    if (!modes) return HD_NO_MEMORY;
    modes->scene = *def;
    modes->particles = def->number;
    modes->dimension = hd_scene_dimension(def);
    modes->coordinates = hd_scene_coordinates(def);
    modes->widest = HD_FIELDS_IN(modes->dimension);
    modes->vectors = vectors;
    modes->threads = threads;
    modes->stride = (size_t)(vectors + 7) / 8 * 8;
    const hd_status status = modes_allocate(modes, def);
    if (status == HD_OK)
        *out = modes;
    else
        hd_modes_free(modes);
    return status;
}

void hd_modes_free(hd_modes *modes)
{
    if (!modes) return;
    hd_fields_free(modes->fields);
    hd_memory_free(modes->gram);
    hd_memory_free(modes->coefficient);
    hd_memory_free(modes->work);
    hd_memory_free(modes->dq_norm);
    hd_memory_free(modes->null_dp);
    hd_memory_free(modes->known);
    hd_memory_free(modes->snapshot);
    hd_memory_free(modes->average);
    hd_memory_free(modes);
}

/* ---- one snapshot -------------------------------------------------------------------------- */

/** out[count][stride] = (fields from `column` on)^T times the dq rows (half = 0) or the dp rows
 * (half = coordinates). */
static void overlaps(const hd_modes *modes, hd_columns v, int half, int column, int count,
                     double *out)
{
    const int fields = hd_fields_stride(modes->fields), rows = 2 * modes->coordinates;
    for (int d = 0; d < modes->coordinates; d++)
        hd_dgemm(CblasNoTrans, CblasTrans, v.count, count, modes->particles, 1.0,
                 v.data + (size_t)(half + d) * (size_t)v.stride, rows * v.stride,
                 hd_fields_data(modes->fields) + (size_t)d * (size_t)fields + column,
                 modes->coordinates * fields, d > 0, out + v.first, (int)modes->stride);
}

static double *gram_of(const hd_modes *modes, const hd_subspace *s)
{
    return modes->gram + (size_t)s->column * (size_t)modes->widest;
}

/** Fills Gram matrices, subspace by subspace: products of fields of two subspaces are not needed.
 */
static void gram_fill(hd_modes *modes)
{
    const size_t columns = (size_t)hd_fields_columns(modes->fields);
    const size_t stride = (size_t)hd_fields_stride(modes->fields),
                 rows = (size_t)modes->coordinates * (size_t)modes->particles;
    const int widest = modes->widest;
    memset(modes->gram, 0, columns * (size_t)widest * sizeof *modes->gram);
    for (size_t row = 0; row < rows; row++)
        for (int k = 0; k < hd_fields_subspaces(modes->fields); k++) {
            const hd_subspace *s = hd_fields_subspace(modes->fields, k);
            const double *x = hd_fields_data(modes->fields) + row * stride + s->column;
            double *gram = gram_of(modes, s);
            for (int a = 0; a < s->dimension; a++)
                for (int b = 0; b < s->dimension; b++) gram[a * widest + b] += x[a] * x[b];
        }
}

static void dq_norms(hd_modes *modes, hd_columns v)
{
    const int n = v.count, half = modes->coordinates, rows = 2 * half * modes->particles;
#pragma omp parallel for schedule(static) num_threads(modes->threads) if (modes->threads > 1)
    for (int col = 0; col < n; col += BLOCK) {
        const int end = col + BLOCK < n ? col + BLOCK : n;
        double *sum = modes->dq_norm + v.first;
        for (int l = col; l < end; l++) sum[l] = 0.0;
        for (int row = 0; row < rows; row += row % (2 * half) == half - 1 ? half + 1 : 1)
            for (int l = col; l < end; l++) {
                const double dq = v.data[(size_t)row * (size_t)v.stride + (size_t)l];
                sum[l] += dq * dq;
            }
        for (int l = col; l < end; l++) sum[l] = sqrt(sum[l]);
    }
}

static double *row_of(double *rows, size_t row, const hd_modes *modes)
{
    return rows + row * modes->stride;
}

static void add_squares(double *sum, const double *row, int n)
{
    for (int l = 0; l < n; l++) sum[l] += row[l] * row[l];
}

/** Measures the weights in the null space. Whole vectors and null fields are orthonormal, so plain
 * overlaps serve. */
static void measure_null(hd_modes *modes, hd_columns v)
{
    const size_t from = (size_t)hd_fields_columns(modes->fields) - nulls_of(modes);
    for (size_t k = 0; k < nulls_of(modes); k++) {
        double *out = row_of(modes->snapshot, null_row(modes) + k, modes) + v.first;
        memset(out, 0, (size_t)v.count * sizeof *out);
        add_squares(out, row_of(modes->coefficient, from + k, modes) + v.first, v.count);
        add_squares(out, row_of(modes->null_dp, k, modes) + v.first, v.count);
    }
}

/** Makes x orthogonal to `count` unit vectors, and a unit vector. False, and x = 0, where nothing
 * is left. */
static bool make_orthonormal(double *x, const double *unit, int count, int rows)
{
    const double before = cblas_dnrm2(rows, x, 1);
    for (int k = 0; k < count; k++) {
        const double *other = unit + (size_t)k * (size_t)rows;
        cblas_daxpy(rows, -cblas_ddot(rows, other, 1, x, 1), other, 1, x, 1);
    }
    const double after = cblas_dnrm2(rows, x, 1);
    const bool left = after > RANK * before;
    cblas_dscal(rows, left ? 1.0 / after : 0.0, x, 1);
    return left;
}

/** Adds to the last null part the weights in the null vectors that the dynamics knows beyond
 * translations and their momenta: for soft particles in the flow. */
static hd_status measure_known(hd_modes *modes, hd_columns v, const double *q, const double *p)
{
    const int rows = (int)rows_of(&modes->scene), last = (int)nulls_of(modes) - 1;
    double *out = row_of(modes->snapshot, null_row(modes) + (size_t)last, modes) + v.first;
    const int moved = hd_null_space_fill(&modes->scene, q, p, modes->known);
    int more;
    HD_TRY(hd_null_vectors_of(&more, &modes->scene, q, p,
                              modes->known + (size_t)moved * (size_t)rows));
    for (int k = 0; k < moved + more; k++) {
        double *x = modes->known + (size_t)k * (size_t)rows;
        if (!make_orthonormal(x, modes->known, k, rows) || k < moved) continue;
        hd_dgemm(CblasNoTrans, CblasNoTrans, v.count, 1, rows, 1.0, v.data, v.stride, x, rows, 0,
                 modes->work, (int)modes->stride);
        add_squares(out, modes->work, v.count);
    }
    return HD_OK;
}

static size_t share_row(const hd_modes *modes, hd_share share)
{
    return null_row(modes) + nulls_of(modes) + hd_shares_before(&modes->scene, share);
}

/** whiten[d * d] = E L^(-1/2), row-major, with zero columns for unsampled directions. The singular
 * values of G are its eigenvalues; dsyev would wake all of OpenBLAS's threads for every product
 * with a vector of 8. */
static void whitening(const hd_modes *modes, const hd_subspace *s, double *whiten)
{
    const int d = s->dimension;
    const double *products = gram_of(modes, s);
    double gram[DIMENSION_MAX * DIMENSION_MAX], vectors[DIMENSION_MAX * DIMENSION_MAX];
    double value[DIMENSION_MAX], work[64 * DIMENSION_MAX], none;
    for (int a = 0; a < d; a++)
        for (int b = a; b < d; b++)
            gram[a * d + b] = gram[b * d + a] = products[a * modes->widest + b];
    const int failed = LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'A', 'N', d, d, gram, d, value,
                                           vectors, d, &none, 1, work,
                                           (int)(sizeof work / sizeof *work));
    HD_ASSERT(failed == 0);
    for (int e = 0; e < d; e++) {
        const double scale = value[e] > RANK ? 1.0 / sqrt(value[e]) : 0.0;
        for (int a = 0; a < d; a++) whiten[a * d + e] = vectors[e * d + a] * scale;
    }
}

/** Squared norm of the part of the projection that lies in columns [from, to) of s. */
static void part_weight(const hd_modes *modes, const hd_subspace *s, int from, int to, hd_columns v,
                        double *out)
{
    const double *gram = gram_of(modes, s);
    memset(out, 0, (size_t)v.count * sizeof *out);
    for (int a = from; a < to; a++)
        for (int b = a; b < to; b++) {
            const double g = gram[a * modes->widest + b] * (a == b ? 1.0 : 2.0);
            const double *x = hd_modes_coefficients(modes, s->column + a) + v.first;
            const double *y = hd_modes_coefficients(modes, s->column + b) + v.first;
            for (int l = 0; l < v.count; l++) out[l] += g * x[l] * y[l];
        }
}

static void measure_subspace(hd_modes *modes, int index, hd_columns v)
{
    const hd_subspace *s = hd_fields_subspace(modes->fields, index);
    const int d = s->dimension, n = v.count, stride = (int)modes->stride;
    double whiten[DIMENSION_MAX * DIMENSION_MAX];
    double *overlap = row_of(modes->coefficient, (size_t)s->column, modes) + v.first;
    double *out = row_of(modes->snapshot, (size_t)index * HD_WEIGHTS, modes) + v.first;
    whitening(modes, s, whiten);
    cblas_dgemm(CblasRowMajor, CblasTrans, CblasNoTrans, d, n, d, 1.0, whiten, d, overlap, stride,
                0.0, modes->work, stride);
    memset(out, 0, (size_t)n * sizeof *out);
    for (int e = 0; e < d; e++) add_squares(out, row_of(modes->work, (size_t)e, modes), n);
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, d, n, d, 1.0, whiten, d, modes->work,
                stride, 0.0, overlap, stride);
    if (s->kind != HD_MODE_LP) return;
    part_weight(modes, s, 0, d / 2, v, out + HD_WEIGHT_L * modes->stride);
    part_weight(modes, s, d / 2, d, v, out + HD_WEIGHT_P * modes->stride);
}

/** Makes overlaps those of normalised dq halves. A vector without a dq half has no weights. */
static void normalise(hd_modes *modes, hd_columns v)
{
    const size_t columns = (size_t)hd_fields_columns(modes->fields) - nulls_of(modes);
    for (size_t c = 0; c < columns; c++) {
        double *row = row_of(modes->coefficient, c, modes);
        for (int l = v.first; l < v.first + v.count; l++)
            row[l] = modes->dq_norm[l] > HD_MODES_DQ_MIN ? row[l] / modes->dq_norm[l] : 0.0;
    }
}

hd_status hd_modes_measure(hd_modes *modes, hd_columns v, const double *q, const double *p)
{
    HD_ASSERT(v.first >= 0 && v.first + v.count <= modes->vectors);
    const int columns = hd_fields_columns(modes->fields), nulls = hd_fields_nulls(modes->fields);
    hd_fields_sample(modes->fields, q, p);
    gram_fill(modes);
    if (!hd_all_finite(modes->gram, (size_t)columns * (size_t)modes->widest)) return HD_NOT_FINITE;
    dq_norms(modes, v);
    overlaps(modes, v, 0, 0, columns, modes->coefficient);
    overlaps(modes, v, modes->coordinates, columns - nulls, nulls, modes->null_dp);
    measure_null(modes, v);
    if (modes->known && v.count > 0) HD_TRY(measure_known(modes, v, q, p));
    for (int share = 0; share < HD_SHARES; share++)
        if (hd_shares_has(&modes->scene, (hd_share)share))
            hd_shares_measure(row_of(modes->snapshot, share_row(modes, (hd_share)share), modes),
                              &modes->scene, (hd_share)share, modes->dq_norm, v);
    normalise(modes, v);
    for (int s = 0; s < hd_fields_subspaces(modes->fields); s++) measure_subspace(modes, s, v);
    return hd_all_finite(modes->snapshot, weight_rows(modes) * modes->stride) ? HD_OK
                                                                              : HD_NOT_FINITE;
}

/** Gives all ranks each row of the snapshot. */
hd_status hd_modes_share(hd_modes *modes, hd_communicator *communicator, int width, int carried)
{
    const struct {
        double *array;
        size_t rows;
    } known[] = {{modes->snapshot, weight_rows(modes)},
                 {modes->coefficient, (size_t)hd_fields_columns(modes->fields)},
                 {modes->dq_norm, 1}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
        HD_TRY(hd_communicator_share_halves(
            communicator, known[k].array,
            (hd_shared){known[k].rows, modes->stride, (size_t)width, (size_t)carried, 0},
            (size_t)modes->vectors));
    return HD_OK;
}

/* ---- averages ------------------------------------------------------------------------------ */

void hd_modes_add(hd_modes *modes)
{
    const size_t size = weight_rows(modes) * modes->stride;
    modes->samples++;
    hd_mean_add(modes->average, modes->snapshot, size, modes->samples);
}

void hd_modes_clear(hd_modes *modes)
{
    const size_t columns = (size_t)hd_fields_columns(modes->fields), rows = weight_rows(modes);
    modes->samples = 0;
    memset(modes->average, 0, rows * modes->stride * sizeof *modes->average);
    memset(modes->snapshot, 0, rows * modes->stride * sizeof *modes->snapshot);
    memset(modes->coefficient, 0, columns * modes->stride * sizeof *modes->coefficient);
    memset(modes->dq_norm, 0, modes->stride * sizeof *modes->dq_norm);
    hd_fields_clear(modes->fields);
}

/* ---- what can be read ---------------------------------------------------------------------- */

static const double *weight_of(const hd_modes *modes, const double *rows, int s, hd_weight which)
{
    HD_ASSERT(s >= 0 && s < hd_fields_subspaces(modes->fields) && which < HD_WEIGHTS);
    return rows + ((size_t)s * HD_WEIGHTS + (size_t)which) * modes->stride;
}

static const double *null_of(const hd_modes *modes, const double *rows, int null)
{
    HD_ASSERT(null >= 0 && null < hd_fields_nulls(modes->fields));
    return rows + (null_row(modes) + (size_t)null) * modes->stride;
}

long hd_modes_samples(const hd_modes *modes) { return modes->samples; }
int hd_modes_vectors(const hd_modes *modes) { return modes->vectors; }
const hd_fields *hd_modes_fields(const hd_modes *modes) { return modes->fields; }
const double *hd_modes_snapshot(const hd_modes *modes, int s, hd_weight which)
{
    return weight_of(modes, modes->snapshot, s, which);
}

const double *hd_modes_average(const hd_modes *modes, int s, hd_weight which)
{
    return weight_of(modes, modes->average, s, which);
}

const double *hd_modes_null_snapshot(const hd_modes *modes, int null)
{
    return null_of(modes, modes->snapshot, null);
}

const double *hd_modes_null_average(const hd_modes *modes, int null)
{
    return null_of(modes, modes->average, null);
}

static const double *share_of(const hd_modes *modes, const double *rows, hd_share share)
{
    HD_ASSERT(share < HD_SHARES);
    return hd_shares_has(&modes->scene, share) ? rows + share_row(modes, share) * modes->stride
                                               : NULL;
}

const double *hd_modes_share_snapshot(const hd_modes *modes, hd_share share)
{
    return share_of(modes, modes->snapshot, share);
}

const double *hd_modes_share_average(const hd_modes *modes, hd_share share)
{
    return share_of(modes, modes->average, share);
}

const double *hd_modes_dq_norms(const hd_modes *modes) { return modes->dq_norm; }

const double *hd_modes_coefficients(const hd_modes *modes, int column)
{
    HD_ASSERT(column >= 0 && column < hd_fields_columns(modes->fields));
    return modes->coefficient + (size_t)column * modes->stride;
}

/** Reads or writes the averages, and the snapshot, which reports state until the next one. */
void hd_modes_archive(hd_modes *modes, hd_archive *archive)
{
    const size_t n = modes->stride, rows = weight_rows(modes) * n;
    hd_archive_long(archive, "modes samples", &modes->samples, 0, LONG_MAX / 2);
    hd_archive_doubles(archive, "modes average", modes->average, rows);
    hd_archive_doubles(archive, "modes snapshot", modes->snapshot, rows);
    hd_archive_doubles(archive, "modes coefficient", modes->coefficient,
                       (size_t)hd_fields_columns(modes->fields) * n);
    hd_archive_doubles(archive, "modes dq norm", modes->dq_norm, n);
    hd_fields_archive(modes->fields, archive);
}
