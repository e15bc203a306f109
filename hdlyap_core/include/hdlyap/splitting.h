/** How the covariant vectors split tangent space: angles, and whose finite-time exponents keep
 * their order [T17]. */
#ifndef HDLYAP_SPLITTING_H
#define HDLYAP_SPLITTING_H

#include "hdlyap/status.h"

HD_API_BEGIN

/** Pairs of the spaces of positive, vanishing and negative exponents. */
typedef enum hd_pair_of_spaces {
    HD_UNSTABLE_STABLE,
    HD_UNSTABLE_CENTRE,
    HD_CENTRE_STABLE,
    HD_PAIRS_OF_SPACES
} hd_pair_of_spaces;

enum { HD_ANGLE_BINS = 90 }; /**< of a histogram from 0 to pi / 2 */

typedef struct hd_splitting hd_splitting;

/** `unstable` first columns, then `centre`; the others are stable. Without stable ones there are no
 * pairs of spaces. */
HD_MUST_CHECK hd_status hd_splitting_create(hd_splitting **out, int vectors, int unstable,
                                            int centre);
void hd_splitting_free(hd_splitting *splitting);
void hd_splitting_clear(hd_splitting *splitting);

/** Vectors of one time: C [n * n], column-major, of columns of length 1. HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_splitting_add(hd_splitting *splitting, const double *c);
/** Growth of each vector over one finite time; [n]. */
void hd_splitting_grow(hd_splitting *splitting, const double *growth);

long hd_splitting_samples(const hd_splitting *splitting);
int hd_splitting_has_spaces(const hd_splitting *splitting);

/* Angles in radians, 0 .. pi / 2. */

/** Angle between vectors col and col + 1, [n - 1]: mean and smallest. */
const double *hd_splitting_neighbours(const hd_splitting *splitting);
const double *hd_splitting_neighbours_least(const hd_splitting *splitting);

/** Smallest principal angle between two spaces: last, mean, standard error (negative if unknown),
 * smallest ever. */
typedef struct hd_angle_of_spaces {
    double last, mean, std_error, least;
    double mean_of_all;                               /**< mean of all principal angles */
    long smallest[HD_ANGLE_BINS], all[HD_ANGLE_BINS]; /**< histograms: of smallest ones, of all */
} hd_angle_of_spaces;
const hd_angle_of_spaces *hd_splitting_angle(const hd_splitting *splitting, hd_pair_of_spaces pair);

/** Fraction of the finite times over which vector col grew less than col + 1, [n - 1]. */
const double *hd_splitting_violations(const hd_splitting *splitting);
/** Fraction over which any of the vectors up to col grew less than any later one, [n - 1]: 0 where
 * the splitting there is dominated, so that what is on either side is isolated from the other. */
const double *hd_splitting_domination_violations(const hd_splitting *splitting);

HD_API_END
#endif
