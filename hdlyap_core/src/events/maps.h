/** A part of a record as tangent maps, which blocks of columns are carried through. */
#ifndef HD_MAPS_H
#define HD_MAPS_H

#include "events/record.h"

/** Columns that a thread carries at once, and their bytes in its cache. */
enum { HD_BLOCK_BYTES = 512 * 1024, HD_BLOCK_WIDTH_MAX = 64 };

typedef struct hd_maps hd_maps;

/** HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_maps_create(hd_maps **out, int disks);
void hd_maps_free(hd_maps *maps);

/** The maps from t_begin to t_end of the record (hd_record_within), all divisions done, with each
 * disk's flight after its last one. HD_NO_MEMORY if there is no room for so many. */
HD_MUST_CHECK hd_status hd_maps_fill(hd_maps *maps, const hd_record *record, double t_begin,
                                     double t_end);

/** Carries a block of columns from t_begin to t_end: block[disk][HD_ROWS][width], the width 1, 2,
 * 4, 8, 16, 32 or 64. Several threads may carry blocks of their own. Cost about 40 width flops and
 * 128 width bytes of cache traffic for a pair event of disks. */
void hd_maps_carry(const hd_maps *maps, double *block, int width);

#endif
