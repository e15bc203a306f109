/** Linear response of hydrodynamic fields to a Lyapunov vector [T15]: by how much the Fourier sums
 * of density, momentum and energy change if the particles are displaced along the vector. Responses
 * are measured at the reports of the averaging; before the first one col is -1. Several threads may
 * read one hd_hydro at once while no thread calls its run. Tags as [T15] are those of equations in
 * THEORY.md. */
#ifndef HDLYAP_HYDRO_H
#define HDLYAP_HYDRO_H

#include "hdlyap/steps.h"

HD_API_BEGIN

/** Response to one vector of a step, for one modulation A(r): one of hd_wave.pairs of the step's
 * wave, in T steps too. The numbers are changes, to first order, of sums over the particles when
 * the state (q, p) is displaced along the vector, which has |dq|^2 + |dp|^2 = 1. All are divided by
 * sqrt(N / 2); k is the wave number. They are 0 if col is -1. */
typedef struct hd_hydro_response {
    /** Index of the step in hd_steps; column of the vector, -1 if no vector was found. */
    int step, col;
    unsigned char modulation; /**< the modulation A, bits as in hdlyap/wave.h */
    double density;           /**< change of sum A, divided by k */
    double along;             /**< change of sum p . grad A, divided by k */
    /** In the plane, change of sum p . F, divided by k, with F = curl B = (dB/dy, -dB/dx). B is A
     * with a sine instead of the cosine along each reflecting direction, so B and F are 0 if such a
     * direction has mode number 0. In space, change of sum p . F with F the first T field of A, of
     * amplitude 1 [T22]. */
    double across;
    double energy;        /**< change of sum p^2 A / m, with the mass m of a particle */
    double across_second; /**< in space, as `across` with the second T field of A; 0 in the plane */
} hd_hydro_response;

/** The responses of all steps; owned by the run. */
typedef struct hd_hydro hd_hydro;

/** Number of responses, which is constant. Steps follow each other in their order in hd_steps. Each
 * has hd_step.expected vectors, and for each of these a response for each modulation of
 * hd_wave.pairs. */
int hd_hydro_count(const hd_hydro *hydro);
/** Response `index`, 0 .. hd_hydro_count - 1. */
const hd_hydro_response *hd_hydro_at(const hd_hydro *hydro, int index);

HD_API_END
#endif
