/** What the core does with rows of dynamics. Other parts of the core know rows alone; only the
 * dynamics knows what its state, entries and maps hold. To add one takes a folder with its row, a
 * name in the table of scene/dynamics.c, a test, and words for users. */
#ifndef HD_DYNAMICS_H
#define HD_DYNAMICS_H

#include "base/archive.h"
#include "dynamics/record.h"
#include "hdlyap/dynamics.h"

/** Most columns that a thread carries at once, and most bytes that they take in its cache. */
enum { HD_BLOCK_BYTES = 512 * 1024, HD_BLOCK_WIDTH_MAX = 64 };

/* What the row says, or what is usual if the row leaves it out. */

HD_MUST_CHECK hd_status hd_maps_create_of(void **maps, const hd_scene_def *scene);
void hd_maps_free_of(const hd_dynamics *of, void *maps);
/** See hd_dynamics.maps_fill; valid as long as the record does not change. */
HD_MUST_CHECK hd_status hd_maps_fill_of(const hd_dynamics *of, void *maps, const hd_record *record,
                                        double t_begin, double t_end);

/** Vectors for which hd_dynamics.null_vectors has room beyond its zero exponents, so that one
 * vector too many is a status instead of an overflow. */
enum { HD_NULL_SPARE = 8 };
/** Fills column[zero exponents + HD_NULL_SPARE][..] with the null vectors that the row knows, none
 * if it has no function for them, and writes their number. Fails with HD_DYNAMICS_FAULT if there
 * are more than exponents that vanish. */
HD_MUST_CHECK hd_status hd_null_vectors_of(int *count, const hd_scene_def *scene, const double *q,
                                           const double *p, double *column);

/** Checks that a record is valid for the scene; NULL, or what is wrong with it. */
const char *hd_record_fault(const hd_record *record, const hd_scene_def *scene);
void hd_record_archive(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
/** Bytes of this many entries in the record, which doubles when it is full, and of their maps. */
double hd_record_bytes_of(const hd_scene_def *scene, double entries);

/** Numbers that a trajectory notes of its present state, because its row leaves something out. */
double hd_trajectory_noted(const hd_scene_def *scene);
/** Bytes of the particles of a scene. */
double hd_trajectory_bytes(const hd_scene_def *scene);

#endif
