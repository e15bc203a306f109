/** The private parameters of the node: a copy of all, which are read by their exact type. */
#ifndef HDLYAP_ROS_PARAMS_H
#define HDLYAP_ROS_PARAMS_H

#include <stdbool.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hdr_params hdr_params;

/** Copies all private parameters of the node with one call to the master. HDR_FAULT if the master
 * does not answer; HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_params_create(hdr_params **out, const hdr_node *node);
/** Reads parameters from a YAML file, without a master. Each of replaced[count] is name:=value and
 * replaces the value in the file. HDR_FAULT with a line in hdr_error_text; HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_params_read(hdr_params **out, const char *path, int count,
                                          char *const *replaced);
void hdr_params_free(hdr_params *params);

int hdr_params_count(const hdr_params *params);
/** Name of parameter k, 0 .. count - 1, in alphabetic order; NULL otherwise. */
const char *hdr_params_name(const hdr_params *params, int k);
/** Name of the first parameter that is not in the list `known`, which ends with NULL; NULL if there
 * is none. */
const char *hdr_params_unknown(const hdr_params *params, const char *const *known);
/** The value as a text for the user; "" if there is no such parameter. */
const char *hdr_param_text(const hdr_params *params, const char *name);

/* All of these write the value to *out, or return HDR_MISSING or HDR_WRONG_TYPE and leave *out as
 * it was. Pointers point into params. */

hdr_status hdr_param_bool(const hdr_params *params, const char *name, bool *out);
hdr_status hdr_param_int(const hdr_params *params, const char *name, int *out);
/** Also accepts an integer, and a string that is a number from end to end, as YAML 1.1 reads 1e-6
 * as a string. */
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
