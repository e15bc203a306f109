/** Repeated measurements of one quantity. On a shared machine their median is the useful number. */
#ifndef HD_BENCH_SAMPLE_H
#define HD_BENCH_SAMPLE_H

enum { SAMPLE_MAX = 1000 };

/** {0} is an empty sample. */
typedef struct sample {
    double value[SAMPLE_MAX]; /**< ascending; values after the first SAMPLE_MAX are dropped */
    int count;
} sample;

void sample_add(sample *s, double value);
double sample_least(const sample *s); /**< 0 if the sample is empty, as the next two */
double sample_median(const sample *s);
double sample_most(const sample *s);

#endif
