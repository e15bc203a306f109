/** What a run tells, and how much of it. */
#ifndef HDLYAP_OBSERVABLES_H
#define HDLYAP_OBSERVABLES_H

#include "hdlyap/spectrum.h"
#include "hdlyap/trajectory.h"

HD_API_BEGIN

/** Room for the name of a quantity that a target can have, as T(1,0) or c_T. */
enum { HD_QUANTITY_NAME = 32 };

/** Those that are of positions in a box: a set of HD_OBSERVE_*. */
unsigned hd_observe_of_box(void);

/** What a run is made of. Of each observable its result, by its row in observables.inc; NULL what
 * the scene does not ask for. */
typedef struct hd_parts {
    const hd_trajectory *trajectory; /**< always there */
    const hd_spectrum *spectrum;     /**< NULL without exponents */
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) result *name;
#include "hdlyap/observables.inc"
} hd_parts;

/** How many there are of what a run tells. What the scene does not ask for is 0. */
typedef struct hd_extent {
    int dimension, coordinates; /**< of the space, of a particle */
    int disks, vectors;
    int waves; /**< of the structure factors */
    int subspaces,
        angles;          /**< of covariant vectors: kinds of fields of each wave, pairs of spaces */
    int steps;           /**< in both halves of the spectrum */
    int examples, pairs; /**< steps that have an example, and the LP pairs of these in all */
    int phases, t_phases; /**< followed */
    int responses;        /**< hydrodynamic ones */
} hd_extent;

HD_API_END
#endif
