/** C -> angles and their distributions [T17]. */
#include "covariant/splitting.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "averages/blocks.h"
#include "base/arrays.h"
#include "base/check.h"
#include "base/memory.h"
#include "covariant/angles.h"

static const double RIGHT_ANGLE = 1.57079632679489661923;

struct hd_splitting {
    int vectors;
    hd_span space[3];     /**< unstable, centre, stable */
    hd_angles *angles;    /**< NULL without pairs of spaces */
    double *found;        /**< [vectors]: principal angles */
    double *mean, *least; /**< [vectors - 1]: of neighbours */
    hd_angle_of_spaces angle[HD_PAIRS_OF_SPACES];
    hd_blocks blocks; /**< of the smallest angles; their weight is their number */
    long samples;
};

static const int PAIR[HD_PAIRS_OF_SPACES][2] = {{0, 2}, {0, 1}, {1, 2}};

static hd_status allocate(hd_splitting *s, int widest)
{
    const size_t n = (size_t)s->vectors;
    double **array[] = {&s->found, &s->mean, &s->least};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++)
        if (!(*array[k] = hd_memory_alloc(n, sizeof(double)))) return HD_NO_MEMORY;
    HD_TRY(hd_blocks_create(&s->blocks, HD_PAIRS_OF_SPACES, 0.0));
    return widest == 0 ? HD_OK : hd_angles_create(&s->angles, s->vectors, widest);
}

/** Dimension of the largest space. */
static int widest_of(const hd_splitting *s)
{
    int widest = 0;
    for (int k = 0; k < 3; k++)
        if (s->space[k].count > widest) widest = s->space[k].count;
    return widest;
}

static void set_spaces(hd_splitting *s, int unstable, int centre)
{
    const int stable = s->vectors - unstable - centre;
    const bool are = unstable > 0 && stable > 0;
    s->space[0] = (hd_span){0, are ? unstable : 0};
    s->space[1] = (hd_span){unstable, are ? centre : 0};
    s->space[2] = (hd_span){unstable + centre, are ? stable : 0};
}

hd_status hd_splitting_create(hd_splitting **out, int vectors, int unstable, int centre)
{
    HD_ASSERT(unstable >= 0 && centre >= 0);
    hd_splitting *s = hd_memory_alloc(1, sizeof *s);
    *out = NULL;
    if (!s) return HD_NO_MEMORY;
    s->vectors = vectors;
    set_spaces(s, unstable, centre);
    const hd_status status = allocate(s, unstable > 0 ? widest_of(s) : vectors);
    if (status == HD_OK) {
        hd_splitting_clear(s);
        *out = s;
    } else {
        hd_splitting_free(s);
    }
    return status;
}

void hd_splitting_free(hd_splitting *s)
{
    if (!s) return;
    hd_angles_free(s->angles);
    hd_memory_free(s->found);
    hd_memory_free(s->mean);
    hd_memory_free(s->least);
    hd_blocks_clear(&s->blocks);
    hd_memory_free(s);
}

void hd_splitting_clear(hd_splitting *s)
{
    s->samples = 0;
    for (int col = 0; col < s->vectors; col++) {
        s->mean[col] = 0.0;
        s->least[col] = RIGHT_ANGLE;
    }
    memset(s->angle, 0, sizeof s->angle);
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++) s->angle[pair].least = RIGHT_ANGLE;
    hd_blocks_restart(&s->blocks);
}

void hd_splitting_divide(hd_splitting *s, int unstable, int centre)
{
    const hd_span before[3] = {s->space[0], s->space[1], s->space[2]};
    set_spaces(s, unstable, centre);
    HD_ASSERT(widest_of(s) == 0 || s->angles);
    if (memcmp(before, s->space, sizeof before) != 0) hd_splitting_clear(s);
}

/* ---- angles -------------------------------------------------------------------------------- */

