/** Positions and momenta -> sampled fields [T10], [T22].
 *
 * Row-major, a row for each coordinate of each particle: the right-hand factor of a dgemm against
 * the rows of the frame. The functions of one coordinate are tabulated for each particle, each
 * field is a product of them.
 */
#include "modes/fields.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "modes/curved_fields.h"
#include "modes/harmonics.h"
#include "modes/plane_fields.h"
#include "scene/container.h"
#include "scene/null_space.h"

/** No entry of a column of norm 1 is larger, but for rounding. */
static const double LONGEST = 1.0 + 1e-9;

struct hd_fields {
    int dimension, coordinates, particles, columns, stride, subspaces;
    hd_harmonics along[HD_DIMENSION_MAX];
    hd_null_space null;
    const hd_container_row *container;
    hd_subspace *subspace;      /**< [subspaces] */
    double (*own)[HD_WAVE_OWN]; /**< [subspaces], by the container; NULL in a box */
    double **row;               /**< [coordinates]: rows of the particle that is sampled */
    double *data;               /**< [coordinates * particles * stride] */
    double *norm;               /**< [stride]: norms of the columns before they were made 1 */
};

/* ---- creation ------------------------------------------------------------------------------ */

static void subspace_add(hd_fields *fields, hd_mode_kind kind, const hd_wave *wave,
                         hd_modulations modulations)
{
    const int dimension = modulations.count * (kind == HD_MODE_LP ? 2 : 1);
    if (dimension == 0) return;
    fields->subspace[fields->subspaces++] = (hd_subspace){kind, *wave, modulations, fields->columns,
                                                          dimension};
    fields->columns += dimension;
    for (int d = 0; d < fields->dimension; d++)
        if (wave->n[d] > fields->along[d].nodes) fields->along[d].nodes = wave->n[d];
}

static void count_wave(void *to, const hd_wave *wave)
{
    hd_fields_count *all = to;
    const double pairs = wave->pairs.count, t = wave->transverse.count;
    all->subspaces += (t > 0) + (pairs > 0);
    all->columns += t + 2.0 * pairs;
    all->lp_phases += 2.0 * pairs * pairs;
    all->t_phases += 2.0 * floor(t / 2.0) * floor(t / 2.0);
}

hd_fields_count hd_fields_count_of(const hd_scene_def *scene)
{
    hd_fields_count all = {.columns = 0.0};
    hd_container_of(scene)->waves(scene, count_wave, &all);
    return all;
}

static hd_status subspaces_create(hd_fields *fields, const hd_scene_def *def)
{
    const int waves = hd_waves(def, NULL, 0);
    hd_wave *wave = hd_memory_alloc((size_t)waves + 1, sizeof *wave);
    fields->subspace = hd_memory_alloc(2 * (size_t)waves + 1, sizeof *fields->subspace);
    if (!wave || !fields->subspace) {
        hd_memory_free(wave);
        return HD_NO_MEMORY;
    }
    (void)hd_waves(def, wave, waves);
    for (int w = 0; w < waves; w++) {
        subspace_add(fields, HD_MODE_T, &wave[w], wave[w].transverse);
        subspace_add(fields, HD_MODE_LP, &wave[w], wave[w].pairs);
    }
    hd_memory_free(wave);
    return HD_OK;
}

/** Prepares what sampling needs of each wave. */
static hd_status waves_prepare(hd_fields *fields, const hd_scene_def *def)
{
    if (!fields->container->modulations) {
        for (int d = 0; d < fields->dimension; d++)
            HD_TRY(hd_harmonics_create(&fields->along[d], def, d, fields->along[d].nodes));
        return HD_OK;
    }
    fields->own = hd_memory_alloc((size_t)fields->subspaces + 1, sizeof *fields->own);
    if (!fields->own) return HD_NO_MEMORY;
    for (int s = 0; s < fields->subspaces; s++)
        fields->container->of_wave(def, &fields->subspace[s].wave, fields->own[s]);
    return HD_OK;
}

static size_t components(const hd_fields *fields)
{
    return (size_t)fields->coordinates * (size_t)fields->particles;
}

static size_t data_size(const hd_fields *fields)
{
    return components(fields) * (size_t)fields->stride;
}

