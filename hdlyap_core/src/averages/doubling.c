/** Growth of vectors in samples -> its sums over stretches of time, of lengths that double [T25]. A
 * stretch of the first length is one or several samples; two stretches of one length make one of
 * the next. */
#include "averages/doubling.h"

#include <limits.h>
#include <math.h>

#include "base/check.h"
#include "base/memory.h"

/** All stretches of one length. */
typedef struct kind {
    /** Number of stretches that have passed. */
    long count;
    int parts; /**< in the stretch that has begun: number of samples, or of stretches of the length
                  before */
    double time;    /**< sum of the lengths of all stretches that have passed [time units] */
    double begun;   /**< length so far of the stretch that has begun [time units] */
    double *grown;  /**< [vectors]: growth over the stretch that has begun */
    double *sum;    /**< [vectors]: growth, summed over all stretches that have passed */
    double *square; /**< [vectors]: growth^2 / length, summed over them */
    double *violated, *entangled; /**< [vectors]: as members of hd_order_over */
    /** [count][count], for each pair of compared columns. Element (i, j), j >= i: for covariances,
     * growth of i times growth of j / length, summed over all stretches. Element (j, i), j > i: for
     * their order, the number of stretches in which j, the later column, grew more than i. */
    double *pair;
} kind;

struct hd_doubling {
    hd_doubling_def of;
    double *later; /**< workspace, [vectors]: largest growth of a vector and those after it */
    kind kinds[HD_TIMES_MAX];
};

enum { ARRAYS = 5 }; /* arrays of a kind, each [vectors] */

static size_t pairs(const hd_doubling *d) { return (size_t)d->of.count * (size_t)d->of.count; }

double hd_doubling_bytes(hd_doubling_def def)
{
    const double each = ARRAYS * (double)def.vectors + (double)def.count * def.count;
    return sizeof(hd_doubling) + sizeof(double) * (HD_TIMES_MAX * each + def.vectors);
}

static hd_status allocate(hd_doubling *d)
{
    const size_t n = (size_t)d->of.vectors;
    d->later = hd_memory_alloc(n, sizeof *d->later);
    if (!d->later) return HD_NO_MEMORY;
    for (kind *k = d->kinds; k < d->kinds + HD_TIMES_MAX; k++) {
        double **array[ARRAYS] = {&k->grown, &k->sum, &k->square, &k->violated, &k->entangled};
        for (int a = 0; a < ARRAYS; a++)
            if (!(*array[a] = hd_memory_alloc(n, sizeof(double)))) return HD_NO_MEMORY;
        if (pairs(d) > 0 && !(k->pair = hd_memory_alloc(pairs(d), sizeof(double))))
            return HD_NO_MEMORY;
    }
    return HD_OK;
}

hd_status hd_doubling_create(hd_doubling **out, hd_doubling_def def)
{
    HD_ASSERT(def.vectors >= 1 && def.first >= 0 && def.count >= 0 && def.shortest >= 0);
    HD_ASSERT(def.first + def.count <= def.vectors);
    hd_doubling *d = hd_memory_alloc(1, sizeof *d);
    *out = NULL;
    if (!d) return HD_NO_MEMORY;
    d->of = def;
    const hd_status status = allocate(d);
    if (status == HD_OK) {
        hd_doubling_clear(d);
        *out = d;
    } else {
        hd_doubling_free(d);
    }
    return status;
}

void hd_doubling_free(hd_doubling *d)
{
    if (!d) return;
    for (kind *k = d->kinds; k < d->kinds + HD_TIMES_MAX; k++) {
        double *array[] = {k->grown, k->sum, k->square, k->violated, k->entangled, k->pair};
        for (size_t a = 0; a < sizeof array / sizeof *array; a++) hd_memory_free(array[a]);
    }
    hd_memory_free(d->later);
    hd_memory_free(d);
}

static void begin(const hd_doubling *d, kind *k)
{
    k->parts = 0;
    k->begun = 0.0;
    for (int col = 0; col < d->of.vectors; col++) k->grown[col] = 0.0;
}

void hd_doubling_break(hd_doubling *d)
{
    for (kind *k = d->kinds; k < d->kinds + HD_TIMES_MAX; k++) begin(d, k);
}

void hd_doubling_clear(hd_doubling *d)
{
    hd_doubling_break(d);
    for (kind *k = d->kinds; k < d->kinds + HD_TIMES_MAX; k++) {
        k->count = 0;
        k->time = 0.0;
        for (int col = 0; col < d->of.vectors; col++)
            k->sum[col] = k->square[col] = k->violated[col] = k->entangled[col] = 0.0;
        for (size_t p = 0; p < pairs(d); p++) k->pair[p] = 0.0;
    }
}

/* ---- a time has passed ---------------------------------------------------------------------- */

static void add_squares(const hd_doubling *d, kind *k)
{
    for (int col = 0; col < d->of.vectors; col++) {
        k->sum[col] += k->grown[col];
        k->square[col] += k->grown[col] * k->grown[col] / k->begun;
    }
}

