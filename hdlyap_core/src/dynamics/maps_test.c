/** Record -> whether tangent maps do what a row of dynamics says: in parts, symplectic, with null
 * vectors, exponents that vanish and divergence. Blocks are [rows][width], as hd_dynamics.carry
 * takes them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/trial.h"
#include "scene/scene.h"

/** Time of a record, for parts and products, and for null vectors, which drift from their space
 * with the growth of others [hd_trial.unit]; entries that a record may have. */
static const double TIME = 3.0, TIME_NULL = 1.0, ENTRIES = 1e6;
enum {
    COLUMNS = 8,        /* random vectors that are carried */
    CUTS = 5,           /* of a record */
    HALVINGS = 6,       /* of TIME_NULL, at most */
    EXPONENTS_MOST = 64 /* for which exponents that vanish are counted */
};
/** Part of the largest component by which vectors may differ by rounding, which growth enlarges;
 * part of two lengths, which have grown as rounding has, by which their product may. */
static const double ROUNDED = 1e-9, PRODUCT_ROUNDED = 1e-12;
/** Sine of the angle by which null vectors may leave their space; one of particles that move in
 * time steps may be known only to the square of a step, so that others must not
 * grow by more than this meanwhile. */
static const double NULL_CLOSE = 0.1, GROWTH = 2.0;

static double *block_create(const hd_trial *t, size_t width)
{
    return hd_memory_alloc(t->rows * width, sizeof(double));
}

static void fill_random(hd_trial *t, double *block, size_t width)
{
    for (size_t k = 0; k < t->rows * width; k++) block[k] = hd_random_symmetric(&t->random);
}

/** What the tests of one record share. */
typedef struct leg {
    hd_record *record;
    double time, *x[2], *block[2]; /**< x: q, p of its begin and end */
} leg;

static void leg_clear(leg *l)
{
    hd_record_free(l->record);
    for (int k = 0; k < 2; k++) hd_memory_free(l->x[k]);
    for (int k = 0; k < 2; k++) hd_memory_free(l->block[k]);
}

/** A record of so many units from the kept state on, with two blocks of this width. */
static hd_status leg_create(leg *l, hd_trial *t, const hd_image *start, double units, size_t width)
{
    *l = (leg){.time = hd_trial_time(t, units, ENTRIES)};
    for (int k = 0; k < 2; k++) {
        l->block[k] = block_create(t, width);
        l->x[k] = block_create(t, 1);
        if (!l->block[k] || !l->x[k]) return HD_NO_MEMORY;
    }
    HD_TRY(hd_trial_go(t, &l->record, l->x[0], l->x[1], start, l->time));
    l->time = hd_record_duration(l->record);
    return HD_OK;
}

/** test(t, l) with such a leg. */
static hd_status with_leg(hd_trial *t, const hd_image *start, double units, size_t width,
                          hd_status (*test)(hd_trial *t, leg *l))
{
    leg l;
    hd_status status = leg_create(&l, t, start, units, width);
    if (status == HD_OK) status = test(t, &l);
    leg_clear(&l);
    return status;
}

/* ---- parts --------------------------------------------------------------------------------- */

/** Carries through the record in parts, one of which begins with an entry. */
static hd_status carry_in_parts(hd_trial *t, double *block, const leg *l)
{
    const size_t count = hd_record_count(l->record);
    const double entry = count ? *(const double *)hd_record_entry(l->record, count / 2) : 0.0;
    double from = 0.0;
    for (int k = 1; k <= CUTS; k++) {
        const double to = l->time * (k - 0.5 * hd_trial_random(t)) / (CUTS + 1);
        if (from < entry && entry < to) {
            HD_TRY(hd_trial_carry(t, block, COLUMNS, l->record, from, entry));
            from = entry;
        }
        HD_TRY(hd_trial_carry(t, block, COLUMNS, l->record, from, to));
        from = to;
    }
    return hd_trial_carry(t, block, COLUMNS, l->record, from, l->time);
}

/** Largest difference of two blocks, of which only the first columns are compared, as a part of the
 * largest component. */
static double difference(const hd_trial *t, const double *a, int width_a, const double *b,
                         int width_b)
{
    double most = 0.0, size = 0.0;
    for (size_t row = 0; row < t->rows; row++)
        for (int col = 0; col < width_a && col < width_b; col++) {
            const double x = a[row * (size_t)width_a + (size_t)col],
                         y = b[row * (size_t)width_b + (size_t)col];
            most = fmax(most, fabs(x - y));
            size = fmax(size, fabs(x));
        }
    return most / size;
}

