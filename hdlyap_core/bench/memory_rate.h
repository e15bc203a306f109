/** Memory's speed, for what it bounds. */
#ifndef BENCH_MEMORY_RATE_H
#define BENCH_MEMORY_RATE_H

/** Bytes per second, read and written, of copying a block far larger than the caches; the best of a
 * few. One thread. */
double memory_rate(void);

#endif
