/** What the core does with rows of dynamics. Who stands behind the dynamics knows rows alone; what
 * a row's state, entries and maps hold is its own. To add one is a folder with its row, a name in
 * the table of scene/dynamics.c, a test, and words for users. */
#ifndef HD_DYNAMICS_H
#define HD_DYNAMICS_H

#include "base/archive.h"
#include "dynamics/record.h"
#include "hdlyap/dynamics.h"

/** Columns that a thread carries at once, and their bytes in its cache. */
enum { HD_BLOCK_BYTES = 512 * 1024, HD_BLOCK_WIDTH_MAX = 64 };

/* As the row says, or what is usual where it leaves that out. */

HD_MUST_CHECK hd_status hd_maps_create_of(const hd_dynamics *of, void **maps, int particles);
void hd_maps_free_of(const hd_dynamics *of, void *maps);
/** See hd_dynamics.maps_fill; valid as long as the record does not change. */
HD_MUST_CHECK hd_status hd_maps_fill_of(const hd_dynamics *of, void *maps, const hd_record *record,
                                        double t_begin, double t_end);

/** NULL, or what is wrong with it, whoever wrote it. */
const char *hd_record_fault(const hd_record *record, const hd_scene_def *scene);
void hd_record_archive(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
/** Of so many entries: in the record, which doubles when it is full, and as maps. */
double hd_record_bytes_of(const hd_scene_def *scene, double entries);

/** Of the particles of a scene. */
double hd_trajectory_bytes(const hd_scene_def *scene);

#endif
