/** What a run has said last. */
#include "heard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fields_clear(heard *h)
{
    for (int k = 0; k < h->fields; k++) free(h->field[k].x);
    h->fields = 0;
}

void heard_clear(heard *h)
{
    fields_clear(h);
    free(h->x);
    free(h->exponents);
    free((void *)h->steps.steps.data);
    free((void *)h->phases.phases.data);
    *h = (heard){.time = -1.0};
}

static bool is_in(const hdr_strings *list, const char *name)
{
    for (uint32_t k = 0; k < list->count; k++)
        if (strcmp(list->data[k], name) == 0) return true;
    return false;
}

void heard_run_info(heard *h, const hdr_run_info *info)
{
    if (h->begun && strcmp(h->run_id, info->run_id) == 0) return;
    heard_clear(h);
    double *places = malloc(2 * (size_t)info->disks * sizeof *places + 1);
    if (!places) return;
    snprintf(h->run_id, sizeof h->run_id, "%s", info->run_id);
    snprintf(h->scene, sizeof h->scene, "%s", info->scene);
    h->disks = info->disks;
    h->box[0] = info->box_x;
    h->box[1] = info->box_y;
    h->periodic[0] = strcmp(info->boundary_x, "periodic") == 0;
    h->periodic[1] = strcmp(info->boundary_y, "periodic") == 0;
    h->has_exponents = info->vectors > 0;
    h->has_steps = is_in(&info->observables, "steps");
    h->has_fields = is_in(&info->observables, "fields");
    h->x = places;
    h->y = places + info->disks;
    h->begun = true;
}

static bool is_ours(const heard *h, const char *run_id)
{
    return h->begun && strcmp(h->run_id, run_id) == 0;
}

static void copy(double *to, const hdr_doubles *array)
{
    for (uint32_t k = 0; k < array->count; k++) to[k] = array->data[(size_t)k * array->stride];
}

/** A block of `bytes` in place of an old one, or NULL: the old one is then as it was. */
static void *replaced(const void *old, const void *from, size_t bytes)
{
    void *block = malloc(bytes + 1);
    if (!block) return NULL;
    if (from && bytes > 0) memcpy(block, from, bytes);
    free((void *)old);
    return block;
}

void heard_state(heard *h, const hdr_state *state)
{
    if (!is_ours(h, state->run_id) || state->x.count != h->disks || state->y.count != h->disks)
        return;
    copy(h->x, &state->x);
    copy(h->y, &state->y);
    h->time = state->sim_time;
}

void heard_spectrum(heard *h, const hdr_spectrum *spectrum)
{
    if (!is_ours(h, spectrum->run_id)) return;
    double *exponents = replaced(h->exponents, NULL, spectrum->exponents.count * sizeof *exponents);
    if (!exponents) return;
    copy(exponents, &spectrum->exponents);
    h->exponents = exponents;
    h->vectors = spectrum->exponents.count;
    h->averaged = spectrum->averaged_time;
}

void heard_steps(heard *h, const hdr_steps *steps)
{
    if (!is_ours(h, steps->run_id)) return;
    hdr_step *own = replaced(h->steps.steps.data, steps->steps.data,
                             steps->steps.count * sizeof *own);
    if (!own) return;
    h->steps = *steps;
    h->steps.steps.data = own;
}

void heard_phases(heard *h, const hdr_lp_phases *phases)
{
    if (!is_ours(h, phases->run_id)) return;
    hdr_lp_phase *own = replaced(h->phases.phases.data, phases->phases.data,
                                 phases->phases.count * sizeof *own);
    if (!own) return;
    h->phases = *phases;
    h->phases.phases.data = own;
}

/** Where the field of a kind and wave vector is kept; NULL without room. */
static heard_field *place_of(heard *h, const hdr_mode_field *field)
{
    for (int k = 0; k < h->fields; k++) {
        heard_field *f = &h->field[k];
        if (f->kind == field->kind && f->nx == field->nx && f->ny == field->ny) return f;
    }
    if (h->fields == HEARD_FIELDS_MAX) return NULL;
    double *block = malloc(4 * (size_t)h->disks * sizeof *block + 1);
    if (!block) return NULL;
    heard_field *f = &h->field[h->fields++];
    *f = (heard_field){.x = block};
    f->y = block + h->disks;
    f->dx = f->y + h->disks;
    f->dy = f->dx + h->disks;
    return f;
}

void heard_mode_field(heard *h, const hdr_mode_field *field)
{
    const hdr_doubles *arrays[] = {&field->x, &field->y, &field->dqx, &field->dqy};
    if (!is_ours(h, field->run_id)) return;
    for (int k = 0; k < 4; k++)
        if (arrays[k]->count != h->disks) return;
    heard_field *f = place_of(h, field);
    if (!f) return;
    f->kind = field->kind;
    f->nx = field->nx;
    f->ny = field->ny;
    f->index = field->index;
    f->exponent = field->exponent;
    f->time = field->sim_time;
    for (int k = 0; k < 4; k++) copy(f->x + (size_t)k * h->disks, arrays[k]);
}