static hd_status compare_cuts(hd_trial *t, leg *l)
{
    fill_random(t, l->block[0], COLUMNS);
    memcpy(l->block[1], l->block[0], t->rows * COLUMNS * sizeof(double));
    double *alone = l->x[0];
    for (size_t row = 0; row < t->rows; row++) alone[row] = l->block[0][row * COLUMNS];
    HD_TRY(hd_trial_carry(t, l->block[0], COLUMNS, l->record, 0.0, l->time));
    HD_TRY(carry_in_parts(t, l->block[1], l));
    HD_TRY(hd_trial_carry(t, alone, 1, l->record, 0.0, l->time));
    const double parts = difference(t, l->block[0], COLUMNS, l->block[1], COLUMNS),
                 widths = difference(t, l->block[0], COLUMNS, alone, 1);
    if (!(parts <= ROUNDED))
        return hd_refuse(t->message, t->size,
                         "carry: a record of %g time units that is cut into parts carries vectors "
                         "otherwise, by %.3g of their size",
                         l->time, parts);
    if (!(widths <= ROUNDED))
        return hd_refuse(t->message, t->size,
                         "carry: a vector alone is carried otherwise than among %d, by %.3g of its "
                         "size",
                         COLUMNS, widths);
    return HD_OK;
}

hd_status hd_maps_test_cuts(hd_trial *t, const hd_image *start)
{
    return with_leg(t, start, TIME, COLUMNS, compare_cuts);
}

/* ---- symplectic ---------------------------------------------------------------------------- */

static double length_of(const hd_trial *t, const double *block, size_t width, size_t col)
{
    double square = 0.0;
    for (size_t row = 0; row < t->rows; row++)
        square += block[row * width + col] * block[row * width + col];
    return sqrt(square);
}

/** dq_a . dp_b - dp_a . dq_b */
static double area(const hd_trial *t, const double *block, size_t a, size_t b)
{
    const size_t half = (size_t)t->of->coordinates;
    double sum = 0.0;
    for (size_t row = 0; row < t->rows; row++) {
        if (row / half % 2 == 1) continue;
        const double *dq = block + row * COLUMNS, *dp = dq + half * COLUMNS;
        sum += dq[a] * dp[b] - dp[a] * dq[b];
    }
    return sum;
}

static hd_status compare_areas(hd_trial *t, leg *l)
{
    double most = 0.0;
    fill_random(t, l->block[0], COLUMNS);
    memcpy(l->block[1], l->block[0], t->rows * COLUMNS * sizeof(double));
    HD_TRY(hd_trial_carry(t, l->block[1], COLUMNS, l->record, 0.0, l->time));
    for (size_t a = 0; a < COLUMNS; a++)
        for (size_t b = 0; b < a; b++) {
            const double change = area(t, l->block[1], a, b) - area(t, l->block[0], a, b);
            most = fmax(most, fabs(change) / (length_of(t, l->block[1], COLUMNS, a) *
                                              length_of(t, l->block[1], COLUMNS, b)));
        }
    if (most <= PRODUCT_ROUNDED) return HD_OK;
    return hd_refuse(t->message, t->size,
                     "symplectic: must be false: S^T J S differs from J by %.3g of the lengths "
                     "after %g time units",
                     most, l->time);
}

hd_status hd_maps_test_symplectic(hd_trial *t, const hd_image *start)
{
    return hd_scene_symplectic(&t->scene) ? with_leg(t, start, TIME, COLUMNS, compare_areas)
                                          : HD_OK;
}

/* ---- null vectors -------------------------------------------------------------------------- */

/** Makes column `col` orthogonal to those before it, and of length 1; 0 if it depends on them.
 * Returns its length before that. */
static double make_orthonormal(const hd_trial *t, double *block, size_t width, size_t col)
{
    const double before = length_of(t, block, width, col);
    for (size_t k = 0; k < 2 * col; k++) { /* twice, to rounding */
        double overlap = 0.0;
        for (double *x = block; x < block + t->rows * width; x += width)
            overlap += x[k % col] * x[col];
        for (double *x = block; x < block + t->rows * width; x += width)
            x[col] -= overlap * x[k % col];
    }
    const double length = length_of(t, block, width, col);
    const double factor = length > 1e-10 * before ? 1.0 / length : 0.0;
    for (double *x = block; x < block + t->rows * width; x += width) x[col] *= factor;
    return length;
}

/** The smallest width that a row must carry and that is not below count. */
static int width_for(int count)
{
    int width = 1;
    while (width < count) width *= 2;
    return width;
}

