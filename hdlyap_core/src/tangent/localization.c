/** Vectors -> localisation widths and angles between their halves, averaged over times. */
#include "tangent/localization.h"

#include <float.h>
#include <limits.h>
#include <math.h>

#include "averages/blocks.h"
#include "base/arrays.h"
#include "base/check.h"
#include "base/memory.h"

/** Columns that are measured together. */
enum { BLOCK = 64 };

struct hd_localization {
    int particles, coordinates, vectors, threads;
    long samples;
    double *entropy, *cosine, *width; /**< [vectors]: means; width is filled when it is read */
    double *measured;                 /**< [2 * vectors], at one time: entropy, then |cos| */
    hd_blocks blocks;                 /**< blocks of entropies; the weight is their number */
};

double hd_localization_bytes(double vectors)
{
    return 5.0 * sizeof(double) * vectors + hd_blocks_bytes(vectors);
}

static hd_status allocate(hd_localization *shape)
{
    const size_t n = (size_t)shape->vectors;
    shape->entropy = hd_memory_alloc(n, sizeof *shape->entropy);
    shape->cosine = hd_memory_alloc(n, sizeof *shape->cosine);
    shape->width = hd_memory_alloc(n, sizeof *shape->width);
    shape->measured = hd_memory_alloc(2 * n, sizeof *shape->measured);
    if (!shape->entropy || !shape->cosine || !shape->width || !shape->measured) return HD_NO_MEMORY;
    return hd_blocks_create(&shape->blocks, shape->vectors, 0.0);
}

hd_status hd_localization_create(hd_localization **out, int particles, int coordinates, int vectors,
                                 int threads)
{
    hd_localization *shape = hd_memory_alloc(1, sizeof *shape);
    *out = NULL;
    if (!shape) return HD_NO_MEMORY;
    shape->particles = particles;
    shape->coordinates = coordinates;
    shape->vectors = vectors;
    shape->threads = threads;
    const hd_status status = allocate(shape);
    if (status == HD_OK)
        *out = shape;
    else
        hd_localization_free(shape);
    return status;
}

void hd_localization_free(hd_localization *shape)
{
    if (!shape) return;
    hd_memory_free(shape->entropy);
    hd_memory_free(shape->cosine);
    hd_memory_free(shape->width);
    hd_memory_free(shape->measured);
    hd_blocks_clear(&shape->blocks);
    hd_memory_free(shape);
}

void hd_localization_clear(hd_localization *shape)
{
    shape->samples = 0;
    for (int col = 0; col < shape->vectors; col++) shape->entropy[col] = shape->cosine[col] = 0.0;
    for (int k = 0; k < 2 * shape->vectors; k++) shape->measured[k] = 0.0;
    hd_blocks_restart(&shape->blocks);
}

/** Sums of some columns: entropy; dq.dq, dp.dp, dq.dp. */
typedef struct sums {
    double entropy[BLOCK], dq[BLOCK], dp[BLOCK], dqdp[BLOCK];
} sums;

static void add_particle(sums *s, const double *row, size_t half, size_t stride, int count)
{
    for (int col = 0; col < count; col++) {
        double dq = 0.0, dp = 0.0, dqdp = 0.0;
        for (size_t d = 0; d < half; d++) {
            const double q = row[d * stride + (size_t)col],
                         p = row[(half + d) * stride + (size_t)col];
            dq += q * q;
            dp += p * p;
            dqdp += q * p;
        }
        const double part = dq + dp;
        s->entropy[col] -= part > DBL_MIN ? part * log(part) : 0.0;
        s->dq[col] += dq;
        s->dp[col] += dp;
        s->dqdp[col] += dqdp;
    }
}

static void measure_block(const hd_localization *shape, hd_columns v, int begin)
{
    sums s = {.entropy = {0.0}};
    const size_t stride = (size_t)v.stride;
    const int count = v.count - begin < BLOCK ? v.count - begin : BLOCK;
    double *entropy = shape->measured + v.first + begin, *cosine = entropy + shape->vectors;
    const size_t half = (size_t)shape->coordinates;
    for (int particle = 0; particle < shape->particles; particle++)
        add_particle(&s, v.data + 2 * half * (size_t)particle * stride + begin, half, stride,
                     count);
    for (int col = 0; col < count; col++) {
        const double product = sqrt(s.dq[col]) * sqrt(s.dp[col]);
        entropy[col] = s.entropy[col];
        cosine[col] = product > 0 ? fabs(s.dqdp[col]) / product : 0.0;
    }
}

void hd_localization_measure(hd_localization *shape, hd_columns columns)
{
    HD_ASSERT(columns.first >= 0 && columns.first + columns.count <= shape->vectors);
#pragma omp parallel for schedule(static) num_threads(shape->threads) if (shape->threads > 1)
    for (int col = 0; col < columns.count; col += BLOCK) measure_block(shape, columns, col);
}

double *hd_localization_measured(hd_localization *shape) { return shape->measured; }

void hd_localization_add(hd_localization *shape)
{
    const size_t n = (size_t)shape->vectors;
    const double *entropy = shape->measured, *cosine = entropy + n;
    shape->samples++;
    hd_mean_add(shape->entropy, entropy, n, shape->samples);
    hd_mean_add(shape->cosine, cosine, n, shape->samples);
    hd_blocks_add(&shape->blocks, entropy, 1.0);
}

long hd_localization_samples(const hd_localization *shape) { return shape->samples; }

static double width_of(const hd_localization *shape, double entropy)
{
    return exp(entropy) / shape->particles;
}

const double *hd_localization_widths(hd_localization *shape)
{
    for (int col = 0; col < shape->vectors; col++)
        shape->width[col] = width_of(shape, shape->entropy[col]);
    return shape->width;
}

/** Uses d exp(S) = exp(S) dS. */
double hd_localization_width_error(const hd_localization *shape, int col)
{
    const double error = hd_blocks_error(&shape->blocks, &(hd_part){col, 1.0}, 1);
    return error < 0 ? error : width_of(shape, shape->entropy[col]) * error;
}

double hd_localization_width_now(const hd_localization *shape, int col)
{
    return width_of(shape, shape->measured[col]);
}

const double *hd_localization_cosines(const hd_localization *shape) { return shape->cosine; }

void hd_localization_archive(hd_localization *shape, hd_archive *archive)
{
    const size_t n = (size_t)shape->vectors;
    hd_archive_long(archive, "shape samples", &shape->samples, 0, LONG_MAX / 2);
    hd_archive_doubles(archive, "shape entropy", shape->entropy, n);
    hd_archive_doubles(archive, "shape cosine", shape->cosine, n);
    hd_archive_doubles(archive, "shape measured", shape->measured, n);
    hd_blocks_archive(&shape->blocks, archive);
}
