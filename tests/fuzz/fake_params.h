/** Private parameters without ROS: the functions of hdlyap_ros/params.h over sets that are made of
 * bytes. The same bytes give the same set, so a test draws them and a fuzzer searches them. */
#ifndef HDLYAP_FAKE_PARAMS_H
#define HDLYAP_FAKE_PARAMS_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap_ros/params.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Any bytes are good; few bytes are few parameters. NULL when out of memory. */
hdr_params *fake_params_create(const uint8_t *bytes, size_t size);

/** True if a line is about this name: as given, or of the node's own. */
bool fake_params_is_about(const hdr_params *params, const char *line);

#ifdef __cplusplus
}
#endif
#endif
