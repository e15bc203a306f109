/** How fields are sampled. */
#ifndef HD_FIELDS_H
#define HD_FIELDS_H

#include "base/archive.h"
#include "hdlyap/fields.h"

/** Creates the fields of a scene. Columns are those of all subspaces, in ascending k, T before LP;
 * then the null fields of each direction (zero if it is not periodic) and of the momenta. Fails
 * with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_fields_create(hd_fields **out, const hd_scene_def *def);
void hd_fields_free(hd_fields *fields);

/** Samples every field at the positions q, where momenta are p; each column gets norm 1 (or stays
 * zero). Cost O(N * columns). */
void hd_fields_sample(hd_fields *fields, const double *q, const double *p);
/** As before the first sample: all are 0. */
void hd_fields_clear(hd_fields *fields);

int hd_fields_nulls(const hd_fields *fields);   /**< null fields, dimension + 1 */
int hd_fields_columns(const hd_fields *fields); /**< all */

/** Norm of a column before it was made 1. */
double hd_fields_norm(const hd_fields *fields, int column);

/** The size of a scene's fields; computing it allocates nothing. */
typedef struct hd_fields_count {
    /** Number of columns without the null fields; number of T and LP subspaces. */
    double columns, subspaces;
    double lp_phases, t_phases;
} hd_fields_count;
hd_fields_count hd_fields_count_of(const hd_scene_def *scene);
void hd_fields_archive(hd_fields *fields, hd_archive *archive);

#endif
