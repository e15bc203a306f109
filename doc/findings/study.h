/** What the studies share: how they begin, how a run goes on, and their end where something fails.
 * Each prints its table to stdout as CSV, below a comment that names library and machine. */
#ifndef STUDY_H
#define STUDY_H

#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline void require(hd_status status, const char *what)
{
    if (status == HD_OK) return;
    fprintf(stderr, "%s: %s\n", what, hd_status_text(status));
    exit(3);
}

/** calloc that ends the program when memory is out. */
static inline void *room(size_t count, size_t size)
{
    void *block = calloc(count, size);
    if (!block) require(HD_NO_MEMORY, "study");
    return block;
}

static inline hd_run *created(const hd_scene_def *scene)
{
    char message[512] = "scene";
    hd_run *run;
    require(hd_run_create(&run, scene, message, sizeof message), message);
    return run;
}

static inline void go_on(hd_run *run, hd_stage stage)
{
    while (hd_run_stage(run) < stage) require(hd_run_advance(run), "run");
}

/** Mean over the seeds, and its error: from those stated for each, or from their scatter if that is
 * more. value[count], stated[count]. */
static inline double mean_over_seeds(const double *value, const double *stated, int count,
                                     double *error)
{
    double mean = 0.0, scatter = 0.0, square = 0.0;
    for (int s = 0; s < count; s++) mean += value[s] / count;
    for (int s = 0; s < count; s++) {
        scatter += pow(value[s] - mean, 2.0) * count / fmax(1.0, count - 1);
        square += stated[s] * stated[s];
    }
    *error = sqrt(fmax(scatter, square)) / count;
    return mean;
}

/** The command's one option, --quick. Prints the comment and the columns' names. */
static inline bool study_begin(int argc, char **argv, const char *header)
{
    const bool quick = argc == 2 && strcmp(argv[1], "--quick") == 0;
    if (argc > 1 && !quick) {
        fprintf(stderr, "%s: the only option is --quick\n", argv[0]);
        exit(2);
    }
    const hd_blas blas = hd_blas_query();
    printf("# hdlyap %s, %s kernels", HDLYAP_VERSION, blas.kernel);
    if (blas.better_kernel) printf(" (OPENBLAS_CORETYPE=%s is faster)", blas.better_kernel);
    printf("\n%s\n", header);
    fflush(stdout);
    return quick;
}

#endif
