/** Exponents of a run -> how many covariant vectors are unstable, and of the centre. */
#include "base/check.h"
#include "covariant/covariant_state.h"
#include "dynamics/dynamics.h"
#include "scene/scene.h"

/** Number of exponents that vanish, as the row says; negative: it does not say. */
static int said_zeros(const hd_covariant *c)
{
    return hd_dynamics_of(&c->scene)->zero_exponents ? hd_scene_zero_exponents(&c->scene) : -1;
}

void hd_covariant_prepare_counting(hd_covariant *c, const hd_spectrum *spectrum)
{
    HD_ASSERT(spectrum);
    c->counting = spectrum;
    c->centre_most = c->vectors;
    c->centre = 0;
    c->unstable = c->vectors;
}

void hd_covariant_count(hd_covariant *c)
{
    const hd_signs signs = hd_spectrum_signs(c->counting, said_zeros(c));
    const bool known = signs.positive > 0 && signs.zero > 0 &&
                       signs.positive + signs.zero < c->vectors;
    const int unstable = known ? signs.positive : c->vectors, centre = known ? signs.zero : 0;
    if (unstable == c->unstable && centre == c->centre) return;
    c->unstable = unstable;
    c->centre = centre;
    hd_splitting_divide(c->splitting, unstable, centre);
    c->null_apart = c->null_apart_most = -1.0;
    c->spaces_apart.centre = c->spaces_apart.stable = -1.0;
}

void hd_covariant_archive_counts(hd_covariant *c, hd_archive *archive)
{
    hd_archive_int(archive, "covariant unstable", &c->unstable, 1, c->vectors);
    hd_archive_int(archive, "covariant centre", &c->centre, 0, c->vectors - c->unstable);
    if (!archive->writing) hd_splitting_divide(c->splitting, c->unstable, c->centre);
}