/** Null vectors of a state as a block, and their number. */
static hd_status null_block(hd_trial *t, double *block, int width, const double *x, int *count)
{
    const size_t room = (size_t)(hd_scene_zero_exponents(&t->scene) + HD_NULL_SPARE);
    double *column = block_create(t, room);
    if (!column) return HD_NO_MEMORY;
    const hd_status status = hd_null_vectors_of(count, &t->scene, x, x + t->rows / 2, column);
    for (int k = 0; k < *count && status == HD_OK; k++)
        for (size_t row = 0; row < t->rows; row++)
            block[row * (size_t)width + (size_t)k] = column[(size_t)k * t->rows + row];
    hd_memory_free(column);
    return status != HD_DYNAMICS_FAULT
               ? status
               : hd_refuse(t->message, t->size,
                           "null_vectors = %d: must be from 0 to zero_exponents = %d", *count,
                           hd_scene_zero_exponents(&t->scene));
}

/** Length of column col of `block` outside of the span of `basis`, as a part of its length. */
static double outside(const hd_trial *t, const double *block, double *basis, size_t width,
                      size_t col, size_t spanned)
{
    const double length = length_of(t, block, width, col);
    for (size_t row = 0; row < t->rows; row++)
        basis[row * width + spanned] = block[row * width + col];
    return length > 0 ? make_orthonormal(t, basis, width, spanned) / length : 0.0;
}

static hd_status compare_null(hd_trial *t, leg *l)
{
    const int most = hd_scene_zero_exponents(&t->scene);
    const size_t width = (size_t)width_for(most + 1);
    int before, after;
    HD_TRY(null_block(t, l->block[0], (int)width, l->x[0], &before));
    HD_TRY(null_block(t, l->block[1], (int)width, l->x[1], &after));
    HD_TRY(hd_trial_carry(t, l->block[0], (int)width, l->record, 0.0, l->time));
    for (int k = 0; k < after; k++) (void)make_orthonormal(t, l->block[1], width, (size_t)k);
    for (int k = 0; k < before; k++) {
        const double left = outside(t, l->block[0], l->block[1], width, (size_t)k, (size_t)after);
        if (!(left <= NULL_CLOSE))
            return hd_refuse(t->message, t->size,
                             "null_vectors: vector %d is carried out of the span of the later ones "
                             "by %.3g of its length in %g time units",
                             k, left, l->time);
    }
    return HD_OK;
}

/** Finds a time in which random vectors grow little, so that what is known of null vectors only to
 * the square of a time step stays close. */
static hd_status find_units(hd_trial *t, const hd_image *start, double *units)
{
    hd_status status = HD_OK;
    *units = TIME_NULL;
    for (int k = 0; k < HALVINGS && status == HD_OK; k++, *units *= 0.5) {
        leg l;
        double growth = 0.0;
        status = leg_create(&l, t, start, *units, COLUMNS);
        if (status == HD_OK) {
            fill_random(t, l.block[0], COLUMNS);
            memcpy(l.block[1], l.block[0], t->rows * COLUMNS * sizeof(double));
            status = hd_trial_carry(t, l.block[1], COLUMNS, l.record, 0.0, l.time);
        }
        for (size_t col = 0; col < COLUMNS && status == HD_OK; col++)
            growth = fmax(growth, length_of(t, l.block[1], COLUMNS, col) /
                                      length_of(t, l.block[0], COLUMNS, col));
        leg_clear(&l);
        if (growth <= GROWTH) return status;
    }
    return status;
}

hd_status hd_maps_test_null(hd_trial *t, const hd_image *start)
{
    const int width = width_for(hd_scene_zero_exponents(&t->scene) + 1);
    double units;
    if (!t->of->null_vectors || width > HD_BLOCK_WIDTH_MAX) return HD_OK;
    HD_TRY(find_units(t, start, &units));
    return with_leg(t, start, units, (size_t)width, compare_null);
}

/* ---- exponents that vanish ----------------------------------------------------------------- */

/** Units of time that exponents need, and components of vectors times entries that are allowed. */
static const double UNITS = 100.0, UNITS_MOST = 400.0, WORK = 5e7;

/** Part of the growth of all vectors together by which `divergence` may differ from that of their
 * volume, as time steps are of some length. */
static const double DIVERGENCE_CLOSE = 0.01;

static int by_size(const void *a, const void *b)
{
    const double x = fabs(*(const double *)a), y = fabs(*(const double *)b);
    return (x > y) - (x < y);
}

