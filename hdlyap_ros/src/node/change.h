/** A parameter with another value from some time on, as text has it. */
#ifndef HDLYAP_CHANGE_H
#define HDLYAP_CHANGE_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"

typedef struct change {
    const char *name;                     /**< of the parameter's row */
    double time;                          /**< simulated, from which on it holds */
    char before[HD_TEXT], value[HD_TEXT]; /**< until then, and since */
} change;

/** "NAME=VALUE" -> name and value, which the row allows. False if that is no change of a live
 * parameter, with one line: what was asked for, and why not. */
bool change_parse(change *out, const char *assignment, char *message, size_t size);

/** "TIME NAME=VALUE" -> the time, too. */
bool change_parse_timed(change *out, const char *text, char *message, size_t size);

/** Writes such a line. Always false. */
bool change_refuse(char *message, size_t size, const char *what, const char *why);

#endif
