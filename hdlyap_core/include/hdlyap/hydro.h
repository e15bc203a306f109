/** Linear response of the Fourier sums of density, momentum and energy to a Lyapunov vector [T15].
 * Several threads may read one at once while its run is not called. */
#ifndef HDLYAP_HYDRO_H
#define HDLYAP_HYDRO_H

#include "hdlyap/steps.h"

HD_API_BEGIN

/** Response of sums over the disks to one normalised vector (|dq|^2 + |dp|^2 = 1), at one
 * modulation A of its step's wave vector, over sqrt(N/2): density, of sum A, over k; momentum
 * along, of sum p.grad A, over k, and across, of sum p.curl A', over k, A' being A with sines along
 * reflecting directions (0 where n is 0 there), of spheres of sum p.F of both transverse fields F
 * of A [T22], of unit e; energy, of sum p^2 A. */
typedef struct hd_hydro_response {
    int step, col;
    unsigned char modulation; /**< HD_SIN_X | HD_SIN_Y */
    double density, along, across, energy;
    double across_second; /**< of spheres, else 0 */
} hd_hydro_response;

typedef struct hd_hydro hd_hydro;

/** expected multiplicity x modulations of each step, in their order; constant. col is -1 where
 * there is none. */
int hd_hydro_count(const hd_hydro *hydro);
const hd_hydro_response *hd_hydro_at(const hd_hydro *hydro, int index);

HD_API_END
#endif
