/** The results of a run, and how many numbers they have. */
#ifndef HDLYAP_OBSERVABLES_H
#define HDLYAP_OBSERVABLES_H

#include <stdbool.h>

#include "hdlyap/spectrum.h"
#include "hdlyap/trajectory.h"

HD_API_BEGIN

/** Bytes of the name of a quantity that a target can name, as T(1,0) or c_T, with its final zero.
 */
enum { HD_QUANTITY_NAME = 32 };

/** Returns the set of HD_OBSERVE_* that particles of this row can have: without positions in a box
 * none that needs them, without hd_dynamics.totals no gas, without hd_dynamics.averages no
 * averages.
 */
unsigned hd_observe_of(const hd_dynamics *row);

/** The parts of a run: a pointer to the result of each observable, named as in observables.inc;
 * NULL if the scene does not ask for it. The parts belong to the run and last until it is freed. */
typedef struct hd_parts {
    const hd_trajectory *trajectory; /**< always there */
    const hd_spectrum *spectrum;     /**< the exponents; NULL if the scene asks for none */
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) result *name;
#include "hdlyap/observables.inc"
} hd_parts;

/** How many numbers the results of a run have; 0 for observables that the scene does not ask for.
 */
typedef struct hd_result_counts {
    /** Dimension of space; number of coordinates of a particle. */
    int dimension, coordinates;
    bool turning; /**< true if particles turn, their last coordinate being an angle */
    /** Number of particles; number of vectors. */
    int particles, vectors;
    int waves; /**< number of waves of structure factors */
    /** Of covariant vectors: number of subspaces of fields in which weights are taken; number of
     * angles between spaces (HD_PAIRS_OF_SPACES, or 0). */
    int subspaces, angles;
    int steps; /**< number of steps, conjugate ones included */
    /** Number of T and LP steps of positive exponents, each of which can have one vector shown;
     * number of pairs of L and P fields of all these LP steps. */
    int examples, pairs;
    int phases, t_phases; /**< number of LP phases; number of T phases */
    int responses;        /**< number of hydrodynamic responses */
    /** Number of lengths of time over which fluctuations of growth are known, as a mean over the
     * reports of the run. */
    int times;
    int found; /**< number of steps of positive exponents that are resolved now */
    /** Number of lengths of time over which the order of covariant vectors is compared. */
    int orders;
    int averages; /**< number of averages that the row of the dynamics tells */
} hd_result_counts;

HD_API_END
#endif
