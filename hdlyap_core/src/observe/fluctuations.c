/** Samples of the spectrum -> fluctuations of growth over stretches of time [T25], and their limits
 * for long stretches: diffusion of exponents, and of pairs of exponents. */
#include "hdlyap/fluctuations.h"

#include <math.h>

#include "averages/blocks.h"
#include "averages/doubling.h"
#include "averages/spectrum.h"
#include "base/check.h"
#include "base/memory.h"
#include "observe/observable.h"
#include "scene/scene.h"

/** Stretches of one length count for a limit once so many of them have passed. */
enum { COUNT_MIN = 32 };
/** For errors of estimates from K stretches of one length [T25]: variances, in units of noise^2 /
 * K, of the limit (LIMIT), and of its difference from that of stretches twice as long (DIFFERENCE).
 */
static const double LIMIT = 10.0, DIFFERENCE = 18.0;

struct hd_fluctuations {
    hd_doubling *doubling;
    int vectors;
    double block; /**< shortest block of the averages, beyond which growth has no memory; a stretch
                     may be as little shorter as a block [time units] */
    /** At the last sample: [vectors], ln R_ii summed by the spectrum; averaged time. */
    double *sum, now;
    double *grown; /**< [vectors]: growth from the last sample to this one */
    bool follows;  /**< true if the next sample follows the last one without a gap */
};

int hd_fluctuations_times(const hd_fluctuations *f) { return hd_doubling_times(f->doubling); }
hd_order_over hd_fluctuations_order(const hd_fluctuations *f, int k)
{
    return hd_doubling_order(f->doubling, k);
}
double hd_fluctuations_variance(const hd_fluctuations *f, int k, int col)
{
    return hd_doubling_variance(f->doubling, k, col);
}

/* ---- limits of long times ------------------------------------------------------------------- */

/** For each length of which enough stretches have passed: a variance or covariance of growth per
 * time, and its noise. With K stretches this estimate has the variance 2 noise^2 / K. */
typedef struct course {
    int times;
    double value[HD_TIMES_MAX], noise[HD_TIMES_MAX];
} course;

/** Number of lengths of which enough stretches have passed. */
static int times_of(const hd_fluctuations *f)
{
    int times = hd_fluctuations_times(f);
    while (times > 0 && hd_fluctuations_order(f, times - 1).count < COUNT_MIN) times--;
    return times;
}

/** 2 v(2t) - v(t), with v the value for length t: what a bounded part of the growth adds, c / t,
 * cancels. */
static double slope(const course *c, int k) { return 2.0 * c->value[k + 1] - c->value[k]; }

/** The slope at the shortest length that agrees with the slope at twice this length within its
 * error; at the last length, within twice its error. */
static hd_diffusion limit_of(const hd_fluctuations *f, const course *c)
{
    for (int k = 0; k + 2 < c->times; k++) {
        const hd_order_over passed = hd_fluctuations_order(f, k);
        const double off = slope(c, k + 1) - slope(c, k);
        const double one = c->noise[k + 1] / sqrt((double)passed.count);
        if (passed.time < HD_BLOCKS_NEARLY * f->block) continue;
        const double allowed = (k + 3 < c->times ? 1.0 : 2.0) * sqrt(DIFFERENCE) * one;
        if (!(fabs(off) <= allowed)) continue;
        return (hd_diffusion){slope(c, k), hypot(sqrt(LIMIT) * one, 0.5 * off)};
    }
    return (hd_diffusion){0.0, -1.0};
}

hd_diffusion hd_fluctuations_diffusion(const hd_fluctuations *f, int col)
{
    course c = {.times = times_of(f)};
    HD_ASSERT(col >= 0 && col < f->vectors);
    for (int k = 0; k < c.times; k++) c.value[k] = c.noise[k] = hd_fluctuations_variance(f, k, col);
    return limit_of(f, &c);
}

/* ---- steps ---------------------------------------------------------------------------------- */

/** Finds the columns whose pairs are compared: the last ones with positive exponents. */
static void paired(const hd_scene_def *scene, int *first, int *count)
{
    const int positive = hd_scene_positive_exponents(scene), n = hd_scene_vectors(scene);
    const int end = positive < n ? positive : n;
    *first = end > HD_FLUCTUATING ? end - HD_FLUCTUATING : 0;
    *count = end - *first;
}

