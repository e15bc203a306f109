/** What settings_read promises of every set of parameters. */
#ifndef HDLYAP_SETTINGS_FAULT_H
#define HDLYAP_SETTINGS_FAULT_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap_ros/params.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SETTINGS_ROOM_MAX = 512 };

/** What is wrong with what settings_read makes of the parameters, with `room` (1 ..
 * SETTINGS_ROOM_MAX) bytes for its line; NULL if nothing is. resumed: what is not given is as in a
 * checkpoint. line: the line of a set that is refused, "" of one that is accepted. */
const char *settings_fault(const hdr_params *params, bool resumed, size_t room,
                           char line[SETTINGS_ROOM_MAX]);

#ifdef __cplusplus
}
#endif
#endif
