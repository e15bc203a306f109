/** How angles are measured. */
#ifndef HD_SPLITTING_H
#define HD_SPLITTING_H

#include "base/archive.h"
#include "hdlyap/splitting.h"
#include "hdlyap/status.h"

typedef struct hd_splitting hd_splitting;

/** Makes an empty splitting of n = vectors. The first `unstable` columns are unstable, the next
 * `centre` belong to the centre, the others are stable. If there are no stable columns, angles
 * between spaces are not measured. unstable = 0: hd_splitting_divide will say which are which. */
HD_MUST_CHECK hd_status hd_splitting_create(hd_splitting **out, int vectors, int unstable,
                                            int centre);
void hd_splitting_free(hd_splitting *splitting);
void hd_splitting_clear(hd_splitting *splitting);
/** Columns belong to these spaces from now on. If that is new, all averages begin anew. */
void hd_splitting_divide(hd_splitting *splitting, int unstable, int centre);

/** Adds the vectors of one time: C [n * n], column-major, columns of length 1. Fails with
 * HD_ILL_CONDITIONED. */
HD_MUST_CHECK hd_status hd_splitting_add(hd_splitting *splitting, const double *c);

hd_splitting_results hd_splitting_read(const hd_splitting *splitting);

void hd_splitting_archive(hd_splitting *splitting, hd_archive *archive);

#endif
