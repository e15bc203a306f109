/** Along k and the directions across it: (e_d s_d) [T22]. */
#include "modes/structure_terms.h"

#include "modes/polarisation.h"

hd_structure_term hd_structure_term_of(const hd_wave *wave, hd_direction e, unsigned bits, int d,
                                       unsigned walls)
{
    const unsigned scalar = bits & (HD_SECOND - 1u), bit = 1u << d;
    double across[2][HD_DIM];
    hd_polarisations(across, wave, walls);
    const double part = e == HD_ALONG ? wave->k[d] / wave->number
                                      : across[(bits & HD_SECOND) != 0][d];
    if (wave->n[d] == 0) return (hd_structure_term){scalar, part};
    return (hd_structure_term){scalar ^ bit, scalar & bit ? part : -part};
}
