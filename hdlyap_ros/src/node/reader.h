/** One parameter on its way in: its value by type, or the line that refuses it. */
#ifndef HDLYAP_READER_H
#define HDLYAP_READER_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap_ros/params.h"

typedef struct reader {
    const hdr_params *params;
    const char *name;
    char *message;
    size_t size;
} reader;

/** Writes the line: the parameter, its value, what is allowed. Always false. */
bool reader_refuse(const reader *r, const char *allowed);

/** Refused unless the value has been read, or is missing. */
bool reader_accepts(const reader *r, hdr_status status, const char *allowed);

/** Without line ends and other control characters. */
bool is_one_line(const char *text);

/* Into the variable at field, which stays as it is where the parameter is missing. False if
 * refused. */

bool read_int(const reader *r, void *field);
bool read_double(const reader *r, void *field);

#endif
