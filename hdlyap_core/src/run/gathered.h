/** The vectors of a measured state that can be read on this rank: with several ranks those that
 * somebody reads are gathered from all. */
#ifndef HD_GATHERED_H
#define HD_GATHERED_H

#include "run/carrier.h"

/** Only gathered.c uses the members. */
typedef struct hd_gathered {
    hd_columns columns; /**< count 0: none */
    double *room;       /**< memory of the vectors, with several ranks */
    size_t size;
} hd_gathered;

void hd_gathered_free(hd_gathered *gathered);
/** Bytes for all vectors that a scene can ask for, on each of `ranks` ranks. */
double hd_gathered_bytes(const hd_scene_def *scene, int ranks);

/** Makes the vectors from `first` on readable; with a single rank all of them are, without a copy.
 * Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_gather(hd_gathered *gathered, const hd_carrier *carrier, int first);

#endif
