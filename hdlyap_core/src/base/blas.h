/** What the core asks of the linear algebra underneath. */
#ifndef HD_BLAS_H
#define HD_BLAS_H

#include "hdlyap/blas.h"

/** The OPENBLAS_CORETYPE that a processor with these features wants instead of `kernel`,
 * or NULL if the kernel in use is as good as this program knows. Pure. */
const char *hd_blas_better_kernel(const char *kernel, int has_avx2_fma, int has_avx512);

/** Sets the number of threads of BLAS calls that this thread makes from now on. */
void hd_blas_use_threads(int threads);

/** Number of OpenMP threads that may call the BLAS at the same time, each for its own part of a
 * product. It is that of hd_blas_use_threads if the BLAS itself uses OpenMP (each such call then
 * has one thread), else 1. */
int hd_blas_threads_to_share(void);

/** Number of threads, at most `threads`, that OpenMP grants: OMP_THREAD_LIMIT or
 * OMP_MAX_ACTIVE_LEVELS can lower it. OpenBLAS would wait for ever for threads that are not
 * granted. */
int hd_blas_threads_granted(int threads);

#endif
