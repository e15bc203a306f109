/** Starts a program once more with BLAS kernels that fit the processor, and with idle threads that
 * do not spin. The node and the benchmarks do so. */
#define _POSIX_C_SOURCE 200809L /* setenv */
#include "restart.h"

#include <hdlyap/blas.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

void restart_if_slow(char **argv)
{
#if defined(__linux__)
    static const char once[] = "HDLYAP_RESTARTED";
    if (getenv(once)) return;
    const char *kernel = getenv("OPENBLAS_CORETYPE") ? NULL : hd_blas_query().better_kernel;
    const bool calmed = calm_threads();
    if (!kernel && !calmed) return;
    setenv(once, "1", 1);
    if (kernel) setenv("OPENBLAS_CORETYPE", kernel, 1);
    restart(argv);
#else
    (void)argv;
#endif
}
