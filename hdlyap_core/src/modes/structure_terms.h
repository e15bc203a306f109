/** What each component of dq adds to an amplitude of a wave [T20], [T22]. */
#ifndef HD_STRUCTURE_TERMS_H
#define HD_STRUCTURE_TERMS_H

#include "hdlyap/structure.h"

/** The component times this product of cosines and sines (bits as of a modulation), times a factor;
 * 0 if it adds nothing. */
typedef struct hd_structure_term {
    unsigned function;
    double factor;
} hd_structure_term;

/** Of component d in the amplitude of modulation `bits` of the wave. */
hd_structure_term hd_structure_term_of(int dimension, const hd_wave *wave, hd_direction e,
                                       unsigned bits, int d);

#endif
