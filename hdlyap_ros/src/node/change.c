/** A text of the user -> a change of a parameter. */
#include "change.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/numbers.h"
#include "parameters.h"
#include "reader.h"

enum { NAME_MAX_LENGTH = 40 };

bool change_refuse(char *message, size_t size, const char *what, const char *why)
{
    snprintf(message, size, "%.150s: %s", what, why);
    make_one_line(message);
    return false;
}

/** Reads a value. A number must fill the text and be in the range of its row; texts are checked by
 * the core. */
static bool parse_value(char value[HD_TEXT], const char *text, const parameter *p)
{
    char *end;
    const double least = p->row ? p->row->min : p->min, most = p->row ? p->row->max : p->max;
    if (p->row && p->row->kind == HD_PARAMETER_TEXT)
        return snprintf(value, HD_TEXT, "%s", text + strspn(text, " ")) < HD_TEXT;
    const double number = strtod(text, &end);
    number_text(value, HD_TEXT, number);
    return end != text && !end[strspn(end, " ")] && number >= least && number <= most;
}

bool change_parse(change *out, const char *assignment, char *message, size_t size)
{
    char name[NAME_MAX_LENGTH] = "", why[200];
    const size_t length = strcspn(assignment, "= ");
    const char *sign = assignment + length + strspn(assignment + length, " ");
    if (length == 0 || *sign != '=' || strchr(sign + 1, '='))
        return change_refuse(message, size, assignment, "must be one NAME=VALUE, such as pace=1.5");
    snprintf(name, sizeof name, "%.*s", (int)length, assignment);
    if (!parameters_has(name)) {
        char unknown[PARAMETER_UNKNOWN];
        parameters_unknown(unknown, name);
        return change_refuse(message, size, assignment, unknown);
    }
    const parameter p = parameters_named(name);
    out->name = p.name;
    if (!p.live)
        return change_refuse(message, size, assignment, "is read at the start and cannot change");
    snprintf(why, sizeof why, "must be %s", p.range);
    return parse_value(out->value, sign + 1, &p) || change_refuse(message, size, assignment, why);
}

bool change_parse_timed(change *out, const char *text, char *message, size_t size)
{
    char *end;
    out->time = strtod(text, &end);
    if (end == text || *end != ' ' || !(out->time >= 0.0 && out->time < HUGE_VAL))
        return change_refuse(
            message, size, text,
            "must be a simulated time and NAME=VALUE, such as 120 report_interval=5");
    return change_parse(out, end + strspn(end, " "), message, size);
}
