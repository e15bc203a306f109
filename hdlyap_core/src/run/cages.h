/** Whether the particles have left their places since the averaging began. In a crystal or a glass
 * they do not, and averages then hold for one arrangement only [T8]. */
#ifndef HD_CAGES_H
#define HD_CAGES_H

#include "base/archive.h"
#include "hdlyap/trajectory.h"

/** Only cages.c uses the members. */
typedef struct hd_cages {
    size_t count;        /**< of coordinates */
    double *start, *now; /**< [count], positions as the averaging began; workspace */
    double begin, end;   /**< simulated times of the start and of the last look */
    bool left;           /**< true once a tenth of them was seen to have left */
} hd_cages;

/** Fails with HD_NO_MEMORY. It does not raise the peak of memory: the start of a trajectory has
 * given back at least as much before. */
HD_MUST_CHECK hd_status hd_cages_create(hd_cages *cages, const hd_scene_def *scene);
void hd_cages_clear(hd_cages *cages);

/** Begins again with the present positions. */
void hd_cages_begin(hd_cages *cages, const hd_trajectory *trajectory);
/** Looks whether a tenth of the particles has left. O(N), until it has. */
void hd_cages_look(hd_cages *cages, const hd_trajectory *trajectory, const hd_scene_def *scene);
/** True if the particles have kept their places for at least the time `least`; false while that is
 * not known. */
bool hd_cages_hold(const hd_cages *cages, double least);

void hd_cages_archive(hd_cages *cages, const hd_trajectory *trajectory, hd_archive *archive);

#endif
