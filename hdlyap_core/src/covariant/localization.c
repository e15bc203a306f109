/** Vectors -> localisation widths and angles between their halves, averaged over times. */
#include "covariant/localization.h"

#include <float.h>
#include <limits.h>
#include <math.h>

#include "base/check.h"
#include "base/memory.h"

struct hd_localization {
    int disks, vectors;
    long samples;
    double *entropy, *cosine, *width; /**< [vectors]: means; the last one for whoever asks */
    double *now, *square[3];          /**< [vectors]: of one time: entropy; dq.dq, dp.dp, dq.dp */
};

hd_status hd_localization_create(hd_localization **out, int disks, int vectors)
{
    hd_localization *shape = hd_memory_alloc(1, sizeof *shape);
    *out = NULL;
    if (!shape) return HD_NO_MEMORY;
    shape->disks = disks;
    shape->vectors = vectors;
    double **array[] = {&shape->entropy,   &shape->cosine,    &shape->width,    &shape->now,
                        &shape->square[0], &shape->square[1], &shape->square[2]};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++)
        if (!(*array[k] = hd_memory_alloc((size_t)vectors, sizeof(double)))) {
            hd_localization_free(shape);
            return HD_NO_MEMORY;
        }
    *out = shape;
    return HD_OK;
}

void hd_localization_free(hd_localization *shape)
{
    if (!shape) return;
    hd_memory_free(shape->entropy);
    hd_memory_free(shape->cosine);
    hd_memory_free(shape->width);
    hd_memory_free(shape->now);
    for (int k = 0; k < 3; k++) hd_memory_free(shape->square[k]);
    hd_memory_free(shape);
}

void hd_localization_clear(hd_localization *shape)
{
    shape->samples = 0;
    for (int col = 0; col < shape->vectors; col++) shape->entropy[col] = shape->cosine[col] = 0.0;
}

static void add_disk(hd_localization *shape, const double *row, size_t stride)
{
    const double *x = row, *y = row + stride, *px = row + 2 * stride, *py = row + 3 * stride;
    for (int col = 0; col < shape->vectors; col++) {
        const double dq = x[col] * x[col] + y[col] * y[col],
                     dp = px[col] * px[col] + py[col] * py[col];
        const double part = dq + dp;
        shape->now[col] -= part > DBL_MIN ? part * log(part) : 0.0;
        shape->square[0][col] += dq;
        shape->square[1][col] += dp;
        shape->square[2][col] += x[col] * px[col] + y[col] * py[col];
    }
}

void hd_localization_add(hd_localization *shape, hd_columns columns)
{
    HD_ASSERT(columns.count == shape->vectors);
    const size_t stride = (size_t)columns.stride;
    for (int col = 0; col < shape->vectors; col++)
        shape->now[col] = shape->square[0][col] = shape->square[1][col] = shape->square[2][col] =
            0.0;
    for (int disk = 0; disk < shape->disks; disk++)
        add_disk(shape, columns.data + 4 * (size_t)disk * stride, stride);
    shape->samples++;
    for (int col = 0; col < shape->vectors; col++) {
        const double product = sqrt(shape->square[0][col]) * sqrt(shape->square[1][col]);
        const double cosine = product > 0 ? fabs(shape->square[2][col]) / product : 0.0;
        shape->entropy[col] += (shape->now[col] - shape->entropy[col]) / (double)shape->samples;
        shape->cosine[col] += (cosine - shape->cosine[col]) / (double)shape->samples;
    }
}

const double *hd_localization_widths(hd_localization *shape)
{
    for (int col = 0; col < shape->vectors; col++)
        shape->width[col] = exp(shape->entropy[col]) / shape->disks;
    return shape->width;
}

const double *hd_localization_cosines(const hd_localization *shape) { return shape->cosine; }

void hd_localization_archive(hd_localization *shape, hd_archive *archive)
{
    hd_archive_long(archive, "shape samples", &shape->samples, 0, LONG_MAX / 2);
    hd_archive_doubles(archive, "shape entropy", shape->entropy, (size_t)shape->vectors);
    hd_archive_doubles(archive, "shape cosine", shape->cosine, (size_t)shape->vectors);
}