/** The place of a step in `of`, which is added if it is not there. */
static int place_of(hd_step_columns *of, int step)
{
    for (int k = 0; k < of->count; k++)
        if (of->step[k] == step) return k;
    of->step[of->count] = step;
    return of->count++;
}

hd_step_columns hd_fluctuations_steps(const hd_fluctuations *f, const hd_steps *steps)
{
    hd_step_columns of = {.count = 0};
    const hd_doubling_def *pairs = hd_doubling_of(f->doubling);
    for (int col = pairs->first; col < pairs->first + pairs->count; col++) {
        const int step = hd_steps_of_vector(steps, col);
        if (step < 0 || hd_steps_step(steps, step)->kind == HD_MODE_ZERO) continue;
        const int k = place_of(&of, step);
        of.own[k][of.columns[k]++] = col;
    }
    return of;
}

/** Mean covariance, over stretches of length k, of a column of step a and a column of step b;
 * differ: only of two different columns. */
static double mean_covariance(const hd_fluctuations *f, int k, const hd_step_columns *of, int a,
                              int b, bool differ)
{
    double sum = 0.0;
    int pairs = 0;
    for (int i = 0; i < of->columns[a]; i++) {
        for (int j = 0; j < of->columns[b]; j++) {
            if (differ && i == j) continue;
            sum += hd_doubling_covariance(f->doubling, k, of->own[a][i], of->own[b][j]);
            pairs++;
        }
    }
    return sum / pairs;
}

/** Noise of such a mean covariance, whose value is given. Within a step all columns are taken as
 * alike, so that their mean fluctuates independently of their differences. */
static double noise_of(const hd_fluctuations *f, int k, const hd_step_columns *of, int a, int b,
                       double value)
{
    const double own = mean_covariance(f, k, of, a, a, false), m = of->columns[a];
    if (a == b) {
        const double together = m * own, apart = (m * own - m * value);
        return sqrt(together * together + apart * apart / (m - 1.0)) / m;
    }
    return sqrt(0.5 * (own * mean_covariance(f, k, of, b, b, false) + value * value));
}

hd_diffusion hd_fluctuations_covariance(const hd_fluctuations *f, const hd_step_columns *of, int a,
                                        int b)
{
    course c = {.times = times_of(f)};
    if (a == b && of->columns[a] < 2) return (hd_diffusion){0.0, -1.0};
    for (int k = 0; k < c.times; k++) {
        c.value[k] = mean_covariance(f, k, of, a, b, a == b);
        c.noise[k] = noise_of(f, k, of, a, b, c.value[k]);
    }
    return limit_of(f, &c);
}

double hd_fluctuations_reversed(const hd_fluctuations *f, int k, const hd_step_columns *of, int a,
                                int b)
{
    double sum = 0.0;
    int pairs = 0;
    for (int i = 0; i < of->columns[a]; i++) {
        for (int j = a == b ? i + 1 : 0; j < of->columns[b]; j++) {
            const int x = of->own[a][i], y = of->own[b][j];
            sum += hd_doubling_reversed(f->doubling, k, x < y ? x : y, x < y ? y : x);
            pairs++;
        }
    }
    return pairs > 0 ? sum / pairs : NAN;
}

/* ---- as an observable ----------------------------------------------------------------------- */

static hd_doubling_def doubling_of(const hd_scene_def *scene)
{
    hd_doubling_def def = {.vectors = hd_scene_vectors(scene), .shortest = scene->fluctuation_time};
    paired(scene, &def.first, &def.count);
    return def;
}

static double fluctuations_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(hd_fluctuations) + 2.0 * sizeof(double) * hd_scene_vectors(scene) +
           hd_doubling_bytes(doubling_of(scene));
}

/** Number of lengths of which at least two stretches have passed, as a mean over the run; all
 * lengths if the duration is open. */
static double mean_times(const hd_scene_def *scene, const hd_fluctuations *f)
{
    double sum = 0.0;
    if (!f || hd_fluctuations_times(f) == 0 || !(scene->duration > 0)) return HD_TIMES_MAX;
    double part = 2.0 * hd_fluctuations_order(f, 0).time / scene->duration;
    for (int k = 0; k < HD_TIMES_MAX && part < 1.0; k++, part *= 2.0) sum += 1.0 - part;
    return sum;
}

