/** Fields of a container with its own modulations, as a circle. */
#ifndef HD_CURVED_FIELDS_H
#define HD_CURVED_FIELDS_H

#include "hdlyap/fields.h"
#include "scene/container.h"

/** Fills row[d][..], component d of all columns of a subspace, for a particle at q with momentum p.
 * own: what the container keeps of the subspace's wave. */
void hd_curved_fields_fill(double *const *row, const hd_subspace *s,
                           const hd_container_row *container, const double *own, const double *q,
                           const double *p);

#endif
