/** How the covariant vectors split tangent space: angles, and whose finite-time exponents keep
 * their order [T17]. */
#ifndef HDLYAP_SPLITTING_H
#define HDLYAP_SPLITTING_H

/** Pairs of the spaces of positive, vanishing and negative exponents. */
typedef enum hd_pair_of_spaces {
    HD_UNSTABLE_STABLE,
    HD_UNSTABLE_CENTRE,
    HD_CENTRE_STABLE,
    HD_PAIRS_OF_SPACES
} hd_pair_of_spaces;

enum { HD_ANGLE_BINS = 90 }; /**< of a histogram from 0 to pi / 2 */

/** Smallest principal angle between two spaces: last, mean, standard error (negative if unknown),
 * smallest ever. */
typedef struct hd_angle_of_spaces {
    double last, mean, std_error, least;
    double mean_of_all;                               /**< mean of all principal angles */
    long smallest[HD_ANGLE_BINS], all[HD_ANGLE_BINS]; /**< histograms: of smallest ones, of all */
} hd_angle_of_spaces;

/** What has been seen so far. Angles in radians, 0 .. pi / 2. */
typedef struct hd_splitting_results {
    long samples;
    int has_spaces;
    const hd_angle_of_spaces *angle; /**< [HD_PAIRS_OF_SPACES], if there are spaces */
    /** Angle between vectors col and col + 1, [n - 1]: mean and smallest. */
    const double *neighbours, *neighbours_least;
    /** Fraction of the finite times over which vector col grew less than col + 1, [n - 1]. */
    const double *violations;
    /** Fraction over which any of the vectors up to col grew less than any later one, [n - 1]: 0
     * where the splitting there is dominated, so that what is on either side is isolated from the
     * other. */
    const double *domination_violations;
} hd_splitting_results;
#endif
