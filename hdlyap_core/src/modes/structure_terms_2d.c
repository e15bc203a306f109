/** Along (A_x, A_y), across (A_y, -A_x) [T20]. */
#include "modes/structure_terms.h"

hd_structure_term hd_structure_term_of(const hd_wave *wave, hd_direction e, unsigned bits, int d)
{
    const int derived = e == HD_ALONG ? d : 1 - d;
    const unsigned bit = derived == 0 ? HD_SIN_X : HD_SIN_Y;
    const double part = wave->k[derived] / wave->number, slope = bits & bit ? part : -part;
    return (hd_structure_term){bits ^ bit, e == HD_ACROSS && d == 1 ? -slope : slope};
}
