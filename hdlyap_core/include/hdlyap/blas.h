/** Which linear algebra runs underneath, and whether it fits the processor. */
#ifndef HDLYAP_BLAS_H
#define HDLYAP_BLAS_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_blas {
    const char *library;   /**< as it describes itself, e.g. "OpenBLAS 0.3.21 ..." */
    const char *kernel;    /**< e.g. "SkylakeX" */
    const char *threading; /**< "serial", "pthread" or "openmp" */
    int threads;           /**< in use by it now */
    int cores;             /**< processors this process may run on */
} hd_blas;

hd_blas hd_blas_query(void);

/** The OPENBLAS_CORETYPE that a processor with these features wants instead of `kernel`,
 * or NULL if the kernel in use is as good as this program knows. Pure. */
const char *hd_blas_better_kernel(const char *kernel, int has_avx2_fma, int has_avx512);

/** Call first in main: where the library fell back to kernels older than the processor, or idle
 * threads would spin for long, starts this program once more with OPENBLAS_CORETYPE, and
 * GOMP_SPINCOUNT or OMP_WAIT_POLICY, set. A value that the user has set is never changed. Returns
 * when nothing is to be done, or after a restart. Linux; elsewhere it does nothing. */
void hd_blas_restart_if_slow(char **argv);

/** In calls from this thread from now on. */
void hd_blas_use_threads(int threads);

/** Threads of OpenMP that may call it at the same time, each for its own part of a product: those
 * of hd_blas_use_threads where it uses OpenMP, too, and then gives each call one thread; else 1. */
int hd_blas_threads_to_share(void);

/** Of so many, the threads that OpenMP grants: fewer where OMP_THREAD_LIMIT or
 * OMP_MAX_ACTIVE_LEVELS says so. OpenBLAS would wait for the others for ever. */
int hd_blas_threads_granted(int threads);

/** HD_NO_MEMORY where so many threads would not find the address space for their stacks and
 * buffers: OpenBLAS would ask for it for ever, and OpenMP would end the process. Takes none. */
HD_MUST_CHECK hd_status hd_blas_room(int threads);

HD_API_END
#endif