static void add_order(const hd_doubling *d, kind *k)
{
    const int last = d->of.vectors - 1;
    const double *grown = k->grown, number = (double)k->count;
    double before = INFINITY;
    d->later[last] = grown[last];
    for (int col = last - 1; col >= 0; col--) d->later[col] = fmax(d->later[col + 1], grown[col]);
    for (int col = 0; col < last; col++) {
        before = fmin(before, grown[col]);
        const double violated = grown[col] < grown[col + 1], entangled = before < d->later[col + 1];
        k->violated[col] += (violated - k->violated[col]) / number;
        k->entangled[col] += (entangled - k->entangled[col]) / number;
    }
}

static void add_pairs(const hd_doubling *d, kind *k)
{
    const int m = d->of.count;
    const double *grown = k->grown + d->of.first;
    for (int a = 0; a < m; a++) {
        double *row = k->pair + (size_t)a * (size_t)m;
        for (int b = 0; b < a; b++) row[b] += grown[b] < grown[a];
        for (int b = a; b < m; b++) row[b] += grown[a] * grown[b] / k->begun;
    }
}

static void take(const hd_doubling *d, kind *k, const double *growth, double dt)
{
    for (int col = 0; col < d->of.vectors; col++) k->grown[col] += growth[col];
    k->begun += dt;
    k->parts++;
}

void hd_doubling_add(hd_doubling *d, const double *growth, double dt)
{
    kind *k = d->kinds;
    HD_ASSERT(dt > 0);
    take(d, k, growth, dt);
    bool passed = k->begun >= d->of.shortest - 0.5 * dt;
    for (; passed; k++) {
        k->count++;
        k->time += k->begun;
        add_squares(d, k);
        add_order(d, k);
        add_pairs(d, k);
        passed = k + 1 < d->kinds + HD_TIMES_MAX;
        if (passed) {
            take(d, k + 1, k->grown, k->begun);
            passed = k[1].parts == 2;
        }
        begin(d, k);
    }
}

const hd_doubling_def *hd_doubling_of(const hd_doubling *d) { return &d->of; }

/* ---- results -------------------------------------------------------------------------------- */

int hd_doubling_times(const hd_doubling *d)
{
    int times = 0;
    while (times < HD_TIMES_MAX && d->kinds[times].count > 0) times++;
    return times;
}

hd_order_over hd_doubling_order(const hd_doubling *d, int k)
{
    const kind *of = &d->kinds[k];
    return (hd_order_over){.time = of->time / (double)of->count,
                           .count = of->count,
                           .violations = of->violated,
                           .domination_violations = of->entangled};
}

/** Covariance of growth, divided by the length of a stretch, from the sum of products / length and
 * the two sums of growth; NaN with a single stretch. */
static double per_time(const kind *k, double products, double sum, double other)
{
    return k->count > 1 ? (products - sum * other / k->time) / (double)(k->count - 1) : NAN;
}

double hd_doubling_variance(const hd_doubling *d, int k, int col)
{
    const kind *of = &d->kinds[k];
    return per_time(of, of->square[col], of->sum[col], of->sum[col]);
}

static double pair_of(const hd_doubling *d, int k, int row, int col)
{
    const int a = row - d->of.first, b = col - d->of.first;
    HD_ASSERT(a >= 0 && b >= 0 && a < d->of.count && b < d->of.count);
    return d->kinds[k].pair[(size_t)a * (size_t)d->of.count + (size_t)b];
}

double hd_doubling_covariance(const hd_doubling *d, int k, int col, int other)
{
    const kind *of = &d->kinds[k];
    const double products = col < other ? pair_of(d, k, col, other) : pair_of(d, k, other, col);
    return per_time(of, products, of->sum[col], of->sum[other]);
}

double hd_doubling_reversed(const hd_doubling *d, int k, int col, int later)
{
    HD_ASSERT(col < later);
    return pair_of(d, k, later, col) / (double)d->kinds[k].count;
}

/* ---- file ----------------------------------------------------------------------------------- */

static void kind_archive(const hd_doubling *d, kind *k, hd_archive *archive)
{
    const size_t n = (size_t)d->of.vectors;
    hd_archive_long(archive, "times count", &k->count, 0, LONG_MAX / 2);
    hd_archive_int(archive, "times parts", &k->parts, 0, INT_MAX);
    hd_archive_double(archive, "times passed", &k->time);
    hd_archive_double(archive, "times begun", &k->begun);
    hd_archive_doubles(archive, "times grown", k->grown, n);
    if (k->count == 0) return;
    hd_archive_doubles(archive, "times sum", k->sum, n);
    hd_archive_doubles(archive, "times square", k->square, n);
    hd_archive_doubles(archive, "times violated", k->violated, n);
    hd_archive_doubles(archive, "times entangled", k->entangled, n);
    if (pairs(d) > 0) hd_archive_doubles(archive, "times pairs", k->pair, pairs(d));
}

void hd_doubling_archive(hd_doubling *d, hd_archive *archive)
{
    hd_archive_double(archive, "times shortest", &d->of.shortest);
    hd_archive_expect(archive, d->of.shortest >= 0, "times shortest", "it is negative");
    for (kind *k = d->kinds; hd_archive_good(archive) && k < d->kinds + HD_TIMES_MAX; k++) {
        kind_archive(d, k, archive);
        hd_archive_expect(archive, k->time >= 0 && k->begun >= 0 && (k->time > 0 || k->count == 0),
                          "times passed", "it is negative, or 0 for values that were counted");
        hd_archive_expect(archive, k == d->kinds || k->parts <= 1, "times parts",
                          "there is more than one");
    }
}
