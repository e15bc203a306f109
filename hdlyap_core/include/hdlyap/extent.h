/** How much a run tells: what the sizes of messages follow from. */
#ifndef HDLYAP_EXTENT_H
#define HDLYAP_EXTENT_H

#include "hdlyap/status.h"

HD_API_BEGIN

/** How many there are of what a run tells. What the scene does not ask for is 0. */
typedef struct hd_extent {
    int dimension; /**< of the space */
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
