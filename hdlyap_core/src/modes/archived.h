/** What a checkpoint holds of modes, steps, phases and structure factors. */
#ifndef HD_MODES_ARCHIVED_H
#define HD_MODES_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/phases.h"
#include "hdlyap/structure.h"

void hd_modes_archive(hd_modes *modes, hd_archive *archive);
void hd_steps_archive(hd_steps *steps, hd_archive *archive);
void hd_phases_archive(hd_phases *phases, hd_archive *archive);
void hd_structure_archive(hd_structure *structure, hd_archive *archive);

#endif
