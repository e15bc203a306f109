/** Cells -> the disks that a disk may meet, and when. First the indices of the disks nearby are
 * gathered from the cells alone; then contact times are computed for all of them, several at once,
 * though most never meet. */
#ifndef HD_NEARBY_H
#define HD_NEARBY_H

#include "dynamics/hard/cells.h"
#include "dynamics/hard/contact.h"
#include "dynamics/hard/sizes.h"

/** Places of all cells around a disk; and spare places, which the copy of a whole cell and the last
 * step of contacts write to. */
enum { HD_NEARBY_MAX = HD_CELLS_AROUND * HD_CELL_DISKS, HD_NEARBY_SPARE = 4 };

typedef struct hd_nearby {
    int32_t count, crowded; /**< crowded: 1 if the list of a cell holds disks that are not here */
    int32_t disk[HD_NEARBY_MAX + HD_NEARBY_SPARE];
    /** Box edges to add to the position of each disk, apart from the disk's own wraps, to move it
     * to the image that is nearby. */
    int32_t image[HD_DIM][HD_NEARBY_MAX + HD_NEARBY_SPARE];
} hd_nearby;

/** Gathers the disks in the places of the cells around a disk, itself among them. */
void hd_nearby_around(hd_nearby *near, const hd_cells *cells, const hd_disk *disk);

/** Gathers the disks in the places of the cells at one side (0 below, 2 above) of a disk in
 * direction d. */
void hd_nearby_beside(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int d, int side);

/** Gathers the disks after j in the list of the k-th of the cells around a disk, as many as `near`
 * holds. Returns the last one, for the next call, or -1 if there are no more. */
int32_t hd_nearby_listed(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int k,
                         int32_t j);

enum { HD_NEARBY_NONE = -1, HD_NEARBY_TIED = -2 };

/** Fills contact[count] with the times at which disk i meets the disks nearby, NaN if never.
 * contact has room for HD_NEARBY_SPARE more. Returns the index of the earliest, HD_NEARBY_NONE, or
 * HD_NEARBY_TIED if several may be equally early. Overwrites the spare places of near->disk. */
int hd_nearby_contacts(double *contact, hd_nearby *near, const hd_disk *disks, int32_t i,
                       const double box[HD_DIM], const hd_sizes *sizes);

#endif
