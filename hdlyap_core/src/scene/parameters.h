/** What the core does with parameters. */
#ifndef HD_PARAMETERS_H
#define HD_PARAMETERS_H

#include "hdlyap/parameters.h"

/** True if both scenes have the same value. */
bool hd_parameter_same(const hd_parameter *row, const hd_scene_def *a, const hd_scene_def *b);

#endif
