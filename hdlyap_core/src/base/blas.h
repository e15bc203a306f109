/** What the core asks of the linear algebra underneath. */
#ifndef HD_BLAS_H
#define HD_BLAS_H

#include "hdlyap/blas.h"

/** The OPENBLAS_CORETYPE that a processor with these features wants instead of `kernel`,
 * or NULL if the kernel in use is as good as this program knows. Pure. */
const char *hd_blas_better_kernel(const char *kernel, int has_avx2_fma, int has_avx512);

/** In calls from this thread from now on. */
void hd_blas_use_threads(int threads);

/** Threads of OpenMP that may call it at the same time, each for its own part of a product: those
 * of hd_blas_use_threads where it uses OpenMP, too, and then gives each call one thread; else 1. */
int hd_blas_threads_to_share(void);

/** Of so many, the threads that OpenMP grants: fewer where OMP_THREAD_LIMIT or
 * OMP_MAX_ACTIVE_LEVELS says so. OpenBLAS would wait for the others for ever. */
int hd_blas_threads_granted(int threads);

#endif
