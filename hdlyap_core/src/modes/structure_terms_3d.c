/** Along k and the directions across it: (e_d s_d) [T22]. */
#include "modes/structure_terms.h"

hd_structure_term hd_structure_term_of(const hd_wave *wave, hd_direction e, unsigned bits, int d)
{
    const unsigned scalar = bits & (HD_SECOND - 1u), bit = 1u << d;
    const double part = e == HD_ALONG ? wave->k[d] / wave->number
                                      : wave->across[(bits & HD_SECOND) != 0][d];
    if (wave->n[d] == 0) return (hd_structure_term){scalar, part};
    return (hd_structure_term){scalar ^ bit, scalar & bit ? part : -part};
}
