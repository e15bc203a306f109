/** Vectors of an LP step -> its L and P modes [T14].
 *
 * With B (M x 2d) the normalised fields, M components of all particles, and psi (M x 2d) the
 * normalised dq halves, Q solves psi Q = B by least squares; the modes are psi Q. Q = (psi^T
 * psi)^-1 psi^T B by dposv of a 2d x 2d matrix; psi is nearly orthonormal.
 */
#include "modes/pmode.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "modes/fields.h"
#include "modes/modes.h"
#include "scene/scene.h"

enum { DIMENSION_MAX = HD_FIELDS_MAX };

struct hd_pmode {
    int particles, coordinates; /**< of a particle */
    int dimension;              /**< 2d */
    double *psi;                /**< [HD_FIELDS_IN(dimension)][coordinates * particles] */
    double *field;              /**< same */
    double q[DIMENSION_MAX * DIMENSION_MAX];
    double residual[DIMENSION_MAX];
    double norm[DIMENSION_MAX]; /**< norms of the sampled fields */
    double distance;
};

static size_t size_of(const hd_scene_def *def)
{
    const int fields = HD_FIELDS_IN(hd_scene_dimension(def));
    return (size_t)(fields * hd_scene_coordinates(def)) * (size_t)def->number;
}

double hd_pmode_bytes(const hd_scene_def *def)
{
    return sizeof(hd_pmode) + 2.0 * (double)size_of(def) * sizeof(double);
}

hd_status hd_pmode_create(hd_pmode **out, const hd_scene_def *def)
{
    const size_t size = size_of(def);
    hd_pmode *pmode = hd_memory_alloc(1, sizeof *pmode);
    *out = NULL;
    if (!pmode) return HD_NO_MEMORY;
    pmode->particles = def->number;
    pmode->coordinates = hd_scene_coordinates(def);
    pmode->psi = hd_memory_alloc(size, sizeof(double));
    pmode->field = hd_memory_alloc(size, sizeof(double));
    if (!pmode->psi || !pmode->field) {
        hd_pmode_free(pmode);
        return HD_NO_MEMORY;
    }
    *out = pmode;
    return HD_OK;
}

void hd_pmode_free(hd_pmode *pmode)
{
    if (!pmode) return;
    hd_memory_free(pmode->psi);
    hd_memory_free(pmode->field);
    hd_memory_free(pmode);
}

/** Number of components of all particles. */
static int components(const hd_pmode *pmode) { return pmode->coordinates * pmode->particles; }

static double *row_of(double *rows, int row, const hd_pmode *pmode)
{
    return rows + (size_t)row * (size_t)components(pmode);
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

/** psi: the dq halves of columns [col, col + dimension), with norm 1. */
static void psi_load(hd_pmode *pmode, hd_columns vectors, int col)
{
    const size_t stride = (size_t)vectors.stride;
    const int of_one = pmode->coordinates;
    for (int m = 0; m < pmode->dimension; m++) {
        double *psi = row_of(pmode->psi, m, pmode);
        const double *v = vectors.data + (col - vectors.first) + m;
        for (int j = 0; j < pmode->particles; j++)
            for (int d = 0; d < of_one; d++)
                psi[of_one * j + d] = v[(size_t)(2 * of_one * j + d) * stride];
        const double norm = sqrt(dot(psi, psi, components(pmode)));
        /* 0: solve refuses dependent vectors */
        const double scale = norm > HD_MODES_DQ_MIN ? 1.0 / norm : 0.0;
        for (int k = 0; k < components(pmode); k++) psi[k] *= scale;
    }
}

static void field_column(double *out, const hd_fields *fields, int column, int rows)
{
    const size_t stride = (size_t)hd_fields_stride(fields);
    for (int row = 0; row < rows; row++)
        out[row] = hd_fields_data(fields)[(size_t)row * stride + (size_t)column];
}

/** q <- (psi^T psi)^-1 psi^T B, with B in field. False if the vectors are dependent. */
static bool solve(hd_pmode *pmode)
{
    const int n = pmode->dimension, rows = components(pmode);
    double gram[DIMENSION_MAX * DIMENSION_MAX];
    for (int m = 0; m < n; m++)
        for (int c = 0; c < n; c++) {
            const double *psi = row_of(pmode->psi, m, pmode);
            gram[m * n + c] = dot(psi, row_of(pmode->psi, c, pmode), rows);
            pmode->q[c * n + m] = dot(psi, row_of(pmode->field, c, pmode), rows);
        } /* q column-major: column c of right-hand sides */
    return LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'U', n, n, gram, n, pmode->q, n) == 0;
}

