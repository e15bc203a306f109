/** parameters.inc -> rows, and values by them. */
#include "scene/parameters.h"

#include "hdlyap/dynamics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WORD(NAME, name, what) {#name, HD_##NAME},
static const hd_parameter_word hd_particles_words[] = {HD_PARTICLES_ALL(WORD){NULL, 0}};
static const hd_parameter_word hd_container_words[] = {HD_CONTAINERS(WORD){NULL, 0}};
static const hd_parameter_word hd_boundary_words[] = {HD_BOUNDARIES(WORD){NULL, 0}};
#undef WORD
static const hd_parameter_word hd_exponents_words[] = {
    {"positive", HD_EXPONENTS_POSITIVE},
    {"all", HD_EXPONENTS_ALL},
    {"all_independent", HD_EXPONENTS_ALL_INDEPENDENT},
    {"none", HD_EXPONENTS_NONE},
    {NULL, 0}};
static const hd_parameter_word hd_warmup_words[] = {{"auto", HD_WARMUP_AUTO}, {NULL, 0}};
static const hd_parameter_word hd_interval_words[] = {{"auto", 0}, {NULL, 0}};

#define ROW(name, member, kind, words, usual, least, most, allowed, unit, changes, needs, text)    \
    {#name,                                                                                        \
     kind,                                                                                         \
     words,                                                                                        \
     offsetof(hd_scene_def, member),                                                               \
     usual,                                                                                        \
     least,                                                                                        \
     most,                                                                                         \
     allowed,                                                                                      \
     unit,                                                                                         \
     changes != HD_AS_BEFORE,                                                                      \
     changes == HD_LIVE,                                                                           \
     needs,                                                                                        \
     text,                                                                                         \
     "scene " #name,                                                                               \
     NULL,                                                                                         \
     NULL},
static const hd_parameter rows[] = {
#define HD_INT(name, ...) ROW(name, name, HD_PARAMETER_INT, NULL, __VA_ARGS__)
#define HD_REAL(name, ...) ROW(name, name, HD_PARAMETER_REAL, NULL, __VA_ARGS__)
#define HD_OTHER(name, member, kind, words, ...) ROW(name, member, kind, words, __VA_ARGS__)
#include "hdlyap/parameters.inc"
};
#undef ROW

const hd_parameter *hd_scene_parameters(int *count)
{
    *count = (int)(sizeof rows / sizeof *rows);
    return rows;
}

const hd_parameter *hd_parameter_of(const hd_scene_def *def, int k)
{
    int count;
    const hd_parameter *all = hd_scene_parameters(&count);
    const hd_dynamics *of = hd_dynamics_of(def);
    if (k < count) return &all[k];
    return k - count < of->parameters ? &of->parameter[k - count] : NULL;
}

bool hd_parameter_is_of_box(const hd_parameter *row)
{
    static const size_t of_box[] = {
        offsetof(hd_scene_def, container),       offsetof(hd_scene_def, density),
        offsetof(hd_scene_def, aspect),          offsetof(hd_scene_def, aspect_z),
        offsetof(hd_scene_def, boundary[0]),     offsetof(hd_scene_def, boundary[1]),
        offsetof(hd_scene_def, boundary[2]),     offsetof(hd_scene_def, shear_b),
        offsetof(hd_scene_def, max_wave_number), offsetof(hd_scene_def, max_mode_number)};
    for (size_t k = 0; k < sizeof of_box / sizeof *of_box; k++)
        if (row->offset == of_box[k]) return true;
    return false;
}

/** The value as a number; enumerations and sets are read as int. */
double hd_parameter_value(const hd_parameter *row, const hd_scene_def *def)
{
    const char *field = (const char *)def + row->offset;
    int whole;
    double real;
    uint64_t bits;
    switch (row->kind) {
    case HD_PARAMETER_REAL:
    case HD_PARAMETER_INTERVAL: return memcpy(&real, field, sizeof real), real;
    case HD_PARAMETER_SEED: return memcpy(&bits, field, sizeof bits), (double)bits;
    case HD_PARAMETER_TEXT: return *field != '\0';
    default: return memcpy(&whole, field, sizeof whole), whole;
    }
}

double hd_parameter_effect(const hd_parameter *row, const hd_scene_def *def)
{
    return row->resolve ? row->resolve(def) : hd_parameter_value(row, def);
}

void hd_parameter_assign(const hd_parameter *row, hd_scene_def *def, double value)
{
    char *field = (char *)def + row->offset;
    switch (row->kind) {
    case HD_PARAMETER_REAL:
    case HD_PARAMETER_INTERVAL: memcpy(field, &value, sizeof value); break;
    case HD_PARAMETER_SEED: memcpy(field, &(uint64_t){(uint64_t)value}, sizeof(uint64_t)); break;
    case HD_PARAMETER_TEXT: memset(field, 0, HD_TEXT); break;
    default: memcpy(field, &(int){(int)value}, sizeof(int));
    }
}

bool hd_parameter_read(const hd_parameter *row, hd_scene_def *def, const char *text)
{
    char *end, *field = (char *)def + row->offset;
    if (row->kind == HD_PARAMETER_TEXT) {
        if (strlen(text) >= HD_TEXT) return false;
        memset(field, 0, HD_TEXT);
        memcpy(field, text, strlen(text));
        return true;
    }
    const double value = strtod(text, &end);
    if (row->kind != HD_PARAMETER_REAL || end == text || end[strspn(end, " ")]) return false;
    hd_parameter_assign(row, def, value);
    return true;
}

bool hd_parameter_same(const hd_parameter *row, const hd_scene_def *a, const hd_scene_def *b)
{
    const char *of_a = (const char *)a + row->offset, *of_b = (const char *)b + row->offset;
    if (row->kind == HD_PARAMETER_SEED) return memcmp(of_a, of_b, sizeof(uint64_t)) == 0;
    if (row->kind == HD_PARAMETER_TEXT) return strncmp(of_a, of_b, HD_TEXT) == 0;
    return hd_parameter_value(row, a) == hd_parameter_value(row, b);
}

const char *hd_parameter_say(const hd_parameter *row, const hd_scene_def *def, char *text,
                             size_t size)
{
    const double value = hd_parameter_value(row, def);
    const bool named = hd_parameter_is_word(row, value);
    if (row->kind == HD_PARAMETER_SEED)
        snprintf(text, size, "%llu", (unsigned long long)def->seed);
    else if (named)
        snprintf(text, size, "%s", hd_parameter_word_of(row, (int)value));
    else
        snprintf(text, size, "%.15g", value);
    return text;
}

const char *hd_parameter_word_of(const hd_parameter *row, int value)
{
    for (const hd_parameter_word *w = row->words; w && w->word; w++)
        if (w->value == value) return w->word;
    return NULL;
}

bool hd_parameter_is_word(const hd_parameter *row, double value)
{
    for (const hd_parameter_word *w = row->words; w && w->word; w++)
        if (w->value == value) return true;
    return false;
}

bool hd_parameter_value_of(int *value, const hd_parameter *row, const char *word)
{
    for (const hd_parameter_word *w = row->words; w && w->word; w++)
        if (strcmp(w->word, word) == 0) return *value = w->value, true;
    return false;
}
