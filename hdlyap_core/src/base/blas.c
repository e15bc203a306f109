/** Identity of the linear algebra library, and the kernels that would fit the processor. Works with
 * any BLAS: functions that only OpenBLAS has are weak symbols. */
#define _GNU_SOURCE /* flags of mmap */
#include "base/blas.h"

#include <omp.h>
#include <stdbool.h>
#include <string.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

extern char *openblas_get_config(void) __attribute__((weak));
extern char *openblas_get_corename(void) __attribute__((weak));
extern int openblas_get_parallel(void) __attribute__((weak));
extern int openblas_get_num_threads(void) __attribute__((weak));
extern void openblas_set_num_threads(int threads) __attribute__((weak));

enum { SERIAL, PTHREAD, OPENMP }; /* openblas_get_parallel */

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

static const char *better_kernel_here(const char *kernel)
{
#if defined(__x86_64__)
    const int avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                       __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    const int avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return hd_blas_better_kernel(kernel, avx2, avx512);
#else
    (void)kernel;
    return NULL;
#endif
}

hd_blas hd_blas_query(void)
{
    static const char *const threading[] = {"serial", "pthread", "openmp"};
    hd_blas blas = {"unknown BLAS", "unknown", "serial", NULL, 1, omp_get_num_procs()};
    if (openblas_get_config) blas.library = openblas_get_config();
    if (openblas_get_corename) blas.kernel = openblas_get_corename();
    blas.better_kernel = better_kernel_here(blas.kernel);
    if (openblas_get_num_threads) blas.threads = openblas_get_num_threads();
    const int kind = openblas_get_parallel ? openblas_get_parallel() : SERIAL;
    if (kind == PTHREAD || kind == OPENMP) blas.threading = threading[kind];
    return blas;
}
