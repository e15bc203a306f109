/** Bytes -> a set of parameters: known names with the kind of value that they take, and anything
 * else. */
#include "fake_params.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hdlyap_ros/node.h"
#include "node/given.h"
#include "node/parameters.h"

enum { PARAMS_MAX = 12, TEXT_MAX = 200, ITEMS_MAX = 6 };

typedef enum kind { BOOLEAN, INTEGER, REAL, STRING, STRINGS, INTEGERS, OTHER, KINDS } kind;

typedef struct entry {
    char name[TEXT_MAX], text[TEXT_MAX];
    kind type;
    bool flag;
    int integer;
    double real;
    char item[ITEMS_MAX][TEXT_MAX];
    const char *items[ITEMS_MAX];
    int integers[ITEMS_MAX];
    int count;
} entry;

struct hdr_params {
    entry entries[PARAMS_MAX];
    int count;
    bool has_file; /* whether a scene's file says the same */
};

/* ---- bytes --------------------------------------------------------------------------------- */

typedef struct source {
    const uint8_t *next, *end;
} source;

/** 0 where there are no more. */
static unsigned take(source *s) { return s->next < s->end ? *s->next++ : 0; }

static unsigned one_of(source *s, size_t count) { return take(s) % (unsigned)count; }

static uint64_t take_bits(source *s)
{
    uint64_t all = 0;
    for (int k = 0; k < 8; k++) all = all << 8 | take(s);
    return all;
}

/** A text of any bytes, up to the next 0. */
static void take_text(source *s, char text[TEXT_MAX])
{
    const unsigned length = take(s) % TEXT_MAX;
    unsigned k = 0;
    while (k < length && (text[k] = (char)take(s)) != '\0') k++;
    text[k] = '\0';
}

/* ---- values -------------------------------------------------------------------------------- */

static const char *const WORDS[] = {
    "periodic",  "reflecting", "positive",  "all",    "none",     "auto",     "steps",
    "run_info",  "spectrum",   "modes",     "fields", "hydro",    "state",    "status",
    "cost",      "lp_phases",  "covariant", "",       "0",        "-1",       "1e-6",
    "nan",       "inf",        "0x10",      "1e999",  "true",     "[1]",      "a\nb",
    "%s%n",      "../../x",    "\x1b[2J",   " 1",     "\xff\xfe", "1 pace=2", "1e3 duration=5",
    "-1 pace=2", "2 number=5", "2 pace=",
};
static const int INTEGERS_AT[] = {0,    1,    2,       3,  10,      37,     100,
                                  1024, 1025, 1000000, -1, INT_MAX, INT_MIN};
static const double REALS_AT[] = {0.0,  -0.0, 0.5,     1.0, 2.0,      100.0,     1e-6,   1e12,
                                  -1.0, 1e13, DBL_MAX, NAN, INFINITY, -INFINITY, DBL_MIN};
#define COUNT(array) (sizeof(array) / sizeof *(array))

static void word(source *s, char text[TEXT_MAX])
{
    const unsigned k = one_of(s, COUNT(WORDS) + 1);
    if (k < COUNT(WORDS))
        strcpy(text, WORDS[k]);
    else
        take_text(s, text);
}

static int integer(source *s)
{
    const unsigned k = one_of(s, COUNT(INTEGERS_AT) + 1);
    return k < COUNT(INTEGERS_AT) ? INTEGERS_AT[k] : (int)(take_bits(s) & INT_MAX);
}

static double real(source *s)
{
    const unsigned k = one_of(s, COUNT(REALS_AT) + 1);
    if (k < COUNT(REALS_AT)) return REALS_AT[k];
    const uint64_t bits = take_bits(s);
    double any;
    memcpy(&any, &bits, sizeof any);
    return any;
}

static kind kind_of(const parameter *p)
{
    if (p->kind == TOPICS_OBSERVED || p->kind == TOPICS_AWAITED || p->kind == CHANGES)
        return STRINGS;
    if (p->kind == REAL_NUMBER || (p->row && p->row->kind == HD_PARAMETER_REAL)) return REAL;
    if (p->kind == WHOLE_NUMBER) return INTEGER;
    return p->row && p->row->kind == HD_PARAMETER_INT ? INTEGER : STRING;
}

/** The default; of a list its first item, or one that it could have. */
static void value_usual(entry *e, const parameter *p)
{
    char usual[PARAMETER_TEXT];
    parameter_usual(usual, p);
    e->type = kind_of(p);
    e->integer = atoi(usual);
    e->real = atof(usual);
    e->count = 1;
    strcpy(e->text, usual);
    const char *item = p->kind == CHANGES ? "1 pace=2" : *usual ? usual : "run_info";
    snprintf(e->item[0], TEXT_MAX, "%.*s", (int)strcspn(usual, ","), item);
}

static void value_any(entry *e, source *s)
{
    e->type = (kind)one_of(s, KINDS);
    e->flag = take(s) & 1;
    e->integer = integer(s);
    e->real = real(s);
    e->count = (int)one_of(s, ITEMS_MAX + 1);
    for (int k = 0; k < e->count; k++) {
        e->integers[k] = integer(s);
        word(s, e->item[k]);
    }
    word(s, e->text);
}

/** As a message shows it; of a list its first item is enough. */
static void value_write(entry *e)
{
    char text[TEXT_MAX];
    for (int k = 0; k < e->count; k++) e->items[k] = e->item[k];
    if (e->type == STRING) return;
    strcpy(text, e->count > 0 ? e->item[0] : "");
    if (e->type == BOOLEAN) snprintf(e->text, sizeof e->text, "%d", e->flag);
    if (e->type == INTEGER) snprintf(e->text, sizeof e->text, "%d", e->integer);
    if (e->type == REAL) snprintf(e->text, sizeof e->text, "%g", e->real);
    if (e->type == STRINGS) snprintf(e->text, sizeof e->text, "[%.190s]", text);
    if (e->type == INTEGERS) snprintf(e->text, sizeof e->text, "[%d]", e->integers[0]);
}

