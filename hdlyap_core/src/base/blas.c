/** Identity of the linear algebra library, and the restart with kernels that fit the processor.
 * Works with any BLAS: functions that only OpenBLAS has are weak symbols. */
#define _GNU_SOURCE /* sched_getaffinity */
#include "base/blas.h"

#include <limits.h>
#include <omp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

extern char *openblas_get_config(void) __attribute__((weak));
extern char *openblas_get_corename(void) __attribute__((weak));
extern int openblas_get_parallel(void) __attribute__((weak));
extern int openblas_get_num_threads(void) __attribute__((weak));
extern void openblas_set_num_threads(int threads) __attribute__((weak));

enum { SERIAL, PTHREAD, OPENMP }; /* openblas_get_parallel */

hd_blas hd_blas_query(void)
{
    static const char *const threading[] = {"serial", "pthread", "openmp"};
    hd_blas blas = {"unknown BLAS", "unknown", "serial", 1, omp_get_num_procs()};
    if (openblas_get_config) blas.library = openblas_get_config();
    if (openblas_get_corename) blas.kernel = openblas_get_corename();
    if (openblas_get_num_threads) blas.threads = openblas_get_num_threads();
    const int kind = openblas_get_parallel ? openblas_get_parallel() : SERIAL;
    if (kind == PTHREAD || kind == OPENMP) blas.threading = threading[kind];
    return blas;
}

static bool uses_openmp(void) { return openblas_get_parallel && openblas_get_parallel() == OPENMP; }

/** OMP_DYNAMIC would let OpenMP grant fewer threads now and then. OpenBLAS 0.3.29 takes OpenMP's
 * number at the next call, and forgets what it was told. */
void hd_blas_use_threads(int threads)
{
    omp_set_dynamic(0);
    if (openblas_set_num_threads) openblas_set_num_threads(threads);
    if (uses_openmp()) omp_set_num_threads(threads);
}

int hd_blas_threads_to_share(void) { return uses_openmp() ? omp_get_max_threads() : 1; }

/** Reads OpenMP's limits. Starting threads as a trial would take the memory of the real ones. */
int hd_blas_threads_granted(int threads)
{
    omp_set_dynamic(0);
    const int limit = omp_get_max_active_levels() > 0 ? omp_get_thread_limit() : 1;
    return threads < limit ? threads : limit;
}

hd_status hd_blas_room(int threads)
{
#if defined(__linux__)
    const size_t buffer = (size_t)128 << 20; /* the largest of any version */
    /* stacks and malloc's arenas of two pools of threads, the caller's and the run's */
    const size_t stacks = (size_t)96 << 20;
    /* for the caller's other threads that have not started, as roscpp's; 2 to 8 threads took up to
     * 34 MiB of it. OpenBLAS before 0.3.30 retries for ever if there is no room for its buffer. */
    const size_t others = (size_t)160 << 20;
    const size_t bytes = (size_t)threads * (buffer + stacks) + others;
    void *room = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return HD_NO_MEMORY;
    (void)munmap(room, bytes);
#else
    (void)threads;
#endif
    return HD_OK;
}

static bool is_one_of(const char *name, const char *const *list)
{
    for (; *list; list++)
        if (strcmp(name, *list) == 0) return true;
    return false;
}

const char *hd_blas_better_kernel(const char *kernel, int has_avx2_fma, int has_avx512)
{
    static const char *const avx512[] = {"SkylakeX", "Cooperlake", "SapphireRapids", NULL};
    static const char *const avx2[] = {"Haswell", "Zen", "Excavator", NULL};
    if (strcmp(kernel, "unknown") == 0) return NULL; /* not OpenBLAS, or not one that chooses */
    if (has_avx512) return is_one_of(kernel, avx512) ? NULL : "SkylakeX";
    if (has_avx2_fma)
        return is_one_of(kernel, avx2) || is_one_of(kernel, avx512) ? NULL : "Haswell";
    return NULL;
}

static const char *better_kernel_here(void)
{
#if defined(__x86_64__)
    const int avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                       __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    const int avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return hd_blas_better_kernel(hd_blas_query().kernel, avx2, avx512);
#else
    return NULL;
#endif
}

/** Sets how idle threads wait, unless the user did. On a busy machine spinning threads take time
 * slices from working ones: a factorisation took up to thirty times longer. With two pools
 * (OpenBLAS's pthreads and OpenMP's) threads must not spin at all; those of one pool may spin for
 * some microseconds. Returns false if nothing was set. */
static bool calm_threads(void)
{
    const char *threading = hd_blas_query().threading;
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return false;
    if (strcmp(threading, "pthread") == 0) return setenv("OMP_WAIT_POLICY", "passive", 1) == 0;
    return setenv("GOMP_SPINCOUNT", "2000", 1) == 0;
}

#if defined(__linux__)
/** Executes the program again by its path, because ps and killall show the last part of it; by
 * /proc/self/exe if that path is no longer there. */
static void restart(char **argv)
{
    static const char self[] = "/proc/self/exe";
    char path[PATH_MAX] = "";
    if (readlink(self, path, sizeof path - 1) > 0) execv(path, argv);
    execv(self, argv);
    perror("hdlyap: could not restart with faster BLAS kernels"); /* go on with the slow ones */
}
#endif

void hd_blas_restart_if_slow(char **argv)
{
#if defined(__linux__)
    static const char once[] = "HDLYAP_RESTARTED";
    if (getenv(once)) return;
    const char *kernel = getenv("OPENBLAS_CORETYPE") ? NULL : better_kernel_here();
    const bool calmed = calm_threads();
    if (!kernel && !calmed) return;
    setenv(once, "1", 1);
    if (kernel) setenv("OPENBLAS_CORETYPE", kernel, 1);
    restart(argv);
#else
    (void)argv;
#endif
}
