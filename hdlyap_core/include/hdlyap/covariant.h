/** Covariant Lyapunov vectors, computed over windows of a run one after another [T16] (Ginelli et
 * al., Phys. Rev. Lett. 99, 130601 (2007)). n is the number of vectors; arrays of n elements are in
 * the order of the exponents, largest first.
 *
 * A window begins where the last one ended. The run goes on beyond the window's end by the
 * transient (covariant_transient). From there two independent random sets of vectors, the two
 * starts, are carried backwards in time through the transient. By how much they still differ at the
 * window's end is the start mismatch. From there the first start alone is carried back to the
 * beginning of the window; its vectors within the window are the covariant vectors. The functions
 * of one run share a workspace: only one thread at a time may call them for the same run. Tags as
 * [T16] are those of equations in THEORY.md. */
#ifndef HDLYAP_COVARIANT_H
#define HDLYAP_COVARIANT_H

#include <stdbool.h>

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/splitting.h"

HD_API_BEGIN

/** The covariant vectors of a run, and the averages over them; owned by the run. */
typedef struct hd_covariant hd_covariant;

/** How far the two starts still differ at the ends of windows, after the transient. */
typedef struct hd_covariant_mismatch {
    /** In the last window: largest sine of the angle between the two starts' vectors of the same
     * index, 0 .. 1; negative before the first window. It stays large if exponents are equal,
     * because their vectors have no direction of their own. */
    double most;
    /** In all windows: largest angle between the two starts' spaces of vectors with vanishing
     * exponents [rad]; negative before the first window, or if not all of these vectors are
     * computed. */
    double centre;
    /** In all windows: largest angle between the two starts' spaces of vectors with negative
     * exponents that are computed [rad]; negative as `centre`, or if none of these is computed. */
    double stable;
} hd_covariant_mismatch;

/** Results of all windows so far. Arrays belong to the run; their contents change when it goes on,
 * and they last until it is freed. */
typedef struct hd_covariant_results {
    int vectors; /**< number n of vectors */
    /** Numbers of vectors with positive and with vanishing exponents; the others are stable. Theory
     * says them if maps are symplectic; else they are counted by value at the end of each window,
     * with those of the centre that cannot be told from zero modes yet [T27], and by error if the
     * row has no zero_exponents. Both are 0 while they are not known, and if
     * these spaces are not measured. */
    int unstable, centre;
    long windows;      /**< number of complete windows that the averages contain */
    long lost;         /**< number of windows that were left out because they did not fit into
                          covariant_memory */
    double window_end; /**< simulated time at which the last complete window ended, or at which the
                          first one begins [time units] */
    /** Exponents of the covariant vectors: their mean growth rates, which agree with those of the
     * frame. hd_spectrum_local is the growth rate over the earliest part of the last window, from
     * its beginning to the sample after it. */
    const hd_spectrum *spectrum;
    /** Growth that vectors had beyond that of the frame, as they still turned within windows, [n],
     * summed over all windows: what is left of the random starts [T16]. */
    const double *turned;
    /** Angles between vectors and between spaces, from all samples. */
    hd_splitting_results splitting;
    /** Order of the vectors' growth, order[times]: over the time between two samples
     * (covariant_sampling), over twice that time, and so on, as long as it fits into a window. */
    int times;
    hd_order_over order[HD_TIMES_MAX];
    hd_covariant_mismatch start_mismatch;
    /** Sine of the angle between the two starts' vectors of each index, [n], at the end of the last
     * window. The error of a covariant vector there is at least about this large; it may be larger,
     * because both starts turn towards the frame. */
    const double *start_mismatch_each;
    /** Largest angle between the exactly known null space [T9] and the space of the vectors with
     * vanishing exponents, which contains it in theory: in the last sample, and the largest of all
     * samples [rad]. Negative before the first sample, or if not all of these vectors are computed.
     */
    double null, null_most;
    /** Mean weights [T11] of the covariant vectors in the fields of waves: half[0] of their dq
     * halves, half[1] of their dp halves, each scaled to length 1. NULL if particles have no
     * positions in a box. */
    const hd_modes *half[2];
    /** Mean weights of the dq halves of the Gram-Schmidt vectors, in the same samples. */
    const hd_modes *of_frame;
    /** Mean localisation widths, [n], 1 / N .. 1 (hdlyap/localization.h); and mean of |cos| of the
     * angle between the dq half and the dp half of a vector, [n], 0 .. 1. */
    const double *widths, *cosines;
} hd_covariant_results;
/** Reads the results; O(n). */
hd_covariant_results hd_covariant_read(const hd_covariant *covariant);
/** Standard error of the exponent of a covariant vector, 0 .. n - 1 [1/time unit]; negative
 * while it is not known. hd_covariant_results.turned is a part of it: a longer transient lessens
 * it, more windows do not. */
double hd_covariant_std_error(const hd_covariant_results *results, int vector);

HD_API_END
#endif
