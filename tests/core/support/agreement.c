/** Numbers of many seeds -> scatter against stated errors. */
#include "agreement.h"

#include <math.h>
#include <string.h>

#include "sample.h"
#include "testing.h"

/** Of one number: the seeds that state an error. */
typedef struct column {
    const number **seed; /**< [stated] */
    int taken, stated;
    double all;                  /**< mean of all that are taken */
    double mean, square, errors; /**< of those stated: mean, variance, mean square error */
} column;

/** What most seeds found it from; 0 if it was never published. */
static uint64_t most_common(const number *numbers, int seeds, int stride)
{
    uint64_t best = 0;
    int most = 0;
    for (int s = 0; s < seeds; s++) {
        const uint64_t of = numbers[s * stride].of;
        int count = 0;
        for (int k = 0; of != 0 && k < seeds; k++) count += numbers[k * stride].of == of;
        if (count > most) most = count, best = of;
    }
    return best;
}

static column column_of(const number *numbers, int seeds, int stride, uint64_t of)
{
    /* unsigned: GCC 10 takes what is negative for possible, and warns */
    column c = {.seed = calloc((unsigned)seeds, sizeof *c.seed)};
    assert_non_null(c.seed);
    for (int s = 0; s < seeds; s++) {
        const number *n = &numbers[s * stride];
        if (of == 0 || n->of != of) continue;
        c.all += (n->value - c.all) / ++c.taken;
        if (!(n->error >= 0)) continue;
        c.seed[c.stated++] = n;
        const double off = n->value - c.mean;
        c.mean += off / c.stated;
        c.square += off * (n->value - c.mean);
        c.errors += n->error * n->error;
    }
    if (c.stated > 1) c.square /= c.stated - 1;
    if (c.stated > 0) c.errors /= c.stated;
    return c;
}

/** The mean of S seeds lies nearer to each of them than the truth does, by sqrt(1 - 1/S). */
static int count_within(const column *c, double errors)
{
    const double nearer = errors * sqrt(1.0 - 1.0 / c->stated);
    int count = 0;
    for (int s = 0; s < c->stated; s++)
        count += fabs(c->seed[s]->value - c->mean) <= nearer * c->seed[s]->error;
    return count;
}

typedef struct rest {
    sample ratio, taken, stated;
    double within[2], numbers;
} rest;

static void column_add(rest *r, const column *c)
{
    if (c->taken == 0) return; /* not of this scene */
    sample_add(&r->taken, c->taken);
    sample_add(&r->stated, c->stated);
    if (c->stated < AGREEMENT_LEAST) return;
    sample_add(&r->ratio, sqrt(c->square / c->errors));
    for (int k = 0; k < 2; k++) r->within[k] += count_within(c, 1.0 + k);
    r->numbers += c->stated;
}

static agreement sum_up(const rest *r, const agreement *first)
{
    agreement a = *first;
    a.taken = (int)sample_median(&r->taken);
    a.stated = (int)sample_median(&r->stated);
    a.ratio = a.within[0] = a.within[1] = -1.0;
    if (r->numbers == 0) return a;
    a.ratio = sample_median(&r->ratio);
    for (int k = 0; k < 2; k++) a.within[k] = r->within[k] / r->numbers;
    return a;
}

agreement agreement_of(const number *numbers, int seeds, int stride, int first, int count)
{
    HEAP rest *r = calloc(1, sizeof *r);
    assert_non_null(r);
    agreement one = {0};
    for (int k = first; k < first + count; k++) {
        const uint64_t of = most_common(numbers + k, seeds, stride);
        column c = column_of(numbers + k, seeds, stride, of);
        if (k == first)
            one = (agreement){
                .of = of, .mean = c.all, .error = c.stated > 0 ? sqrt(c.errors) : -1.0};
        column_add(r, &c);
        free(c.seed);
    }
    return sum_up(r, &one);
}

/** Three standard errors of a part of so many. */
static double three(double part, int seeds) { return 3.0 * sqrt(part * (1.0 - part) / seeds); }

bool agreement_holds(const agreement *a, int seeds)
{
    static const double normal[2] = {0.683, 0.954}, student[2] = {0.663, 0.931};
    for (int k = 0; k < 2; k++)
        if (!(a->within[k] >= student[k] - three(student[k], seeds) &&
              a->within[k] <= normal[k] + three(normal[k], seeds)))
            return false;
    return a->ratio >= 0.8 && a->ratio <= 1.25;
}
