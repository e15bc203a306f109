/** Modes, steps, phases and structure factors in a checkpoint, and the bytes that they take. */
#ifndef HD_MODES_ARCHIVED_H
#define HD_MODES_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/phases.h"
#include "hdlyap/structure.h"

/** The size of a scene's fields; computing it allocates nothing. */
typedef struct hd_fields_count {
    /** Number of columns without the null fields; number of T and LP subspaces. */
    double columns, subspaces;
    double lp_phases, t_phases;
} hd_fields_count;
hd_fields_count hd_fields_count_of(const hd_scene_def *scene);

double hd_modes_bytes(const hd_scene_def *scene, double vectors);
double hd_steps_bytes(const hd_scene_def *scene);
double hd_structure_bytes(const hd_scene_def *scene, double vectors);
double hd_phases_bytes(double phases);
double hd_pmode_bytes(const hd_scene_def *def);

void hd_fields_archive(hd_fields *fields, hd_archive *archive);
void hd_modes_archive(hd_modes *modes, hd_archive *archive);
void hd_steps_archive(hd_steps *steps, hd_archive *archive);
/** `now`: simulated time of the run. */
void hd_phases_archive(hd_phases *phases, hd_archive *archive, double now);
void hd_structure_archive(hd_structure *structure, hd_archive *archive);

#endif
