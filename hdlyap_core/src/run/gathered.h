/** Vectors of a measured state that can be read: of several ranks those that somebody wants, on
 * each of them. */
#ifndef HD_GATHERED_H
#define HD_GATHERED_H

#include "run/carrier.h"

/** The fields are gathered.c's. */
typedef struct hd_gathered {
    hd_columns columns; /**< count 0: none */
    double *room;       /**< of several ranks */
    size_t size;
} hd_gathered;

void hd_gathered_free(hd_gathered *gathered);
/** Bytes of all that can be wanted of a scene, on each of so many ranks. */
double hd_gathered_bytes(const hd_scene_def *scene, int ranks);

/** Makes the vectors from `first` on readable; of a single rank all of them, as they are.
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_gather(hd_gathered *gathered, const hd_carrier *carrier, int first);

#endif
