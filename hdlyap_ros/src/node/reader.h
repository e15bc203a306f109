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

/** As reader_refuse, with these words in place of "must be" and what is allowed. */
bool reader_refuse_as(const reader *r, const char *why);

/** Replaces line ends and other control characters by question marks. */
void make_one_line(char *text);

/** Without them. */
bool is_one_line(const char *text);

/** Reads a parameter into the variable at `field` (for a parameter of the scene: the scene), which
 * stays as it is if the parameter is missing. Does not check ranges. False if refused. */
bool reader_read(const reader *r, const parameter *p, void *field);

#endif
