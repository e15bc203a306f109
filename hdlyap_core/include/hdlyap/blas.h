/** Which BLAS library, for linear algebra, the process uses, and whether it fits the processor. */
#ifndef HDLYAP_BLAS_H
#define HDLYAP_BLAS_H

#include "hdlyap/status.h"

HD_API_BEGIN

/** The BLAS library in use. The texts last as long as the process. */
typedef struct hd_blas {
    const char *library;   /**< the library as it describes itself, e.g. "OpenBLAS 0.3.21 ..." */
    const char *kernel;    /**< the processor for which its routines are made, e.g. "SkylakeX";
                              "unknown" if the library does not say */
    const char *threading; /**< how it runs threads: "serial", "pthread" or "openmp" */
    /** OPENBLAS_CORETYPE with which the process should have been started, because `kernel` is for
     * an older processor than this one; NULL if it is as good as hdlyap knows */
    const char *better_kernel;
    int threads; /**< number of threads that it uses now */
    int cores;   /**< number of processors that this process may use */
} hd_blas;

/** Asks the library. Any thread may call it. */
hd_blas hd_blas_query(void);

/** Returns HD_OK if there is enough address space for the stacks and buffers of so many threads,
 * otherwise HD_NO_MEMORY. Without that space OpenBLAS would try for ever, and OpenMP would end the
 * process. The call itself keeps no memory. On systems other than Linux it always returns HD_OK. */
HD_MUST_CHECK hd_status hd_blas_room(int threads);

HD_API_END
#endif
