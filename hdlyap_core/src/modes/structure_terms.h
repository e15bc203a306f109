/** What each component of dq contributes to an amplitude of a wave [T20], [T22]. */
#ifndef HD_STRUCTURE_TERMS_H
#define HD_STRUCTURE_TERMS_H

#include "hdlyap/structure.h"

/** The contribution: the component times a product of cosines and sines (given by bits, as a
 * modulation is), times a factor, which is 0 if there is none. */
typedef struct hd_structure_term {
    unsigned function;
    double factor;
} hd_structure_term;

/** The contribution of component d to the amplitude of modulation `bits` of the wave. */
hd_structure_term hd_structure_term_of(int dimension, const hd_wave *wave, hd_direction e,
                                       unsigned bits, int d);

#endif
