/** Prints to stderr how far a benchmark has come and how long it will still take. */
#ifndef HD_BENCH_PROGRESS_H
#define HD_BENCH_PROGRESS_H

/** Work in any unit that is proportional to time. */
typedef struct progress {
    const char *what;
    double total, done;
    double start; /**< wall clock [s] */
    int shown;    /**< tenths of the work that were printed */
} progress;

progress progress_begin(const char *what, double total);
void progress_add(progress *p, double work);
void progress_end(void);

#endif
