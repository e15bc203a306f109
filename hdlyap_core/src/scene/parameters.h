/** Functions on parameters that only the core calls. */
#ifndef HD_PARAMETERS_H
#define HD_PARAMETERS_H

#include "hdlyap/parameters.h"

/** Row k of a scene's parameters: first those that every scene has, then those of its dynamics;
 * NULL after the last one. */
const hd_parameter *hd_parameter_of(const hd_scene_def *def, int k);

/** Writes the value as a user writes it, and returns text; a set is written as its number. */
const char *hd_parameter_say(const hd_parameter *row, const hd_scene_def *def, char *text,
                             size_t size);

/** True if both scenes have the same value. */
bool hd_parameter_same(const hd_parameter *row, const hd_scene_def *a, const hd_scene_def *b);

#endif
