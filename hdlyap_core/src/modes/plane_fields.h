/** The fields of a wave vector of a box, at one place [T10], [T22]. */
#ifndef HD_PLANE_FIELDS_H
#define HD_PLANE_FIELDS_H

#include "hdlyap/fields.h"
#include "modes/harmonics.h"

/** Fills row[d][..], component d of all columns of the subspace. `along` are the harmonics of the
 * place, p is the momentum. */
void hd_plane_fields_fill(double *const *row, const hd_subspace *s, const hd_harmonics *along,
                          const double *p);
/** The same in space. */
void hd_space_fields_fill(double *const *row, const hd_subspace *s, const hd_harmonics *along,
                          const double *p);

#endif
