/** One parameter -> its value by kind, or the line that refuses it. */
#include "reader.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "particles.h"
#include "settings.h"
#include "topics/topic.h"

static bool is_control(char c) { return (unsigned char)c < ' ' || c == 0x7f; }

bool is_one_line(const char *text)
{
    while (*text && !is_control(*text)) text++;
    return !*text;
}

void make_one_line(char *text)
{
    for (; *text; text++)
        if (is_control(*text)) *text = '?';
}

/** Writes one line even if names and values hold line ends. */
bool reader_refuse_as(const reader *r, const char *why)
{
    if (r->size == 0) return false;
    snprintf(r->message, r->size, "%.100s = %.150s: %s", r->name,
             hdr_param_text(r->params, r->name), why);
    make_one_line(r->message);
    return false;
}

bool reader_refuse(const reader *r, const char *allowed)
{
    char why[1024];
    snprintf(why, sizeof why, "must be %s", allowed);
    return reader_refuse_as(r, why);
}

/** True if the value was read or is missing; else refuses the parameter. */
static bool accepts(const reader *r, hdr_status status, const char *allowed)
{
    return status == HDR_OK || status == HDR_MISSING || reader_refuse(r, allowed);
}

/** The parameter's text, if it is a string. */
static const char *text_of(const reader *r)
{
    const char *text = NULL;
    return hdr_param_string(r->params, r->name, &text) == HDR_OK ? text : NULL;
}

static bool is_word(const reader *r, const char *word)
{
    const char *text = text_of(r);
    return text && strcmp(text, word) == 0;
}

/** Reads a text of decimal digits and nothing else, at most `max`. */
static bool parse_unsigned(uint64_t *out, const char *text, uint64_t max)
{
    if (!*text || text[strspn(text, "0123456789")]) return false;
    errno = 0;
    const unsigned long long value = strtoull(text, NULL, 10);
    if (errno || value > max) return false;
    *out = value;
    return true;
}

/* ---- of the scene -------------------------------------------------------------------------- */

/** Refuses a seed that rosrun passed as a real number, because it was too long for an integer. */
static bool refuse_seed(const reader *r, const parameter *p)
{
    char allowed[PARAMETER_ALLOWED];
    double number = 0.0;
    const bool is_long = !text_of(r) && hdr_param_double(r->params, r->name, &number) == HDR_OK &&
                         number > INT32_MAX;
    snprintf(allowed, sizeof allowed, "%s%s", p->range,
             is_long ? "; with rosrun in two pairs of quotes, _seed:=\"'..'\"" : "");
    return reader_refuse(r, allowed);
}

/** Reads the seed, a string because integers have 32 bits on the parameter server; integers are
 * taken, too. */
static bool read_seed(const reader *r, const parameter *p, uint64_t *seed)
{
    int number;
    const char *text = hdr_param_text(r->params, r->name);
    const hdr_status as_string = hdr_param_string(r->params, r->name, &text);
    if (as_string == HDR_MISSING) return true;
    const bool typed = as_string == HDR_OK || hdr_param_int(r->params, r->name, &number) == HDR_OK;
    return (typed && parse_unsigned(seed, text, UINT64_MAX)) || refuse_seed(r, p);
}

/** Reads exponents: a word, a number, or a string of digits. */
static bool read_exponents(const reader *r, const parameter *p, int *exponents)
{
    uint64_t number = 0;
    const char *text = text_of(r);
    const hdr_status as_int = hdr_param_int(r->params, r->name, exponents);
    if (as_int == HDR_MISSING || (as_int == HDR_OK && *exponents > 0)) return true;
    if (!text) return reader_refuse(r, p->range);
    if (hd_parameter_value_of(exponents, p->row, text)) return true;
    if (!parse_unsigned(&number, text, INT32_MAX) || number == 0) return reader_refuse(r, p->range);
    *exponents = (int)number;
    return true;
}

static bool read_interval(const reader *r, const parameter *p, double *interval)
{
    int value;
    const char *text = text_of(r);
    if (text && hd_parameter_value_of(&value, p->row, text)) return *interval = value, true;
    const hdr_status status = hdr_param_double(r->params, r->name, interval);
    const bool number = status == HDR_OK && !hd_parameter_is_word(p->row, *interval);
    return status == HDR_MISSING || number || reader_refuse(r, p->range);
}

static bool read_word(const reader *r, const parameter *p, int *value)
{
    const char *text = NULL;
    const hdr_status status = hdr_param_string(r->params, r->name, &text);
    return status == HDR_MISSING ||
           (status == HDR_OK && hd_parameter_value_of(value, p->row, text)) ||
           reader_refuse(r, p->range);
}

static bool read_text(const reader *r, const parameter *p, hd_scene_def *def)
{
    const char *text = NULL;
    const hdr_status status = hdr_param_string(r->params, r->name, &text);
    return status == HDR_MISSING || (status == HDR_OK && hd_parameter_read(p->row, def, text)) ||
           reader_refuse(r, p->range);
}

