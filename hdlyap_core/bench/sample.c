/** Measurements, kept in ascending order. */
#include "sample.h"

void sample_add(sample *s, double value)
{
    if (s->count == SAMPLE_MAX) return;
    int k = s->count++;
    for (; k > 0 && s->value[k - 1] > value; k--) s->value[k] = s->value[k - 1];
    s->value[k] = value;
}

double sample_least(const sample *s) { return s->value[0]; }

double sample_median(const sample *s) { return s->value[s->count / 2]; }

double sample_most(const sample *s) { return s->value[s->count > 0 ? s->count - 1 : 0]; }
