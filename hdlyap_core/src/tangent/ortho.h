/** V = Q R with diag(R) > 0, by block Gram-Schmidt with Cholesky factors of its panels [T7]; the
 * condition is measured on the way [T6]. */
#ifndef HD_ORTHO_H
#define HD_ORTHO_H

#include "tangent/frame.h"

typedef struct hd_ortho hd_ortho;

/** The norm in which vectors become orthonormal: of all rows, or of dq halves alone (at most 2N
 * vectors). Sums of ln R between two states that are orthonormal in the full norm do not depend on
 * the norms in between [T5]. */
typedef enum hd_norm { HD_NORM_FULL = 0, HD_NORM_DQ } hd_norm;

/** What a step may accept. */
typedef struct hd_ortho_limits {
    double condition; /**< largest hd_ortho_condition, > 1 */
    double defect;    /**< above this predicted loss of orthogonality a second pass is made, > 0 */
    hd_norm norm;     /**< the norm of lengths, condition and defect */
} hd_ortho_limits;

HD_MUST_CHECK hd_status hd_ortho_create(hd_ortho **out, int rows, int vectors);
/** Creates one for frames that several ranks share. */
HD_MUST_CHECK hd_status hd_ortho_create_shared(hd_ortho **out, int rows, int of_particle,
                                               int vectors, hd_communicator *communicator);
void hd_ortho_free(hd_ortho *ortho);

/** Replaces the frame's vectors by Q; ln diag R is then in hd_ortho_log_stretch. Spans and the sum
 * of logarithms are right to rounding whatever the defect of Q: it cancels with the next step's
 * [T5]. Fails with HD_ILL_CONDITIONED (the frame's contents are then undefined: rewind it) if the
 * condition is above the limit, a panel's Gram matrix is not positive definite, or an entry
 * overflowed. Cost per pass: 2 m n^2 flops for m rows and n vectors, in the norm of dq 1.5 m n^2,
 * nearly all in dgemm. */
HD_MUST_CHECK hd_status hd_ortho_step(hd_ortho *ortho, hd_frame *frame, hd_ortho_limits limits);

/** hd_ortho_step in the full norm, one vector at a time and repeatedly: orthonormal to rounding,
 * several times slower. For the single event (a grazing collision) that no shorter interval can
 * tame. HD_ILL_CONDITIONED when the condition is above the limit, which may go to 1 / DBL_EPSILON,
 * or when a second pass shows that the first one has left nothing but rounding of some vector. */
HD_MUST_CHECK hd_status hd_ortho_step_stable(hd_ortho *ortho, hd_frame *frame,
                                             double condition_max);

const double *hd_ortho_log_stretch(const hd_ortho *ortho); /**< [n]: ln R_ll of the last step */

/** From now on each step keeps its R, too (16 n^2 bytes). Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_ortho_keep_factor(hd_ortho *ortho);
/** R of the last accepted step, V = Q R: [n * n] row-major, defined from the diagonal on; NULL
 * unless kept. */
const double *hd_ortho_factor(const hd_ortho *ortho);

/** max over l of sqrt(sum_k (R^-1)_kl^2 |V e_k|^2) >= 1, estimated to about a quarter: how much
 * the rounding of V (relative to its columns) is amplified in column l of Q. Rounding enters an
 * exponent as about eps * condition / interval [T6] and the orthogonality of Q in proportion to
 * eps * condition [T7]. Of the last step's first pass. */
double hd_ortho_condition(const hd_ortho *ortho);
/** Predicted |Q^T Q - 1| after the last step, in its norm [T7]. */
double hd_ortho_defect(const hd_ortho *ortho);
int hd_ortho_passes(const hd_ortho *ortho);   /**< of the last step */
hd_norm hd_ortho_norm(const hd_ortho *ortho); /**< of the last step */

/** Measured max |Q^T Q - 1| in a norm; costs a dsyrk. For tests and verification. */
double hd_ortho_defect_measured(hd_ortho *ortho, hd_frame *frame, hd_norm norm);

double hd_ortho_bytes(double rows, double vectors, double ranks);

/* ---- for panel.c, which orthonormalises a panel -------------------------------------------- */

/** |Q^T Q - 1| after one pass is at most the square of this, or of the worst panel's own condition
 * if that is larger, times eps condition; see [T7]. */
#define HD_PANEL_CONDITION_LEAST 8.0

enum { HD_PROBES = 8 };

struct hd_ortho {
    hd_communicator *communicator; /**< NULL: a single rank */
    int rows, vectors;             /**< rows of this rank's particles; n */
    int coordinates;               /**< of a particle of the frame that is orthonormalised */
    int leaf;                      /**< most vectors that are orthonormalised at once */
    double panel_condition_max;
    int width;          /**< of a panel */
    double *gram;       /**< [width * width], column-major, lower triangle: G, then L */
    double *projection; /**< [later * width], column-major: S */
    double *inverse;    /**< L^-1, stored as gram is, in the memory of S, which comes later */
    double *sum;        /**< [width * width], sum over all ranks; NULL with a single rank */
    /** [vectors]: |V e_k|^2; complete for a panel when its turn comes */
    double *norm2;
    double *scale;       /**< [width], diagonal of G */
    double *probe;       /**< [HD_PROBES][vectors]: R^-T D x, see hd_ortho_condition_from_probes */
    double *log_stretch; /**< [vectors] */
    /** [vectors * vectors], column-major: L of each pass; NULL unless kept */
    double *factor[2];
    double *copy; /**< [rows * width], of a panel of several ranks */
    double condition, defect;
    hd_norm norm; /**< of the present or last step */
    /** Largest of the panels as they were accepted, at least HD_PANEL_CONDITION_LEAST */
    double panel_condition;
    int passes;
};

/** Entry of a fixed matrix of random signs (a bit of the row's hash). */
double hd_probe_sign(int row, int probe);

/** True if a sum of squares is known to rounding: not zero (BLAS libraries treat zero differently),
 * not near the smallest numbers, not overflown. */
bool hd_is_square(double sum);

/** See hd_ortho_condition: with D = diag |V e_k| and random signs x the entries of y = R^-T D x
 * have the mean squares kappa_l^2. INFINITY where one is not finite, or a vector too short to be
 * measured. */
double hd_ortho_condition_from_probes(const hd_ortho *ortho);

void hd_ortho_probes_clear(hd_ortho *ortho);

void hd_ortho_begin(hd_ortho *ortho, const hd_frame *frame, hd_norm norm);

#endif
