/** A change of a parameter: its new value and the time from which on it holds. */
#ifndef HDLYAP_CHANGE_H
#define HDLYAP_CHANGE_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"

typedef struct change {
    const char *name;                     /**< parameter; the text is its row's */
    double time;                          /**< simulated time from which on the value holds */
    char before[HD_TEXT], value[HD_TEXT]; /**< value before this time, and after it */
} change;

/** Reads name and value from "NAME=VALUE". Returns false, with one line in message (the text, and
 * what is wrong), if no live parameter has this name or its row does not allow the value. */
bool change_parse(change *out, const char *assignment, char *message, size_t size);

/** Reads the time, too, from "TIME NAME=VALUE". */
bool change_parse_timed(change *out, const char *text, char *message, size_t size);

/** Writes the line of a refused text. Always returns false. */
bool change_refuse(char *message, size_t size, const char *what, const char *why);

#endif
