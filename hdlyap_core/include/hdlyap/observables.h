/** The results of a run, and their numbers. */
#ifndef HDLYAP_OBSERVABLES_H
#define HDLYAP_OBSERVABLES_H

#include "hdlyap/spectrum.h"
#include "hdlyap/trajectory.h"

HD_API_BEGIN

/** Size of the name of a quantity that a target can name, as T(1,0) or c_T. */
enum { HD_QUANTITY_NAME = 32 };

/** The observables (a set of HD_OBSERVE_*) that need positions in a box. */
unsigned hd_observe_of_box(void);

/** The parts of a run: one pointer for each observable, to its result; NULL if the scene does not
 * ask for it. */
typedef struct hd_parts {
    const hd_trajectory *trajectory; /**< always there */
    const hd_spectrum *spectrum;     /**< NULL without exponents */
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) result *name;
#include "hdlyap/observables.inc"
} hd_parts;

/** Numbers of results of a run; 0 for what the scene does not ask for. */
typedef struct hd_extent {
    int dimension, coordinates; /**< dimension of space; coordinates of a particle */
    int particles, vectors;
    int waves; /**< waves of the structure factors */
    int subspaces,
        angles; /**< subspaces of fields, and pairs of spaces with angles, of covariant vectors */
    int steps;  /**< steps in both halves of the spectrum */
    int examples, pairs;  /**< steps that are shown by an example, and all their LP pairs */
    int phases, t_phases; /**< LP phases and T phases */
    int responses;        /**< hydrodynamic responses */
    int times;            /**< times over which growth is told, mean over the run */
    int found;            /**< resolved steps of the positive half */
    int orders;           /**< times over which covariant vectors grow in a window */
} hd_extent;

HD_API_END
#endif
