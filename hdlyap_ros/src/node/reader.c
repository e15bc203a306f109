/** One parameter -> its value by type, or the line that refuses it. */
#include "reader.h"

#include <stdio.h>

static bool is_control(char c) { return (unsigned char)c < ' ' || c == 0x7f; }

bool is_one_line(const char *text)
{
    while (*text && !is_control(*text)) text++;
    return !*text;
}

/** In one line whatever it shows: names and values are anybody's, and may hold line ends. */
bool reader_refuse(const reader *r, const char *allowed)
{
    if (r->size == 0) return false;
    snprintf(r->message, r->size, "%.100s = %.150s: must be %s", r->name,
             hdr_param_text(r->params, r->name), allowed);
    for (char *c = r->message; *c; c++)
        if (is_control(*c)) *c = '?';
    return false;
}

bool reader_accepts(const reader *r, hdr_status status, const char *allowed)
{
    return status == HDR_OK || status == HDR_MISSING || reader_refuse(r, allowed);
}

bool read_int(const reader *r, void *field)
{
    return reader_accepts(r, hdr_param_int(r->params, r->name, field), "an integer");
}

bool read_double(const reader *r, void *field)
{
    return reader_accepts(r, hdr_param_double(r->params, r->name, field), "a number");
}
