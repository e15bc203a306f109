/** V = Q R in every way that is compared, on the frame of the library. */
#ifndef HD_BENCH_FACTOR_H
#define HD_BENCH_FACTOR_H

#include <hdlyap/frame.h>
#include "tangent/frame.h"

typedef enum factor_method {
    FACTOR_OURS,           /**< hd_ortho_step as hd_run calls it */
    FACTOR_OURS_DQ,        /**< the same, before the last step of a window in the norm of dq */
    FACTOR_CHOLESKY,       /**< of the Gram matrix: one pass */
    FACTOR_CHOLESKY_TWICE, /**< two passes */
    FACTOR_MIXED,  /**< Gram matrix and triangle in single precision, multiplied onto double vectors
                    */
    FACTOR_SINGLE, /**< all of it in single precision, between replays in double */
    FACTOR_HOUSEHOLDER,  /**< reflections: dgeqrf, dorgqr */
    FACTOR_GRAM_SCHMIDT, /**< modified, vector by vector */
    FACTOR_METHODS
} factor_method;

typedef struct factor factor;

factor *factor_create(factor_method method, int rows, int vectors);
void factor_free(factor *f);

/** Replaces the frame's vectors by Q. After the last step of a window the logarithms of the methods
 * that leave Q loosely orthonormal in between (both of ours, mixed, single) are completed by a pass
 * in double precision [T5]. HD_ILL_CONDITIONED where the method notices that it cannot. */
HD_MUST_CHECK hd_status factor_step(factor *f, hd_frame *frame, double interval, int last);

const double *factor_log_stretch(const factor *f); /**< [n], of the last step */
double
factor_seconds(const factor *f); /**< in all steps; copies to and from another storage left out */
const char *factor_name(factor_method method);

#endif
