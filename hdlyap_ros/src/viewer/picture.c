/** The last messages of a run -> a picture. */
#include "picture.h"

#include <stdio.h>
#include <string.h>

bool mode_name_parse(mode_name *out, const char *text)
{
    const bool is_lp = strncmp(text, "LP", 2) == 0;
    int end = -1, in_plane = -1;
    if (!is_lp && *text != 'T') return false;
    out->kind = is_lp ? HDR_MODE_LP : HDR_MODE_T;
    text += is_lp ? 2 : 1;
    if (strspn(text, "(0123456789,)") != strlen(text)) return false;
    out->nz = 0;
    (void)sscanf(text, "(%4u,%4u)%n", &out->nx, &out->ny, &in_plane);
    (void)sscanf(text, "(%4u,%4u,%4u)%n", &out->nx, &out->ny, &out->nz, &end);
    if (end < 0) end = in_plane;
    return end > 0 && !text[end];
}

/** Whether the run classifies this mode, as far as its steps are known. */
static bool is_looked_for(const heard *h, const mode_name *name)
{
    bool is = h->steps.steps.count == 0;
    for (uint32_t k = 0; k < h->steps.steps.count; k++) {
        const hdr_step *step = &h->steps.steps.data[k];
        is |= step->kind == name->kind && SAME_NODES(step, name);
    }
    return is;
}

static bool is_shown(const hdr_step *step) { return step->resolved && !step->conjugate; }

/** The lowest resolved step of a kind or, with a name, the step of that name; NULL if there is
 * none. */
static const hdr_step *step_of(const heard *h, uint8_t kind, const mode_name *name)
{
    const hdr_step *found = NULL;
    for (uint32_t k = 0; k < h->steps.steps.count; k++) {
        const hdr_step *step = &h->steps.steps.data[k];
        if (step->kind != kind || !is_shown(step)) continue;
        if (name && !SAME_NODES(step, name)) continue;
        if (!found || step->exponent < found->exponent) found = step;
    }
    return found;
}

/** The vector of a kind with the smallest exponent or, with a name, the first vector of that name;
 * NULL if there is none. */
static const heard_vector *vector_of(const heard *h, uint8_t kind, const mode_name *name)
{
    const heard_vector *found = NULL;
    for (int k = 0; k < h->vectors; k++) {
        const heard_vector *v = &h->vector[k];
        if (v->kind != kind || (name && !SAME_NODES(v, name))) continue;
        if (!found || (name ? v->index < found->index : v->exponent < found->exponent)) found = v;
    }
    return found;
}

/** The first vector of a step's kind and wave, otherwise the vector with the step's first index;
 * NULL if there is none. */
static const heard_vector *vector_of_step(const heard *h, const hdr_step *step)
{
    const mode_name name = {step->kind, step->nx, step->ny, step->nz};
    const heard_vector *found = vector_of(h, step->kind, &name);
    for (int k = 0; k < h->vectors && !found; k++)
        if (h->vector[k].index == step->first_index) found = &h->vector[k];
    return found;
}

/** The part of a vector in the P fields; -1 if all coefficients are 0. */
static double momentum_of(const heard_lp *lp)
{
    double l = 0.0, p = 0.0;
    for (uint32_t k = 0; k < lp->pairs; k++) {
        l += lp->a[k] * lp->a[k];
        p += lp->b[k] * lp->b[k];
    }
    return l + p > 0.0 ? p / (l + p) : -1.0;
}

/** Fills what a picture shows of a vector. Coefficients are those at the time of the picture if
 * they are known, otherwise those at the time of the vector. */
static void fill_vector(picture_mode *mode, const heard *h, const heard_vector *v)
{
    mode->index = v->index;
    if (!v->known) return;
    mode->d = v->d;
    mode->turn = v->turn;
    if (mode->kind != HDR_MODE_LP || v->kind != HDR_MODE_LP) return;
    mode->momentum = momentum_of(&v->lp);
    if (h->vector_time != h->time) mode->lp = heard_lp_at(h, h->time, v);
    if (mode->lp.pairs == 0) mode->lp = v->lp;
}

/** Writes the name of a mode, e.g. T(1,0); only its kind if its wave is not known yet. */
static void write_name(char name[PICTURE_NAME_SIZE], const heard *h, const mode_name *is)
{
    char nodes[NODES_SIZE] = "";
    if (is->nx > 0 || is->ny > 0 || is->nz > 0)
        nodes_write(nodes, heard_has_spheres(h), is->nx, is->ny, is->nz);
    snprintf(name, PICTURE_NAME_SIZE, "%s%s", hdr_mode_kind_text(is->kind), nodes);
}

/** The mode of this name; if name is NULL, the lowest mode of the kind, by the steps or, if they
 * are not known, by the vectors. */
static picture_mode mode_of(const heard *h, uint8_t kind, const mode_name *name)
{
    picture_mode mode = {.kind = kind, .error = -1.0, .momentum = -1.0};
    mode_name is = name ? *name : (mode_name){.kind = kind};
    const hdr_step *step = step_of(h, kind, name);
    const heard_vector *v = step ? vector_of_step(h, step) : NULL;
    write_name(mode.name, h, &is);
    snprintf(mode.box, sizeof mode.box, "%s%.40s", name ? "" : "lowest ", mode.name);
    if (step) {
        is = (mode_name){kind, step->nx, step->ny, step->nz};
        mode.index = step->first_index;
        mode.exponent = step->exponent;
        mode.error = step->std_error;
    }
    if (!v && (v = vector_of(h, kind, name))) { /* its step has not been received */
        is = (mode_name){kind, v->nx, v->ny, v->nz};
        mode.exponent = v->exponent;
        mode.error = -1.0;
    }
    mode.found = step || v;
    mode.absent = name && !mode.found && !is_looked_for(h, name);
    write_name(mode.name, h, &is);
    if (v) fill_vector(&mode, h, v);
    return mode;
}

picture picture_of(const heard *h, const mode_choice *asked, const char *note)
{
    picture p = {.run = h, .note = note};
    if (!h->has_lp) return p;
    for (int k = 0; k < asked->count; k++)
        p.mode[p.modes++] = mode_of(h, asked->mode[k].kind, &asked->mode[k]);
    if (asked->count == 0 && h->has_t) p.mode[p.modes++] = mode_of(h, HDR_MODE_T, NULL);
    if (asked->count == 0) p.mode[p.modes++] = mode_of(h, HDR_MODE_LP, NULL);
    return p;
}
