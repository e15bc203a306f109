/** The fields of a wave vector of a box, at one place [T10], [T22]. */
#ifndef HD_PLANE_FIELDS_H
#define HD_PLANE_FIELDS_H

#include "hdlyap/fields.h"
#include "modes/harmonics.h"

/** row[d][..]: component d of all columns of the subspace; `along` are filled there, p[HD_DIM] is
 * the momentum. */
void hd_plane_fields_fill(double *const row[HD_DIM], const hd_subspace *s,
                          const hd_harmonics along[HD_DIM], const double *p);

#endif
