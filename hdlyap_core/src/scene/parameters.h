/** What the core does with parameters. */
#ifndef HD_PARAMETERS_H
#define HD_PARAMETERS_H

#include "hdlyap/parameters.h"

/** Row k of all that a scene has: those of every scene, then those of its dynamics; NULL behind the
 * last one. */
const hd_parameter *hd_parameter_of(const hd_scene_def *def, int k);

/** Its value in words, as a user says it; returns text. Of a set, and of a number, the number. */
const char *hd_parameter_say(const hd_parameter *row, const hd_scene_def *def, char *text,
                             size_t size);

/** True if both scenes have the same value. */
bool hd_parameter_same(const hd_parameter *row, const hd_scene_def *a, const hd_scene_def *b);

#endif