/** Adds the growth of all vectors over `units` pieces of the time to sum[rows]. */
static hd_status add_growth(hd_trial *t, double *sum, double *block, hd_trajectory *tr,
                            hd_record *record, int units)
{
    const int width = width_for((int)t->rows);
    for (size_t k = 0; k < t->rows; k++) block[k * (size_t)width + k] = 1.0;
    for (int u = 0; u < units; u++) {
        hd_record_clear(record);
        HD_TRY(hd_trial_advance(t, tr, record, hd_trajectory_time(tr) + t->unit));
        HD_TRY(hd_trial_carry(t, block, width, record, 0.0, hd_record_duration(record)));
        for (size_t k = 0; k < t->rows; k++)
            sum[k] += log(make_orthonormal(t, block, (size_t)width, k));
    }
    return HD_OK;
}

/** grown[rows]: growth of all vectors; told: that of the integral of the divergence, or NaN. */
static hd_status judge_divergence(hd_trial *t, const double *grown, double told)
{
    double volume = 0.0, size = 0.0;
    for (size_t k = 0; k < t->rows; k++) {
        volume += grown[k];
        size += fabs(grown[k]);
    }
    if (!hd_scene_diverges(&t->scene) || fabs(told - volume) <= DIVERGENCE_CLOSE * size)
        return HD_OK;
    return hd_refuse(t->message, t->size,
                     "divergence: must be the logarithm of the volume that maps carry: it changes "
                     "by %.6g, that by %.6g",
                     told, volume);
}

/** exponent[rows], by size. A zero is below some ln t / t. */
static hd_status judge_zeros(hd_trial *t, const double *exponent, double time)
{
    const double small = (3.0 * log(time / t->unit) + 5.0) / time;
    const int zeros = hd_scene_zero_exponents(&t->scene), all = (int)t->rows;
    if (!t->of->zero_exponents && !hd_scene_symplectic(&t->scene))
        return HD_OK; /* their errors will count them */
    if (zeros > 0 && !(fabs(exponent[zeros - 1]) <= 3.0 * small))
        return hd_refuse(t->message, t->size,
                         "zero_exponents = %d: must be less: number %d by size is %.3g after %g "
                         "time units, where those that vanish are below %.2g",
                         zeros, zeros, fabs(exponent[zeros - 1]), time, small);
    if (!hd_scene_symplectic(&t->scene)) return HD_OK; /* slow ones, as damped momenta, are alike */
    for (int k = zeros; k + 1 < all; k++)
        if (fabs(exponent[k]) <= small && fabs(exponent[k + 1]) > 3.0 * small &&
            fabs(exponent[k + 1]) > 5.0 * fabs(exponent[k]))
            return hd_refuse(t->message, t->size,
                             "zero_exponents = %d: must be %d: so many are below %.2g after %g "
                             "time units, and the next one is %.3g",
                             zeros, k + 1, small, time, fabs(exponent[k + 1]));
    return HD_OK;
}

static hd_status count_zeros(hd_trial *t, const hd_image *start, int units)
{
    hd_trajectory *tr = NULL;
    hd_record *record = NULL;
    double *sum = block_create(t, 1), *block = block_create(t, (size_t)width_for((int)t->rows));
    hd_status status = sum && block ? hd_record_create(&record, t->of->entry) : HD_NO_MEMORY;
    if (status == HD_OK) status = hd_trial_make(t, &tr, start);
    const double before = status == HD_OK ? hd_trajectory_divergence(tr) : NAN;
    if (status == HD_OK) status = add_growth(t, sum, block, tr, record, units);
    if (status == HD_OK) status = judge_divergence(t, sum, hd_trajectory_divergence(tr) - before);
    for (size_t k = 0; k < t->rows && status == HD_OK; k++) sum[k] /= units * t->unit;
    if (status == HD_OK) qsort(sum, t->rows, sizeof *sum, by_size);
    if (status == HD_OK) status = judge_zeros(t, sum, units * t->unit);
    hd_trajectory_free(tr);
    hd_record_free(record);
    hd_memory_free(sum);
    hd_memory_free(block);
    return status;
}

hd_status hd_maps_test_zeros(hd_trial *t, const hd_image *start)
{
    const double units = fmin(UNITS_MOST,
                              hd_trial_time(t, UNITS_MOST, WORK / (double)t->rows) / t->unit);
    return t->rows <= EXPONENTS_MOST && units >= UNITS ? count_zeros(t, start, (int)units) : HD_OK;
}
