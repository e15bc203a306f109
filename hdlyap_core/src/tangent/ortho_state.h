/** The members of an orthonormaliser: ortho.c takes the panels one after the other, panel.c
 * orthonormalises one. */
#ifndef HD_ORTHO_STATE_H
#define HD_ORTHO_STATE_H

#include <stdbool.h>

#include "tangent/frame.h"
#include "tangent/ortho.h"

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
