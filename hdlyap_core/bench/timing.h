/** Functions that all benchmark programs use: the clock, creating a run, and ending the program if
 * something failed. */
#ifndef HD_BENCH_TIMING_H
#define HD_BENCH_TIMING_H

#include <hdlyap/run.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static inline double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline void require(hd_status status, const char *what)
{
    if (status == HD_OK) return;
    fprintf(stderr, "%s: %s\n", what, hd_status_text(status));
    exit(3);
}

/** Creates a run. If the scene is refused, prints a line and ends the program with status 2. */
static inline hd_run *created(const hd_scene_def *scene)
{
    char message[512] = "out of memory";
    hd_run *run;
    if (hd_run_create(&run, scene, message, sizeof message) == HD_OK) return run;
    fprintf(stderr, "%s\n", message);
    exit(2);
}

/** calloc that ends the program if there is no memory. */
static inline void *room(size_t count, size_t size)
{
    void *block = calloc(count, size);
    if (!block) require(HD_NO_MEMORY, "benchmark");
    return block;
}

#endif
