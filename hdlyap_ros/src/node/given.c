/** Parameters as given -> lines of the log: what lingers on the server from an earlier launch
 * changes a run, and would otherwise be seen in ~run_info only. */
#include "given.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "parameters.h"
#include "particles.h"

typedef enum source { ARGUMENT, SERVER, NOWHERE, SCENE_FILE, SOURCES } source;
static const char *const source_text[SOURCES] = {"from the arguments, unlike",
                                                 "from the parameter server, unlike",
                                                 "from the defaults, unlike", "the rest is of"};

enum { LINE = 600, ITEM = 160 }; /* letters */

/** Parameters, and what they are compared with. */
typedef struct comparison {
    const hdr_params *params;
    const hdr_params *file; /**< NULL: the defaults */
    const hd_scene_def *def;
    const char *name; /**< of what they are compared with */
} comparison;

/** A text without the brackets of a list. */
static const char *bare(const char *text, size_t *length)
{
    const bool is_list = *text == '[';
    *length = strlen(text) - (is_list ? 2 : 0);
    return text + is_list;
}

/** Whether two texts are the same number, list or word. */
static bool is_same(const char *one, const char *other)
{
    char *end, *other_end;
    size_t length, other_length;
    const double number = strtod(one, &end), other_number = strtod(other, &other_end);
    if (end != one && other_end != other && !*end && !*other_end) return number == other_number;
    one = bare(one, &length);
    other = bare(other, &other_length);
    return length == other_length && strncmp(one, other, length) == 0;
}

static source source_of(const hdr_params *params, const char *name)
{
    if (!*hdr_param_text(params, name)) return NOWHERE;
    return hdr_param_is_argument(params, name) ? ARGUMENT : SERVER;
}

/** Whether a parameter of the scene has the value of the scene's file, which is not its default. */
static bool is_of_file(const comparison *c, const parameter *p)
{
    return p->kind == OF_SCENE && c->file && *hdr_param_text(c->file, p->name) &&
           is_same(hdr_param_text(c->params, p->name), hdr_param_text(c->file, p->name)) &&
           hd_parameter_value(p->row, c->def) != p->row->default_value;
}

/** Writes the parameter if it comes from there and, unless it is of the scene's file, differs; else
 * leaves the text empty. */
static void write_item(char item[ITEM], const comparison *c, const parameter *p, source from)
{
    char usual[PARAMETER_TEXT];
    const char *wanted = c->file ? hdr_param_text(c->file, p->name) : "";
    const char *value = hdr_param_text(c->params, p->name);
    const bool of_file = from == SCENE_FILE;
    *item = '\0';
    if (p->kind == NAME || (of_file && !is_of_file(c, p))) return;
    if (!of_file && source_of(c->params, p->name) != from) return;
    parameter_usual(usual, p);
    if (!*wanted) wanted = usual;
    if (!*value) value = usual;
    if (of_file || !is_same(value, wanted)) snprintf(item, ITEM, "%.50s = %.100s", p->name, value);
}

bool given_is_changed(const hdr_params *params, const char *name)
{
    comparison c = {.params = params};
    char item[ITEM];
    c.file = hdr_params_file(params, &c.name);
    if (!c.file) return false;
    const parameter p = parameters_named(name);
    write_item(item, &c, &p, source_of(params, name));
    return *item;
}

bool given_is_of_file(const hdr_params *params, const char *name)
{
    const char *path;
    const hdr_params *file = hdr_params_file(params, &path);
    return file && *hdr_param_text(file, name) && !given_is_changed(params, name);
}

/** Logs all parameters that come from there and differ, in as few lines as hold them. Returns
 * whether there are any. */
static bool log_all(const comparison *c, source from)
{
    char line[LINE + ITEM] = "", item[ITEM];
    bool any = false;
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        const size_t length = strlen(line);
        write_item(item, c, &p, from);
        if (*item) snprintf(line + length, sizeof line - length, "%s%s", length ? ", " : "", item);
        const bool is_whole = strlen(line) >= LINE - 2 || k + 1 == parameters_count();
        if (!*line || !is_whole) continue;
        hdr_log(HDR_INFO, "%s %.200s: %s", source_text[from], c->name, line);
        *line = '\0';
        any = true;
    }
    return any;
}

/** Whether these or other particles have a parameter of this name. */
static bool is_parameter(const char *name)
{
    const hd_dynamics *of;
    for (int r = 0; (of = particles_at(r)); r++)
        for (int k = 0; k < of->parameters; k++)
            if (strcmp(of->parameter[k].name, name) == 0) return true;
    return parameters_has(name);
}

void given_log(const settings *set, bool is_resumed)
{
    comparison c = {.params = set->given, .def = &set->def};
    c.file = hdr_params_file(c.params, &c.name);
    if (!c.file) c.name = "the defaults";
    if (log_all(&c, ARGUMENT)) log_all(&c, SCENE_FILE);
    log_all(&c, SERVER);
    if (!is_resumed) log_all(&c, NOWHERE);
    hdr_params_warn_of_renaming(c.params, is_parameter);
}
