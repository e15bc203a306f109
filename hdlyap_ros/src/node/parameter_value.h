/** Settings -> the present values of parameters, as texts that a scene file has. */
#ifndef HDLYAP_PARAMETER_VALUE_H
#define HDLYAP_PARAMETER_VALUE_H

#include "hdlyap/scene.h"
#include "node/parameters.h"
#include "node/settings.h"

/** Room for a value that is no text of the settings. */
enum { PARAMETER_VALUE = 320 };

/** The value that was asked for; in the settings, or in the room. Numbers are exact to the last
 * bit.
 */
const char *parameter_value(char room[PARAMETER_VALUE], const parameter *p, const settings *set);

/** The value in effect in a run of this scene with these threads, where it is another one; else
 * `asked`. */
const char *parameter_effect(char room[PARAMETER_VALUE], const parameter *p,
                             const hd_scene_def *def, int threads, const char *asked);

#endif