static bool read_of_scene(const reader *r, const parameter *p, hd_scene_def *def)
{
    double real = hd_parameter_value(p->row, def);
    int whole = 0;
    bool read = true;
    switch (p->row->kind) {
    case HD_PARAMETER_SEED: return read_seed(r, p, &def->seed);
    case HD_PARAMETER_TEXT: return read_text(r, p, def);
    case HD_PARAMETER_INTERVAL: read = read_interval(r, p, &real); break;
    case HD_PARAMETER_REAL:
        read = accepts(r, hdr_param_double(r->params, r->name, &real), "a number");
        break;
    default:
        whole = (int)real;
        /* the usual ones follow from particles and walls, which have been read */
        if (p->row->kind == HD_PARAMETER_EXPONENTS && whole == HD_EXPONENTS_POSITIVE)
            whole = hd_scene_exponents_usual(def);
        read = p->row->kind == HD_PARAMETER_WORD ? read_word(r, p, &whole)
               : p->row->kind == HD_PARAMETER_EXPONENTS
                   ? read_exponents(r, p, &whole)
                   : accepts(r, hdr_param_int(r->params, r->name, &whole),
                             "an integer, without a point");
        real = whole;
    }
    hd_parameter_assign(p->row, def, real);
    return read;
}

static bool read_particles(const reader *r, const parameter *p, hd_scene_def *def)
{
    const char *name = NULL;
    char allowed[PARAMETER_ALLOWED];
    const hdr_status status = hdr_param_string(r->params, r->name, &name);
    parameter_allowed(allowed, p);
    return status == HDR_MISSING || (status == HDR_OK && particles_choose(def, name)) ||
           reader_refuse(r, allowed);
}

/* ---- of the node --------------------------------------------------------------------------- */

static bool read_line(const reader *r, const parameter *p, const char **line)
{
    return accepts(r, hdr_param_string(r->params, r->name, line), "a string") &&
           ((is_one_line(*line) && (**line || p->kind == FILE_PATH)) || reader_refuse(r, p->range));
}

/** Reads one of the two words of `allowed`, which has "or" between them. */
static bool read_choice(const reader *r, const parameter *p, const char **choice)
{
    const hdr_status status = hdr_param_string(r->params, r->name, choice);
    const size_t length = strlen(*choice), first = strcspn(p->range, " ");
    const char *second = strrchr(p->range, ' ') + 1;
    const bool is_first = length == first && strncmp(*choice, p->range, first) == 0;
    return status == HDR_MISSING || (status == HDR_OK && (is_first || !strcmp(*choice, second))) ||
           reader_refuse(r, p->range);
}

static bool read_topics(const reader *r, const parameter *p, unsigned *set)
{
    const char *const *names = NULL;
    char allowed[PARAMETER_ALLOWED];
    int count = 0;
    if (p->kind == TOPICS_AWAITED && is_word(r, "all")) return *set = ALL_PUBLISHED, true;
    const hdr_status status = hdr_param_string_list(r->params, r->name, &names, &count);
    if (status == HDR_MISSING) return true;
    parameter_allowed(allowed, p);
    if (status != HDR_OK) return reader_refuse(r, allowed);
    *set = 0;
    for (int k = 0; k < count; k++) {
        const unsigned bit = topic_bit_of(names[k]);
        if (!(bit & parameter_topics(p))) return reader_refuse(r, allowed);
        *set |= bit;
    }
    return true;
}

/** Reads the list of changes; their contents are checked later. */
static bool read_changes(const reader *r, const parameter *p, change_list *changes)
{
    const hdr_status status = hdr_param_string_list(r->params, r->name, &changes->text,
                                                    &changes->count);
    return accepts(r, status, p->range);
}

/** Reads the choice of fields; its range is checked later, with the scene. */
static bool read_fields(const reader *r, const parameter *p, field_choice *choice)
{
    if (is_word(r, p->default_value)) return true;
    const hdr_status status = hdr_param_int_list(r->params, r->name, &choice->index,
                                                 &choice->count);
    if (status == HDR_MISSING) return true;
    choice->text = hdr_param_text(r->params, r->name);
    return (status == HDR_OK && choice->count > 0) || reader_refuse(r, p->range);
}

bool reader_read(const reader *r, const parameter *p, void *field)
{
    switch (p->kind) {
    case OF_SCENE: return read_of_scene(r, p, field);
    case PARTICLES: return read_particles(r, p, field);
    case REAL_NUMBER: return accepts(r, hdr_param_double(r->params, r->name, field), "a number");
    case WHOLE_NUMBER:
        return accepts(r, hdr_param_int(r->params, r->name, field), "an integer, without a point");
    case NAME:
    case FILE_PATH: return read_line(r, p, field);
    case CHOICE: return read_choice(r, p, field);
    case TOPICS_OBSERVED:
    case TOPICS_AWAITED: return read_topics(r, p, field);
    case FIELD_CHOICE: return read_fields(r, p, field);
    case CHANGES: return read_changes(r, p, field);
    }
    return false;
}
