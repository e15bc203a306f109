/** Steps that share a set: do their exponents coincide, or do their vectors still mix [T12]? */
#ifndef HD_SHARING_H
#define HD_SHARING_H

#include "base/archive.h"
#include "hdlyap/steps.h"

/** Since when a step has been in the same company. */
typedef struct hd_company {
    uint64_t members; /**< which steps share its set, 0: none */
    double since;     /**< averaged time */
} hd_company;

/** Fills what step[count] say about sharing; sets, exponents and errors are known. company[count]
 * is kept from one call to the next, zero at first. age: of the frame, in time units. */
void hd_sharing_find(hd_step *step, hd_company *company, int count, const hd_modes *modes,
                     const hd_spectrum *spectrum, double age);

void hd_company_archive(hd_company *company, hd_archive *archive);

#endif
