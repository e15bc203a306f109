/** One parameter on its way in: its value by kind, or the line that refuses it. */
#ifndef HDLYAP_READER_H
#define HDLYAP_READER_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap_ros/params.h"
#include "parameters.h"

typedef struct reader {
    const hdr_params *params;
    const char *name;
    char *message;
    size_t size;
} reader;

/** Writes the line: the parameter, its value, what is allowed. Always false. */
bool reader_refuse(const reader *r, const char *allowed);

/** With question marks in place of line ends and other control characters. */
void make_one_line(char *text);

/** Without them. */
bool is_one_line(const char *text);

/** Into the variable at field (for one of the scene: the whole of it), which stays as it is where
 * the parameter is missing. Ranges of numbers are not looked at. False if refused. */
bool reader_read(const reader *r, const parameter *p, void *field);

#endif
