/** V = Q R by each of the methods that are compared, on the frame of the library. */
#ifndef HD_BENCH_FACTOR_H
#define HD_BENCH_FACTOR_H

#include <hdlyap/frame.h>
#include "tangent/frame.h"

typedef enum factor_method {
    FACTOR_OURS,           /**< hd_ortho_step as hd_run calls it */
    FACTOR_OURS_DQ,        /**< likewise, but in the norm of dq until a window's last step */
    FACTOR_CHOLESKY,       /**< Cholesky factorisation of the Gram matrix, one pass */
    FACTOR_CHOLESKY_TWICE, /**< two such passes */
    FACTOR_MIXED,          /**< Gram matrix and triangle in single precision, vectors in double */
    FACTOR_SINGLE,         /**< all in single precision, between replays in double */
    FACTOR_HOUSEHOLDER,    /**< Householder reflections: dgeqrf, dorgqr */
    FACTOR_GRAM_SCHMIDT,   /**< modified Gram-Schmidt, vector by vector */
    FACTOR_METHODS
} factor_method;

typedef struct factor factor;

factor *factor_create(factor_method method, int rows, int vectors);
void factor_free(factor *f);

/** Replaces the frame's vectors by Q. Some methods leave Q only roughly orthonormal (ours, mixed,
 * single): if last, for the last step of a window, a pass in double precision completes their
 * logarithms [T5]. Fails with HD_ILL_CONDITIONED if the method notices that it has failed. */
HD_MUST_CHECK hd_status factor_step(factor *f, hd_frame *frame, double interval, int last);

const double *factor_log_stretch(const factor *f); /**< [n]: ln |R_ll| of the last step */
double factor_seconds(const factor *f); /**< sum over steps, without copies to and from columns */
const char *factor_name(factor_method method);

#endif
