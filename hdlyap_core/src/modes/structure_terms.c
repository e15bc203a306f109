/** What each component of dq contributes to amplitudes [T20], [T22]. */
#include "modes/structure_terms.h"

/** In the plane e is along (A_x, A_y) or across (A_y, -A_x). */
static hd_structure_term in_plane(const hd_wave *wave, hd_direction e, unsigned bits, int d)
{
    const int derived = e == HD_ALONG ? d : 1 - d;
    const unsigned bit = derived == 0 ? HD_SIN_X : HD_SIN_Y;
    const double part = wave->k[derived] / wave->number, slope = bits & bit ? part : -part;
    return (hd_structure_term){bits ^ bit, e == HD_ACROSS && d == 1 ? -slope : slope};
}

/** In space the field is (e_d s_d), with e along k or across it. */
static hd_structure_term in_space(const hd_wave *wave, hd_direction e, unsigned bits, int d)
{
    const unsigned scalar = bits & (HD_SECOND - 1u), bit = 1u << d;
    const double part = e == HD_ALONG ? wave->k[d] / wave->number
                                      : wave->across[(bits & HD_SECOND) != 0][d];
    if (wave->n[d] == 0) return (hd_structure_term){scalar, part};
    return (hd_structure_term){scalar ^ bit, scalar & bit ? part : -part};
}

hd_structure_term hd_structure_term_of(int dimension, const hd_wave *wave, hd_direction e,
                                       unsigned bits, int d)
{
    return dimension == 2 ? in_plane(wave, e, bits, d) : in_space(wave, e, bits, d);
}
