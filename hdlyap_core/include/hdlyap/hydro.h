/** Linear response of the Fourier sums of density, momentum and energy to a Lyapunov vector [T15].
 * Several threads may read one hd_hydro at once while none calls its run. */
#ifndef HDLYAP_HYDRO_H
#define HDLYAP_HYDRO_H

#include "hdlyap/steps.h"

HD_API_BEGIN

/** How sums over the particles change, to first order, when the state is displaced along a vector
 * with |dq|^2 + |dp|^2 = 1; A is one modulation of its step's wave. All are divided by sqrt(N/2).
 */
typedef struct hd_hydro_response {
    int step, col;
    unsigned char modulation; /**< A, as in hdlyap/wave.h */
    double density;           /**< change of sum A, divided by k */
    double along;             /**< change of sum p . grad A, divided by k */
    double across; /**< change of sum p . F, divided by k: F = curl A with sines along reflecting
                      directions (0 where the mode number is 0); in space the first T field of A, of
                      unit e instead of k [T22] */
    double energy; /**< change of sum p^2 A */
    double across_second; /**< as across, with the second T field of A; 0 in the plane */
} hd_hydro_response;

typedef struct hd_hydro hd_hydro;

/** Number of responses, which is constant: expected multiplicity times modulations of each step, in
 * the order of the steps. col is -1 where no vector was found. */
int hd_hydro_count(const hd_hydro *hydro);
const hd_hydro_response *hd_hydro_at(const hd_hydro *hydro, int index);

HD_API_END
#endif