static void fluctuations_extend(hd_result_counts *extent, const hd_scene_def *scene,
                                const void *self)
{
    extent->times = (int)lround(mean_times(scene, self)); /* a trial ends by the clock */
}

static hd_status fluctuations_check(const hd_scene_def *scene, char *message, size_t size)
{
    const double time = scene->fluctuation_time;
    if (!(scene->duration > 0) || time <= scene->duration) return HD_OK;
    return hd_refuse(message, size, "fluctuation_time = %.15g: must be at most duration = %.15g",
                     time, scene->duration);
}

static hd_status prepare(hd_fluctuations *f, const hd_observing *with)
{
    f->vectors = with->vectors;
    f->block = with->block;
    f->sum = hd_memory_alloc((size_t)with->vectors, sizeof *f->sum);
    f->grown = hd_memory_alloc((size_t)with->vectors, sizeof *f->grown);
    if (!f->sum || !f->grown) return HD_NO_MEMORY;
    hd_doubling_def def = doubling_of(with->scene);
    if (def.shortest == 0) def.shortest = with->sample; /* those of a young run are summed up */
    return hd_doubling_create(&f->doubling, def);
}

static void *fluctuations_create(const hd_observing *with, hd_status *status)
{
    hd_fluctuations *f = hd_memory_alloc(1, sizeof *f);
    *status = f ? prepare(f, with) : HD_NO_MEMORY;
    return f;
}

static void fluctuations_free(void *self)
{
    hd_fluctuations *f = self;
    hd_doubling_free(f->doubling);
    hd_memory_free(f->sum);
    hd_memory_free(f->grown);
    hd_memory_free(f);
}

static void fluctuations_clear(void *self, const hd_moment *now)
{
    hd_fluctuations *f = self;
    (void)now;
    hd_doubling_clear(f->doubling);
    for (int col = 0; col < f->vectors; col++) f->sum[col] = 0.0;
    f->now = 0.0;
    f->follows = true; /* the spectrum begins here, too */
}

static void fluctuations_resume(void *self, const hd_moment *now)
{
    hd_fluctuations *f = self;
    (void)now;
    hd_doubling_break(f->doubling);
    f->follows = false;
}

static void fluctuations_add(void *self, const hd_moment *now)
{
    hd_fluctuations *f = self;
    const double *sum = hd_spectrum_total(now->spectrum), time = hd_spectrum_time(now->spectrum);
    for (int col = 0; col < f->vectors; col++) {
        f->grown[col] = sum[col] - f->sum[col];
        f->sum[col] = sum[col];
    }
    if (f->follows && time > f->now) hd_doubling_add(f->doubling, f->grown, time - f->now);
    f->now = time;
    f->follows = true;
}

static double fluctuations_apart(const hd_scene_def *scene)
{
    return scene->fluctuation_time > 0 ? scene->fluctuation_time : INFINITY;
}

static double fluctuations_sampling(void *self, const hd_moment *now)
{
    (void)self;
    return fluctuations_apart(now->with->scene);
}

static void fluctuations_archive(void *self, const hd_moment *now)
{
    hd_fluctuations *f = self;
    hd_archive *archive = now->archive;
    int follows = f->follows;
    hd_archive_int(archive, "fluctuations follow", &follows, 0, 1);
    f->follows = follows;
    hd_archive_double(archive, "fluctuations time", &f->now);
    hd_archive_doubles(archive, "fluctuations sum", f->sum, (size_t)f->vectors);
    hd_doubling_archive(f->doubling, archive);
}

const hd_observable hd_fluctuations_row = {.needs = HD_NEEDS_FRAME | HD_NEEDS_CLOSE,
                                           .bytes = fluctuations_bytes,
                                           .extend = fluctuations_extend,
                                           .check = fluctuations_check,
                                           .create = fluctuations_create,
                                           .free = fluctuations_free,
                                           .clear = fluctuations_clear,
                                           .resume = fluctuations_resume,
                                           .add = fluctuations_add,
                                           .apart = fluctuations_apart,
                                           .sampling = fluctuations_sampling,
                                           .archive = fluctuations_archive};
