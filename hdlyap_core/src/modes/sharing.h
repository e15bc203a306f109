/** Steps that share a set: do their exponents coincide, or do their vectors still mix [T12]? */
#ifndef HD_SHARING_H
#define HD_SHARING_H

#include "base/archive.h"
#include "hdlyap/steps.h"

/** Tells whether a step still shares its set with the same steps as before, and since when. */
typedef struct hd_set_membership {
    uint64_t members; /**< hash of the numbers of these steps, to be compared with another one; 0:
                         the step shares its set with none */
    double since;     /**< averaged time from which on this hash has been the same */
} hd_set_membership;

/** Fills the members of step[count] that tell about sharing; sets, exponents and errors must be
 * known. The caller keeps company[count] from one call to the next, zero at first. age: time for
 * which the frame has been carried [time units]. */
void hd_sharing_find(hd_step *step, hd_set_membership *company, int count, const hd_modes *modes,
                     const hd_spectrum *spectrum, double age);

/** How far the exponent of resolved step k of step[count] may be off because its fields mix with
 * those of vectors of near exponents [1/time unit]; sets and exponents must be known. rows: length
 * of a vector. Cost O(n). */
double hd_sharing_mixing(const hd_step *step, int count, int k, const hd_modes *modes,
                         const hd_spectrum *spectrum, int rows);

void hd_set_membership_archive(hd_set_membership *company, hd_archive *archive);

#endif
