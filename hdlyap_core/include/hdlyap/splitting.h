/** How covariant vectors split tangent space: angles between vectors and spaces [T17]. */
#ifndef HDLYAP_SPLITTING_H
#define HDLYAP_SPLITTING_H

/** Pairs of the spaces of positive (unstable), vanishing (centre) and negative (stable) exponents.
 */
typedef enum hd_pair_of_spaces {
    HD_UNSTABLE_STABLE,
    HD_UNSTABLE_CENTRE,
    HD_CENTRE_STABLE,
    HD_PAIRS_OF_SPACES
} hd_pair_of_spaces;

enum { HD_ANGLE_BINS = 90 }; /**< bins of a histogram from 0 to pi / 2 */

/** Smallest principal angle between two spaces [rad]: in the last sample, its mean, the standard
 * error of the mean (negative if unknown), and the smallest of all samples. */
typedef struct hd_angle_of_spaces {
    double last, mean, std_error, least;
    double mean_of_all;                               /**< mean of all principal angles [rad] */
    long smallest[HD_ANGLE_BINS], all[HD_ANGLE_BINS]; /**< histograms of the smallest, of all */
} hd_angle_of_spaces;

/** Results of all samples so far. Angles in radians, 0 .. pi / 2. */
typedef struct hd_splitting_results {
    long samples;
    int has_spaces;                  /**< vectors of all three spaces are computed */
    const hd_angle_of_spaces *angle; /**< [HD_PAIRS_OF_SPACES] if has_spaces */
    /** Angle between vectors col and col + 1, [n - 1]: mean, and smallest so far. */
    const double *neighbours, *neighbours_least;
} hd_splitting_results;
#endif