static hd_status fields_prepare(hd_fields *fields, const hd_scene_def *def)
{
    HD_TRY(subspaces_create(fields, def));
    fields->null = hd_null_space_of(def);
    fields->container = hd_container_of(def);
    HD_TRY(waves_prepare(fields, def));
    fields->columns += hd_fields_nulls(fields);
    fields->stride = (fields->columns + 7) / 8 * 8;
    fields->data = hd_memory_alloc(data_size(fields), sizeof(double));
    fields->norm = hd_memory_alloc((size_t)fields->stride, sizeof(double));
    fields->row = hd_memory_alloc((size_t)fields->coordinates, sizeof *fields->row);
    return fields->data && fields->norm && fields->row ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_fields_create(hd_fields **out, const hd_scene_def *def)
{
    hd_fields *fields = hd_memory_alloc(1, sizeof *fields);
    *out = NULL;
    if (!fields) return HD_NO_MEMORY;
    fields->dimension = hd_scene_dimension(def);
    fields->coordinates = hd_scene_coordinates(def);
    fields->particles = def->number;
    const hd_status status = fields_prepare(fields, def);
    if (status == HD_OK)
        *out = fields;
    else
        hd_fields_free(fields);
    return status;
}

void hd_fields_free(hd_fields *fields)
{
    if (!fields) return;
    for (int d = 0; d < HD_DIMENSION_MAX; d++) hd_harmonics_clear(&fields->along[d]);
    hd_memory_free(fields->subspace);
    hd_memory_free(fields->own);
    hd_memory_free(fields->row);
    hd_memory_free(fields->data);
    hd_memory_free(fields->norm);
    hd_memory_free(fields);
}

/* ---- sampling ------------------------------------------------------------------------------ */

/** Samples coordinates that are no place, as an angle: P = p A has their momenta, T and L vanish.
 */
static void sample_other(hd_fields *fields, const hd_subspace *s, double *const *row,
                         const double *p)
{
    for (int c = 0; c < s->modulations.count && s->kind == HD_MODE_LP; c++) {
        double a = 1.0;
        for (int d = 0; d < fields->dimension; d++)
            a *= fields->along[d].value[2 * s->wave.n[d] + (s->modulations.bits[c] >> d & 1)];
        for (int d = fields->dimension; d < fields->coordinates; d++)
            row[d][s->column + s->modulations.count + c] = p[d] * a;
    }
}

static void sample_box(hd_fields *fields, double *const *row, const double *q, const double *p)
{
    for (int d = 0; d < fields->dimension; d++) hd_harmonics_fill(&fields->along[d], q[d]);
    for (int s = 0; s < fields->subspaces; s++) {
        if (fields->dimension == 2)
            hd_plane_fields_fill(row, &fields->subspace[s], fields->along, p);
        else
            hd_space_fields_fill(row, &fields->subspace[s], fields->along, p);
        if (fields->coordinates > fields->dimension)
            sample_other(fields, &fields->subspace[s], row, p);
    }
}

static void sample_curved(hd_fields *fields, double *const *row, const double *q, const double *p)
{
    for (int s = 0; s < fields->subspaces; s++)
        hd_curved_fields_fill(row, &fields->subspace[s], fields->container, fields->own[s], q, p);
}

/** Weights T and L by the root of the particle's mass; P = p A has that in its momentum. */
static void weigh(hd_fields *fields, double *const *row, double root)
{
    for (int s = 0; s < fields->subspaces; s++) {
        const hd_subspace *of = &fields->subspace[s];
        for (int c = 0; c < of->modulations.count; c++)
            for (int d = 0; d < fields->dimension; d++) row[d][of->column + c] *= root;
    }
}

static void sample_particle(hd_fields *fields, const double *q, const double *p, double root)
{
    const int null = fields->columns - hd_fields_nulls(fields);
    double *const *row = fields->row;
    if (fields->own)
        sample_curved(fields, row, q, p);
    else
        sample_box(fields, row, q, p);
    if (root != 1) weigh(fields, row, root);
    for (int k = 0; k < fields->null.count; k++) {
        const int axis = fields->null.axis[k];
        for (int d = 0; d < fields->coordinates; d++)
            row[d][null + axis] = hd_null_entry(&fields->null, axis, d, q, p, root);
    }
}

/** Scales columns to norm 1; a column that vanishes at every particle stays zero. */
static void normalise(hd_fields *fields)
{
    const size_t rows = components(fields), stride = (size_t)fields->stride;
    for (int c = 0; c < fields->columns; c++) fields->norm[c] = 0.0;
    for (size_t row = 0; row < rows; row++)
        for (int c = 0; c < fields->columns; c++) {
            const double value = fields->data[row * stride + (size_t)c];
            fields->norm[c] += value * value;
        }
    for (int c = 0; c < fields->columns; c++) fields->norm[c] = sqrt(fields->norm[c]);
    for (size_t row = 0; row < rows; row++)
        for (int c = 0; c < fields->columns; c++)
            fields->data[row * stride + (size_t)c] /= fmax(fields->norm[c], DBL_MIN);
}

void hd_fields_sample(hd_fields *fields, const double *q, const double *p)
{
    const size_t stride = (size_t)fields->stride, of_one = (size_t)fields->coordinates;
    for (size_t j = 0; j < (size_t)fields->particles; j++) {
        for (size_t d = 0; d < of_one; d++)
            fields->row[d] = fields->data + (of_one * j + d) * stride;
        sample_particle(fields, q + of_one * j, p + of_one * j,
                        hd_kinds_root(&fields->null.kinds, (int)j));
    }
    normalise(fields);
}

void hd_fields_clear(hd_fields *fields)
{
    memset(fields->data, 0, data_size(fields) * sizeof *fields->data);
    memset(fields->norm, 0, (size_t)fields->stride * sizeof *fields->norm);
}

/** Reads or writes the last sample: modes are reconstructed from it. */
void hd_fields_archive(hd_fields *fields, hd_archive *archive)
{
    hd_archive_doubles(archive, "fields", fields->data, data_size(fields));
    hd_archive_doubles(archive, "fields norm", fields->norm, (size_t)fields->stride);
    bool normal = true;
    for (size_t k = 0; k < data_size(fields); k++) normal &= fabs(fields->data[k]) <= LONGEST;
    hd_archive_expect(archive, normal, "fields", "one is longer than 1");
}

int hd_fields_nulls(const hd_fields *fields) { return fields->dimension + 1; }
int hd_fields_columns(const hd_fields *fields) { return fields->columns; }
int hd_fields_stride(const hd_fields *fields) { return fields->stride; }
const double *hd_fields_data(const hd_fields *fields) { return fields->data; }

double hd_fields_norm(const hd_fields *fields, int column)
{
    HD_ASSERT(column >= 0 && column < fields->columns);
    return fields->norm[column];
}

int hd_fields_subspaces(const hd_fields *fields) { return fields->subspaces; }

const hd_subspace *hd_fields_subspace(const hd_fields *fields, int s)
{
    HD_ASSERT(s >= 0 && s < fields->subspaces);
    return &fields->subspace[s];
}