/** Replaces field c, B e_c, by psi Q e_c; their distance is the residual. */
static void combine(hd_pmode *pmode, int c)
{
    const int n = pmode->dimension, rows = components(pmode);
    double *field = row_of(pmode->field, c, pmode), distance2 = 0.0;
    for (int k = 0; k < rows; k++) {
        double sum = 0.0;
        for (int m = 0; m < n; m++) sum += pmode->q[c * n + m] * row_of(pmode->psi, m, pmode)[k];
        distance2 += (field[k] - sum) * (field[k] - sum);
        field[k] = sum;
    }
    pmode->residual[c] = sqrt(distance2);
}

/** Measures how far the singular values of Q are from 1. */
static void finish(hd_pmode *pmode)
{
    const int n = pmode->dimension;
    double copy[DIMENSION_MAX * DIMENSION_MAX], s[DIMENSION_MAX], work[64 * DIMENSION_MAX], none;
    memcpy(copy, pmode->q, sizeof copy); /* used up */
    const int failed = LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'N', 'N', n, n, copy, n, s, &none, 1,
                                           &none, 1, work, (int)(sizeof work / sizeof *work));
    HD_ASSERT(failed == 0);
    pmode->distance = 0.0;
    for (int k = 0; k < n; k++) pmode->distance = fmax(pmode->distance, fabs(s[k] - 1.0));
}

bool hd_pmode_reconstruct(hd_pmode *pmode, const hd_step *step, const hd_modes *modes,
                          hd_columns vectors)
{
    if (step->kind != HD_MODE_LP || !step->resolved || step->members != 1) return false;
    if (vectors.count == 0) return false;
    const hd_fields *fields = hd_modes_fields(modes);
    const int column = hd_fields_subspace(fields, step->subspace)->column;
    pmode->dimension = step->expected;
    psi_load(pmode, vectors, step->col);
    for (int c = 0; c < pmode->dimension; c++) {
        field_column(row_of(pmode->field, c, pmode), fields, column + c, components(pmode));
        pmode->norm[c] = hd_fields_norm(fields, column + c);
    }
    if (!solve(pmode)) return false;
    for (int c = 0; c < pmode->dimension; c++) combine(pmode, c);
    finish(pmode);
    return true;
}

int hd_pmode_pairs(const hd_pmode *pmode) { return pmode->dimension / 2; }

const double *hd_pmode_field(const hd_pmode *pmode, int c)
{
    HD_ASSERT(c >= 0 && c < pmode->dimension);
    return pmode->field + (size_t)c * (size_t)components(pmode);
}

double hd_pmode_residual(const hd_pmode *pmode, int c)
{
    HD_ASSERT(c >= 0 && c < pmode->dimension);
    return pmode->residual[c];
}

double hd_pmode_rotation_distance(const hd_pmode *pmode) { return pmode->distance; }

void hd_pmode_divide(const hd_pmode *pmode, double *out, int c, const double *p)
{
    const int rows = components(pmode);
    const double *field = hd_pmode_field(pmode, c);
    const double eps = HD_PMODE_EPSILON * dot(p, p, rows) / rows;
    for (int k = 0; k < rows; k++) out[k] = pmode->norm[c] * field[k] * p[k] / (p[k] * p[k] + eps);
}
