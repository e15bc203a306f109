/** Which parameters a run has that its user may not expect. */
#ifndef HDLYAP_GIVEN_H
#define HDLYAP_GIVEN_H

#include <stdbool.h>

#include "hdlyap_ros/params.h"
#include "node/settings.h"

/** Names each parameter that differs from the scene's file, if there is one, or else
 * from its default, with where it came from; if there are arguments among them, also what the file
 * sets of the scene; and warns of arguments that were meant to be
 * parameters. The scene's name is not among them. If the run is resumed, a parameter that was not
 * given is as in the checkpoint, and is not named. */
void given_log(const settings *set, bool is_resumed);

/** Whether a parameter has another value than in the scene's file; false without a file. */
bool given_is_changed(const hdr_params *params, const char *name);

/** Whether a parameter has the value that the scene's file gives it. */
bool given_is_of_file(const hdr_params *params, const char *name);

#endif
