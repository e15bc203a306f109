/** Angles between covariant vectors, and between the spaces that they span: how they split tangent
 * space [T17]. n is the number of vectors. [T17] is the tag of an equation in THEORY.md. */
#ifndef HDLYAP_SPLITTING_H
#define HDLYAP_SPLITTING_H

/** Pairs of two of the spaces that belong to positive (unstable), vanishing (centre) and negative
 * (stable) exponents. */
typedef enum hd_pair_of_spaces {
    HD_UNSTABLE_STABLE,
    HD_UNSTABLE_CENTRE,
    HD_CENTRE_STABLE,
    HD_PAIRS_OF_SPACES
} hd_pair_of_spaces;

/** Number of bins, equally wide, of a histogram of angles from 0 to pi / 2. */
enum { HD_ANGLE_BINS = 90 };

/** The angle between two spaces: the smallest of their principal angles [rad]. Its value in the
 * last sample, its mean over all samples, the standard error of the mean (negative while it is not
 * known), and its smallest value. */
typedef struct hd_angle_of_spaces {
    double last, mean, std_error, least;
    double mean_of_all; /**< mean of all principal angles, over all samples [rad] */
    /** How often the smallest angle, and how often any principal angle, fell into each bin. */
    long smallest[HD_ANGLE_BINS], all[HD_ANGLE_BINS];
} hd_angle_of_spaces;

/** Results of all samples so far. Arrays belong to the run and change when it goes on. */
typedef struct hd_splitting_results {
    /** Number of samples. */
    long samples;
    int has_spaces; /**< not 0 if all three spaces are computed, so that there are angles between
                       them */
    const hd_angle_of_spaces *angle; /**< the angles, [HD_PAIRS_OF_SPACES], if has_spaces */
    /** Angle between vectors col and col + 1, [n - 1], 0 .. pi / 2 [rad]: its mean over the
     * samples, and the smallest so far. */
    const double *neighbours, *neighbours_least;
} hd_splitting_results;
#endif
