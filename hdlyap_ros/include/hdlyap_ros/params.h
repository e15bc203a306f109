/** The private ROS parameters of the node, as a copy of all, from which values are read by their
 * exact type. */
#ifndef HDLYAP_ROS_PARAMS_H
#define HDLYAP_ROS_PARAMS_H

#include <stdbool.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A copy of parameters. Whoever creates it frees it; texts and lists that are read from it last as
 * long as the copy. */
typedef struct hdr_params hdr_params;

/** Copies all private parameters of the node, with one call to the master. What run.launch was
 * given comes as texts below ~launch: ~launch/usual, lines NAME:=VALUE of defaults; ~launch/scene,
 * a YAML file, and ~launch/file, its path; ~launch/params, YAML; and ~launch/arguments, lines. Each
 * overrides those before it, and other parameters on the server override all. In their place the
 * parameters that they give are written to the server. Returns HDR_OK; HDR_FAULT with a line in
 * hdr_error_text, if the master does not answer, a text cannot be read, or params and arguments
 * give a parameter two values; or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_params_create(hdr_params **out, const hdr_node *node);
/** Makes a copy from the YAML file `path`, without a master. Each of replaced[count] is NAME:=VALUE
 * and replaces the value in the file. Returns HDR_OK; HDR_FAULT with a line in hdr_error_text; or
 * HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_params_read(hdr_params **out, const char *path, int count,
                                          char *const *replaced);
/** Frees a copy; params may be NULL. */
void hdr_params_free(hdr_params *params);

/** Number of parameters. */
int hdr_params_count(const hdr_params *params);
/** Name of parameter k, 0 .. count - 1, in alphabetic order; NULL for other k. */
const char *hdr_params_name(const hdr_params *params, int k);
/** Name of the first parameter that is not in the list `known`, whose end is a NULL; NULL if all
 * are in it. */
const char *hdr_params_unknown(const hdr_params *params, const char *const *known);
/** Value of a parameter as a text for the user; "" if there is no such parameter. */
const char *hdr_param_text(const hdr_params *params, const char *name);

/** What the scene's file of run.launch says, or usual otherwise, and its path; NULL and "" without
 * a file. */
const hdr_params *hdr_params_file(const hdr_params *params, const char **path);
/** Whether the parameter was set by an argument of the program, _NAME:=VALUE, or of run.launch;
 * false if the copy is of a file. */
bool hdr_param_is_argument(const hdr_params *params, const char *name);
/** Warns in the log of each argument NAME:=VALUE for which is_parameter(NAME): it renames a topic
 * or a service, and _NAME:=VALUE is meant. */
void hdr_params_warn_of_renaming(const hdr_params *params, bool (*is_parameter)(const char *name));

/* These functions write a private parameter of the node to the master's server, from another thread
 * and as soon as the master answers; of several values of a parameter the last one. */

void hdr_param_write_double(hdr_node *node, const char *name, double value);
void hdr_param_write_string(hdr_node *node, const char *name, const char *value);

/* Each of these functions writes the value of a parameter to *out and returns HDR_OK. Or it returns
 * HDR_MISSING if there is no such parameter, or HDR_WRONG_TYPE if it has another type, and leaves
 * *out as it was. */

hdr_status hdr_param_bool(const hdr_params *params, const char *name, bool *out);
hdr_status hdr_param_int(const hdr_params *params, const char *name, int *out);
/** Also accepts an integer, and a string that is a number from end to end, because YAML 1.1 takes
 * 1e-6 for a string. */
hdr_status hdr_param_double(const hdr_params *params, const char *name, double *out);
hdr_status hdr_param_string(const hdr_params *params, const char *name, const char **out);
/** Writes a list and its length to *out and *count. */
hdr_status hdr_param_string_list(const hdr_params *params, const char *name,
                                 const char *const **out, int *count);
hdr_status hdr_param_int_list(const hdr_params *params, const char *name, const int **out,
                              int *count);

#ifdef __cplusplus
}
#endif
#endif
