/** Cells -> whom a disk may meet, and when. Who is near is gathered without a look at the disks;
 * then the contacts are computed side by side, those that do not happen too. */
#ifndef HD_NEARBY_H
#define HD_NEARBY_H

#include "dynamics/hard/cells.h"
#include "dynamics/hard/contact.h"

/** The places of all cells around; and what the copy of a whole cell and the last step spill
 * beyond. */
enum { HD_NEARBY_MAX = HD_CELLS_AROUND * HD_CELL_DISKS, HD_NEARBY_SPARE = 4 };

typedef struct hd_nearby {
    int32_t count, crowded; /**< crowded: 1 if a cell's list holds more */
    int32_t disk[HD_NEARBY_MAX + HD_NEARBY_SPARE];
    /** Box edges to add to each one's position, less its own wraps, to see it where its cell is
     * seen. */
    int32_t image[HD_DIM][HD_NEARBY_MAX + HD_NEARBY_SPARE];
} hd_nearby;

/** The disks in the places of the cells around a disk, itself among them. */
void hd_nearby_around(hd_nearby *near, const hd_cells *cells, const hd_disk *disk);

/** The disks in the places of the cells at one side (0 low, 2 high) of a disk in direction d. */
void hd_nearby_beside(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int d, int side);

/** Those of one cell that find no place there: what comes after j in its list, as many as `near`
 * holds. The cell is number k of those around. Returns the last one, to be asked for more, or -1.
 */
int32_t hd_nearby_listed(hd_nearby *near, const hd_cells *cells, const hd_disk *disk, int k,
                         int32_t j);

enum { HD_NEARBY_NONE = -1, HD_NEARBY_TIED = -2 };

/** contact[count] (room for HD_NEARBY_SPARE more): when disk i meets those nearby, NaN if never.
 * Returns the number of the earliest, HD_NEARBY_NONE, or HD_NEARBY_TIED if several may be as
 * early. Fills the places after near->disk[count]. */
int hd_nearby_contacts(double *contact, hd_nearby *near, const hd_disk *disks, int32_t i,
                       const double box[HD_DIM]);

#endif
