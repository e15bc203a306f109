/** Repeated measurements of one quantity: on a shared machine the median is what counts. */
#ifndef HD_BENCH_SAMPLE_H
#define HD_BENCH_SAMPLE_H

enum { SAMPLE_MAX = 1000 };

/** Start with {0}. */
typedef struct sample {
    double value[SAMPLE_MAX]; /**< ascending; what comes after the first SAMPLE_MAX is dropped */
    int count;
} sample;

void sample_add(sample *s, double value);
double sample_least(const sample *s); /**< this and the next two: 0 when empty */
double sample_median(const sample *s);
double sample_most(const sample *s);

#endif
