/** Fields of a container that has modulations of its own. */
#ifndef HD_CURVED_FIELDS_H
#define HD_CURVED_FIELDS_H

#include "hdlyap/fields.h"
#include "scene/container.h"

/** row[d][..]: component d of all columns of a subspace at q, where the momentum is p; own: of its
 * wave, by the container. */
void hd_curved_fields_fill(double *const *row, const hd_subspace *s,
                           const hd_container_row *container, const double *own, const double *q,
                           const double *p);

#endif
