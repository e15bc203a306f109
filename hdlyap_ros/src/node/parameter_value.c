/** Values of parameters -> texts. */
#include "node/parameter_value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "topics/topic.h"

static const char *write_number(char room[PARAMETER_VALUE], double value)
{
    snprintf(room, PARAMETER_VALUE, "%.15g", value);
    if (strtod(room, NULL) != value) snprintf(room, PARAMETER_VALUE, "%.17g", value);
    return room;
}

static const char *write_in_row(char room[PARAMETER_VALUE], const hd_parameter *row, double value)
{
    const bool named = hd_parameter_is_word(row, value);
    return named ? hd_parameter_word_of(row, (int)value) : write_number(room, value);
}

static const char *of_scene(char room[PARAMETER_VALUE], const parameter *p, const settings *set)
{
    switch (p->row->kind) {
    case HD_PARAMETER_SEED: return set->seed;
    case HD_PARAMETER_EXPONENTS: return set->exponents;
    case HD_PARAMETER_TEXT: return (const char *)&set->def + p->row->offset;
    default: return write_in_row(room, p->row, hd_parameter_value(p->row, &set->def));
    }
}

static const char *of_topics(char room[PARAMETER_VALUE], unsigned set)
{
    topic_names(room, PARAMETER_VALUE, set);
    return room;
}

const char *parameter_value(char room[PARAMETER_VALUE], const parameter *p, const settings *set)
{
    const void *field = (const char *)set + p->offset;
    switch (p->kind) {
    case OF_SCENE: return of_scene(room, p, set);
    case PARTICLES: return set->particles;
    case REAL_NUMBER: return write_number(room, *(const double *)field);
    case WHOLE_NUMBER: return write_number(room, *(const int *)field);
    case TOPICS_OBSERVED:
    case TOPICS_AWAITED: return of_topics(room, *(const unsigned *)field);
    case FIELD_CHOICE: return ((const field_choice *)field)->text;
    case CHANGES: return "";
    default: return *(const char *const *)field;
    }
}

/** The direction of which a row is the boundary; -1 if it is none. */
static int direction_of(const hd_parameter *row)
{
    for (int d = 0; d < HD_DIMENSION_MAX; d++)
        if (row->offset == offsetof(hd_scene_def, boundary) + (size_t)d * sizeof(hd_boundary))
            return d;
    return -1;
}

/** Ly / Lx; as asked for if that is exact, so that no digit changes. */
static double aspect_of(const hd_scene_def *def)
{
    double box[HD_DIMENSION_MAX];
    hd_scene_box(def, box);
    return def->aspect * box[0] == box[1] ? def->aspect : box[1] / box[0];
}

const char *parameter_effect(char room[PARAMETER_VALUE], const parameter *p,
                             const hd_scene_def *def, int threads, const char *asked)
{
    const hd_parameter *row = p->kind == OF_SCENE ? p->row : NULL;
    if (!row || row->kind == HD_PARAMETER_SEED || row->kind == HD_PARAMETER_EXPONENTS ||
        row->kind == HD_PARAMETER_TEXT)
        return asked;
    if (row->offset == offsetof(hd_scene_def, threads)) return write_number(room, threads);
    if (row->offset == offsetof(hd_scene_def, warmup))
        return write_number(room, hd_scene_warmup(def));
    if (row->offset == offsetof(hd_scene_def, aspect)) return write_number(room, aspect_of(def));
    if (direction_of(row) >= 0) return hd_scene_boundary_word(def, direction_of(row));
    return write_in_row(room, row, hd_parameter_effect(row, def));
}
