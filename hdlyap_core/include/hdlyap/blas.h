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

/** Call first in main: where the library fell back to kernels older than the processor, or idle
 * threads would spin for long, starts this program once more with OPENBLAS_CORETYPE, and
 * GOMP_SPINCOUNT or OMP_WAIT_POLICY, set. A value that the user has set is never changed. Returns
 * when nothing is to be done, or after a restart. Linux; elsewhere it does nothing. */
void hd_blas_restart_if_slow(char **argv);

/** HD_NO_MEMORY where so many threads would not find the address space for their stacks and
 * buffers: OpenBLAS would ask for it for ever, and OpenMP would end the process. Takes none. */
HD_MUST_CHECK hd_status hd_blas_room(int threads);

HD_API_END
#endif
