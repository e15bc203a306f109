/** Which linear algebra library is in use, and whether it fits the processor. */
#ifndef HDLYAP_BLAS_H
#define HDLYAP_BLAS_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_blas {
    const char *library;   /**< the library as it describes itself, e.g. "OpenBLAS 0.3.21 ..." */
    const char *kernel;    /**< its kernels, e.g. "SkylakeX" */
    const char *threading; /**< how it runs threads: "serial", "pthread" or "openmp" */
    int threads;           /**< threads that it uses now */
    int cores;             /**< processors that this process may use */
} hd_blas;

hd_blas hd_blas_query(void);

/** To be called first in main. If the library uses kernels older than the processor, or idle
 * threads would spin for long, it starts the program again with OPENBLAS_CORETYPE, and with
 * GOMP_SPINCOUNT or OMP_WAIT_POLICY, set; it never changes a value that the user has set.
 * Otherwise, and after such a restart, it returns. It does something on Linux only. */
void hd_blas_restart_if_slow(char **argv);

/** HD_NO_MEMORY if there is not enough address space for the stacks and buffers of so many threads:
 * OpenBLAS would then try for ever, and OpenMP would end the process. It keeps no memory. */
HD_MUST_CHECK hd_status hd_blas_room(int threads);

HD_API_END
#endif
