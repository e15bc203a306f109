/** Private parameters: one snapshot of all of them, read strictly by type. */
#ifndef HDLYAP_ROS_PARAMS_H
#define HDLYAP_ROS_PARAMS_H

#include <stdbool.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hdr_params hdr_params;

/** Fetches all private parameters of the node with one call to the master.
 * Fails with HDR_FAULT if the master does not answer, or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_params_create(hdr_params **out, const hdr_node *node);
/** The same from a YAML file, without a master; each of replaced[count] is name:=value and comes
 * instead of what the file says. HDR_FAULT with a line in hdr_error_text, or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_params_read(hdr_params **out, const char *path, int count,
                                          char *const *replaced);
void hdr_params_free(hdr_params *params);

int hdr_params_count(const hdr_params *params);
/** Name of parameter k, 0 .. count - 1, in alphabetic order; NULL otherwise. */
const char *hdr_params_name(const hdr_params *params, int k);
/** The first one whose name is not in the list `known`, which ends with NULL; NULL if all are. */
const char *hdr_params_unknown(const hdr_params *params, const char *const *known);
/** The value for a message to the user; "" if there is none. */
const char *hdr_param_text(const hdr_params *params, const char *name);

/* All of these: HDR_OK; HDR_MISSING or HDR_WRONG_TYPE, which leave *out as it was.
 * What they return points into params. */

hdr_status hdr_param_bool(const hdr_params *params, const char *name, bool *out);
hdr_status hdr_param_int(const hdr_params *params, const char *name, int *out);
/** Takes an integer, and a string that is a number from end to end: 1e-6 is a string in YAML 1.1.
 */
hdr_status hdr_param_double(const hdr_params *params, const char *name, double *out);
hdr_status hdr_param_string(const hdr_params *params, const char *name, const char **out);
hdr_status hdr_param_string_list(const hdr_params *params, const char *name,
                                 const char *const **out, int *count);
hdr_status hdr_param_int_list(const hdr_params *params, const char *name, const int **out,
                              int *count);

#ifdef __cplusplus
}
#endif
#endif
