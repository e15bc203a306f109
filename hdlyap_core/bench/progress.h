/** How far a benchmark has come and how long it still takes, on stderr. */
#ifndef HD_BENCH_PROGRESS_H
#define HD_BENCH_PROGRESS_H

/** Work in any unit that is proportional to time. */
typedef struct progress {
    const char *what;
    double total, done;
    double start; /**< wall clock [s] */
    int shown;    /**< tenths told of */
} progress;

progress progress_begin(const char *what, double total);
void progress_add(progress *p, double work);
void progress_end(void);

#endif
