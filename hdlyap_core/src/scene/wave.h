/** Functions on waves that only the core calls. */
#ifndef HD_WAVE_H
#define HD_WAVE_H

#include "hdlyap/wave.h"

hd_wave_limits hd_wave_limits_of(const hd_scene_def *def);

#endif
