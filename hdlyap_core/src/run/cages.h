/** Whether disks have left their places since the averaging began: in a crystal or a glass they do
 * not, and what is averaged is of one of its states [T8]. */
#ifndef HD_CAGES_H
#define HD_CAGES_H

#include "base/archive.h"
#include "hdlyap/trajectory.h"

/** The fields are cages.c's. */
typedef struct hd_cages {
    size_t count;        /**< of coordinates */
    double *start, *now; /**< [count], positions as the averaging began; workspace */
    double begin, end;   /**< simulated times: of the start, and of the last look */
    bool left;           /**< seen at a look since */
} hd_cages;

/** HD_NO_MEMORY. It takes no more than the start of a trajectory has given back. */
HD_MUST_CHECK hd_status hd_cages_create(hd_cages *cages, const hd_scene_def *scene);
void hd_cages_clear(hd_cages *cages);

/** The averages begin here. */
void hd_cages_begin(hd_cages *cages, const hd_trajectory *trajectory);
/** Cost O(N), until they have left. */
void hd_cages_look(hd_cages *cages, const hd_trajectory *trajectory, const hd_scene_def *scene);
/** True if they have not left for at least so long; false too while that is not yet known. */
bool hd_cages_hold(const hd_cages *cages, double least);

void hd_cages_archive(hd_cages *cages, const hd_trajectory *trajectory, hd_archive *archive);

#endif