static const entry *find(const hdr_params *params, const char *name)
{
    for (int k = 0; k < params->count; k++)
        if (strcmp(params->entries[k].name, name) == 0) return &params->entries[k];
    return NULL;
}

/** Most names are known, most values of known names usual; a name that is there already is not
 * added. */
static void add(hdr_params *params, source *s)
{
    entry *e = &params->entries[params->count];
    const unsigned which = take(s);
    const parameter p = parameters_at((int)(which % (unsigned)parameters_count()));
    memset(e, 0, sizeof *e);
    if (which >= 250)
        word(s, e->name);
    else
        strcpy(e->name, p.name);
    if (which < 250 && take(s) % 8 < 6)
        value_usual(e, &p);
    else
        value_any(e, s);
    value_write(e);
    params->count += !find(params, e->name);
}

hdr_params *fake_params_create(const uint8_t *bytes, size_t size)
{
    source s = {bytes, bytes + size};
    hdr_params *params = calloc(1, sizeof *params);
    if (params) params->has_file = take(&s) % 2;
    while (params && s.next < s.end && params->count < PARAMS_MAX) add(params, &s);
    return params;
}

void hdr_params_free(hdr_params *params) { free(params); }

/** A line shows the first hundred characters of a name, and '?' for one that would end or move it.
 */
static bool begins_with(const char *line, const char *name)
{
    size_t k = 0;
    for (; name[k] && k < 100; k++) {
        const bool control = (unsigned char)name[k] < ' ' || name[k] == 0x7f;
        if (line[k] != (control ? '?' : name[k])) return false;
    }
    return strncmp(line + k, " = ", 3) == 0;
}

bool fake_params_is_about(const hdr_params *params, const char *line)
{
    for (int k = 0; k < parameters_count(); k++)
        if (begins_with(line, parameters_at(k).name)) return true;
    for (int k = 0; k < params->count; k++)
        if (begins_with(line, params->entries[k].name)) return true;
    return false;
}

/* ---- as params.h says ---------------------------------------------------------------------- */

int hdr_params_count(const hdr_params *params) { return params->count; }

const hdr_params *hdr_params_file(const hdr_params *params, const char **path)
{
    *path = params->has_file ? "scene.yaml" : "";
    return params->has_file ? params : NULL;
}

const char *hdr_params_name(const hdr_params *params, int k)
{
    return k >= 0 && k < params->count ? params->entries[k].name : NULL;
}

const char *hdr_param_text(const hdr_params *params, const char *name)
{
    const entry *e = find(params, name);
    return e ? e->text : "";
}

/** The entry if it has the type, and what to return. */
static const entry *typed(const hdr_params *params, const char *name, kind type, hdr_status *status)
{
    const entry *e = find(params, name);
    *status = !e ? HDR_MISSING : e->type != type ? HDR_WRONG_TYPE : HDR_OK;
    return *status == HDR_OK ? e : NULL;
}

hdr_status hdr_param_bool(const hdr_params *params, const char *name, bool *out)
{
    hdr_status status;
    const entry *e = typed(params, name, BOOLEAN, &status);
    if (e) *out = e->flag;
    return status;
}

hdr_status hdr_param_int(const hdr_params *params, const char *name, int *out)
{
    hdr_status status;
    const entry *e = typed(params, name, INTEGER, &status);
    if (e) *out = e->integer;
    return status;
}

hdr_status hdr_param_double(const hdr_params *params, const char *name, double *out)
{
    const entry *e = find(params, name);
    char *end = NULL;
    if (!e) return HDR_MISSING;
    if (e->type == REAL) return *out = e->real, HDR_OK;
    if (e->type == INTEGER) return *out = e->integer, HDR_OK;
    const double number = strtod(e->text, &end);
    if (e->type != STRING || !*e->text || *end) return HDR_WRONG_TYPE;
    return *out = number, HDR_OK;
}

hdr_status hdr_param_string(const hdr_params *params, const char *name, const char **out)
{
    hdr_status status;
    const entry *e = typed(params, name, STRING, &status);
    if (e) *out = e->text;
    return status;
}

/** A list without items is of any type. */
static const entry *list(const hdr_params *params, const char *name, kind type, hdr_status *status)
{
    const entry *e = find(params, name);
    const bool empty = e && (e->type == STRINGS || e->type == INTEGERS) && e->count == 0;
    return empty ? *status = HDR_OK, e : typed(params, name, type, status);
}

hdr_status hdr_param_string_list(const hdr_params *params, const char *name,
                                 const char *const **out, int *count)
{
    hdr_status status;
    const entry *e = list(params, name, STRINGS, &status);
    if (e) *out = e->items, *count = e->count;
    return status;
}

hdr_status hdr_param_int_list(const hdr_params *params, const char *name, const int **out,
                              int *count)
{
    hdr_status status;
    const entry *e = list(params, name, INTEGERS, &status);
    if (e) *out = e->integers, *count = e->count;
    return status;
}

/* There is no scene's file from which a parameter could differ. */
bool given_is_changed(const hdr_params *params, const char *name)
{
    (void)params, (void)name;
    return false;
}

bool given_is_of_file(const hdr_params *params, const char *name)
{
    (void)params, (void)name;
    return false;
}

void hdr_log(hdr_level level, const char *format, ...) { (void)level, (void)format; }