/** Angle between two vectors of length 1, whatever their signs; small ones keep their digits. */
static double angle_between(const double *x, const double *y, int count)
{
    double dot = 0.0, apart = 0.0;
    for (int row = 0; row < count; row++) dot += x[row] * y[row];
    const double sign = dot < 0 ? -1.0 : 1.0;
    for (int row = 0; row < count; row++)
        apart += (x[row] - sign * y[row]) * (x[row] - sign * y[row]);
    return 2.0 * asin(fmin(1.0, 0.5 * sqrt(apart)));
}

static void add_neighbours(hd_splitting *s, const double *c)
{
    const size_t n = (size_t)s->vectors;
    for (int col = 0; col + 1 < s->vectors; col++) {
        const double *x = c + (size_t)col * n, angle = angle_between(x, x + n, col + 2);
        hd_mean_add(&s->mean[col], &angle, 1, s->samples);
        s->least[col] = fmin(s->least[col], angle);
    }
}

static int bin_of(double angle)
{
    const int bin = (int)(HD_ANGLE_BINS * angle / RIGHT_ANGLE);
    return bin < HD_ANGLE_BINS ? bin : HD_ANGLE_BINS - 1;
}

static void add_angles(hd_angle_of_spaces *a, const double *found, int count, long samples)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) {
        sum += found[k];
        a->all[bin_of(found[k])]++;
    }
    const double mean = sum / count;
    a->last = found[0];
    hd_mean_add(&a->mean, &a->last, 1, samples);
    hd_mean_add(&a->mean_of_all, &mean, 1, samples);
    a->least = fmin(a->least, a->last);
    a->smallest[bin_of(a->last)]++;
}

hd_status hd_splitting_add(hd_splitting *s, const double *c)
{
    double sample[HD_PAIRS_OF_SPACES] = {0};
    s->samples++;
    add_neighbours(s, c);
    if (widest_of(s) == 0) return HD_OK;
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++) {
        const hd_span a = s->space[PAIR[pair][0]], b = s->space[PAIR[pair][1]];
        HD_TRY(a.first == 0 && a.count >= b.count
                   ? hd_angles_leading(s->angles, s->found, c, a.count, b)
                   : hd_angles_between(s->angles, s->found, c, a, b));
        add_angles(&s->angle[pair], s->found, a.count < b.count ? a.count : b.count, s->samples);
        sample[pair] = s->angle[pair].last;
    }
    hd_blocks_add(&s->blocks, sample, 1.0);
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++)
        s->angle[pair].std_error = hd_blocks_error(&s->blocks, &(hd_part){pair, 1.0}, 1);
    return HD_OK;
}

/* ---- results ------------------------------------------------------------------------------- */

hd_splitting_results hd_splitting_read(const hd_splitting *s)
{
    return (hd_splitting_results){.samples = s->samples,
                                  .has_spaces = widest_of(s) > 0,
                                  .angle = s->angle,
                                  .neighbours = s->mean,
                                  .neighbours_least = s->least};
}

static void angle_archive(hd_angle_of_spaces *angle, hd_archive *archive)
{
    double *const numbers[] = {&angle->last, &angle->mean, &angle->std_error, &angle->least,
                               &angle->mean_of_all};
    hd_archive_of_doubles(archive, "angle of spaces", sizeof numbers / sizeof *numbers);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        hd_archive_next_doubles(archive, numbers[k], 1);
    for (int bin = 0; bin < HD_ANGLE_BINS; bin++) {
        hd_archive_long(archive, "angle smallest", &angle->smallest[bin], 0, LONG_MAX / 2);
        hd_archive_long(archive, "angle all", &angle->all[bin], 0, LONG_MAX / 2);
    }
}

void hd_splitting_archive(hd_splitting *s, hd_archive *archive)
{
    const size_t n = (size_t)s->vectors;
    hd_archive_long(archive, "splitting samples", &s->samples, 0, LONG_MAX / 2);
    hd_archive_doubles(archive, "splitting neighbours", s->mean, n);
    hd_archive_doubles(archive, "splitting least", s->least, n);
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++) angle_archive(&s->angle[pair], archive);
    hd_blocks_archive(&s->blocks, archive);
}
