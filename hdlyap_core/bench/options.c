/** argv -> the variables to which the program's list of options points. */
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static const option *find(const char *program, const char *name, const option *list)
{
    for (const option *o = list; o->name; o++)
        if (strcmp(o->name, name) == 0) return o;
    fprintf(stderr, "%s: %s: not known; the options are", program, name);
    for (const option *o = list; o->name; o++)
        fprintf(stderr, " %s%s", o->name, o->flag ? "" : " .");
    fprintf(stderr, "\n");
    exit(2);
}

static double number_of(const char *program, const option *o, const char *value)
{
    char *end;
    const double number = strtod(value, &end);
    const bool whole = !o->count || number == floor(number);
    if (end != value && *end == '\0' && number >= o->least && number <= o->most && whole)
        return number;
    fprintf(stderr, "%s: %s = %s: must be %s from %g to %g\n", program, o->name, value,
            o->count ? "a whole number" : "a number", o->least, o->most);
    exit(2);
}

void options_read(int argc, char **argv, const option *list)
{
    const char *program = base_name(argv[0]);
    for (int k = 1; k < argc; k++) {
        const option *o = find(program, argv[k], list);
        if (o->flag) {
            *o->flag = true;
            continue;
        }
        if (++k == argc) {
            fprintf(stderr, "%s: %s: needs a value\n", program, o->name);
            exit(2);
        }
        if (o->text) *o->text = argv[k];
        if (strcmp(o->name, "--out") == 0 && access(argv[k], W_OK | X_OK) != 0) {
            fprintf(stderr, "%s: --out = %s: must be a folder that can be written\n", program,
                    argv[k]);
            exit(2);
        }
        if (o->count) *o->count = (int)number_of(program, o, argv[k]);
        if (o->number) *o->number = number_of(program, o, argv[k]);
    }
}
