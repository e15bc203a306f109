/** Messages -> the data that a picture is made of. */
#include "heard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/nodes.h"

void heard_clear(heard *h)
{
    for (int k = 0; k < HEARD_VECTORS_MAX; k++) free(h->vector[k].d);
    free(h->q);
    free((void *)h->steps.steps.data);
    free((void *)h->phases.phases.data);
    *h = (heard){.time = -1.0, .status_time = -1.0, .vector_time = -1.0};
}

/* ---- the run ------------------------------------------------------------------------------- */

const char *heard_parameter(const hdr_run_info *info, const char *name)
{
    for (uint32_t k = 0; k < info->parameters.count; k++)
        if (strcmp(info->parameters.data[k].name, name) == 0)
            return info->parameters.data[k].effect;
    return "";
}

/** Element k of a list of mode numbers; 0 along z in the plane, where the list is empty. */
static uint32_t nodes(const hdr_uints *along, uint32_t k)
{
    return k < along->count ? along->data[k] : 0;
}

/** Whether a wave has transverse fields. It has if the fields can point in at least two directions,
 * which exclude those between walls without nodes [T10]. */
static bool is_transverse(const heard *h, const hdr_run_info *info, uint32_t wave)
{
    const hdr_uints *const along[] = {&info->wave_nx, &info->wave_ny, &info->wave_nz};
    int directions = 0;
    for (int d = 0; d < 3; d++) directions += h->periodic[d] || nodes(along[d], wave) > 0;
    return h->corners > 0 || directions >= 2;
}

static bool has_transverse(const heard *h, const hdr_run_info *info)
{
    for (uint32_t k = 0; k < info->wave_nx.count && k < info->wave_ny.count; k++)
        if (is_transverse(h, info, k)) return true;
    return false;
}

static double element(const hdr_doubles *array, uint32_t i)
{
    return array->data[(size_t)i * array->stride];
}

/** Turns underscores into spaces: time_step becomes time step. */
static void in_words(char *name)
{
    for (char *c = name; *c; c++)
        if (*c == '_') *c = ' ';
}

/** Writes, e.g., "potential wca, energy 1": names in words, numbers with four digits. */
static void write_own(char *text, size_t size, const hdr_parameter_list *list)
{
    *text = '\0';
    for (uint32_t k = 0; k < list->count; k++) {
        const hdr_parameter *p = &list->data[k];
        const size_t length = strlen(text);
        const char *comma = length > 0 ? ", " : "";
        char *end;
        const double number = strtod(p->effect, &end);
        if (p->own && end > p->effect && !*end)
            snprintf(text + length, size - length, "%s%s %.4g", comma, p->name, number);
        else if (p->own)
            snprintf(text + length, size - length, "%s%s %s", comma, p->name, p->effect);
    }
    in_words(text);
}

/** Whether a list of words with ", " between them has this one. */
static bool has_word(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = list; (at = strstr(at, word)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ',' || !at[length])) return true;
    return false;
}

/** A number that is finite; 0 if it is none. */
static double number_in(const char *text)
{
    const double number = strtod(text, NULL);
    return isfinite(number) ? number : 0.0;
}

/** Keeps the kinds of particles; all that are left are of the last one. */
static void begin_kinds(heard *h, const hdr_run_info *info)
{
    uint32_t end = 0;
    for (uint32_t k = 0; k < info->kind_numbers.count && k < info->kind_diameters.count &&
                         k < info->kind_masses.count && k < HEARD_KINDS_MAX;
         k++) {
        const uint32_t left = h->number - end, number = info->kind_numbers.data[k];
        end += number < left ? number : left;
        h->kind[h->kinds++] = (heard_kind){end, element(&info->kind_diameters, k),
                                           element(&info->kind_masses, k)};
    }
    if (h->kinds == 0) h->kind[h->kinds++] = (heard_kind){h->number, 1.0, 1.0};
    h->kind[h->kinds - 1].end = h->number;
}

static void begin_particles(heard *h, const hdr_run_info *info)
{
    const char *particles = heard_parameter(info, "particles");
    snprintf(h->particles, sizeof h->particles, "%s", particles);
    in_words(h->particles);
    h->inertia = info->inertia;
    for (uint32_t k = 0; k < info->sites.count && k < HEARD_SITES_MAX; k++)
        h->site[h->sites++] = element(&info->sites, k);
    begin_kinds(h, info);
    write_own(h->own, sizeof h->own, &info->parameters);
}

/** Keeps as many corners of the outline as there is room for. */
static void begin_outline(heard *h, const hdr_run_info *info)
{
    while (h->corners < info->outline_x.count && h->corners < info->outline_y.count &&
           h->corners < HEARD_CORNERS_MAX) {
        const uint32_t k = h->corners++;
        h->outline[k] = (hdr_point){element(&info->outline_x, k), element(&info->outline_y, k),
                                    0.0};
    }
}

static void begin_box(heard *h, const hdr_run_info *info)
{
    static const char *const of_axis[] = {"boundary_x", "boundary_y", "boundary_z"};
    h->box[0] = info->box_x;
    h->box[1] = info->box_y;
    h->box[2] = info->dimension == 3 ? info->box_z : 0.0;
    for (int d = 0; d < 3; d++) {
        const char *word = d < 2 || heard_has_spheres(h) ? heard_parameter(info, of_axis[d]) : "";
        const bool reflects = strcmp(word, "reflecting") == 0,
                   shears = strcmp(word, "shearing") == 0;
        h->periodic[d] = strcmp(word, "periodic") == 0;
        if (shears)
            snprintf(h->wall[d], sizeof h->wall[d], "shearing, shear b %.4g",
                     number_in(heard_parameter(info, "shear_b")));
        else
            snprintf(h->wall[d], sizeof h->wall[d], "%s", h->periodic[d] || reflects ? "" : word);
    }
    snprintf(h->container, sizeof h->container, "%s", heard_parameter(info, "container"));
    begin_outline(h, info);
}

static void begin(heard *h, const hdr_run_info *info)
{
    static const char *const of_modes[] = {"modes",  "steps", "lp_phases", "t_phases",
                                           "fields", "hydro", "structure"};
    const char *observables = heard_parameter(info, "observables");
    snprintf(h->run_id, sizeof h->run_id, "%s", info->run_id);
    snprintf(h->scene, sizeof h->scene, "%s", heard_parameter(info, "scene"));
    begin_particles(h, info);
    h->stage = UINT8_MAX;
    begin_box(h, info);
    for (size_t k = 0; k < sizeof of_modes / sizeof *of_modes; k++)
        h->has_lp |= info->wave_nx.count > 0 && has_word(observables, of_modes[k]);
    h->has_t = h->has_lp && has_transverse(h, info);
    h->begun = true;
}

bool heard_run_info(heard *h, const hdr_run_info *info)
{
    if (h->begun && strcmp(h->run_id, info->run_id) == 0) return false;
    heard_clear(h);
    const double number = fmin(fmax(number_in(heard_parameter(info, "number")), 0.0),
                               HEARD_NUMBER_MAX);
    h->number = (uint32_t)number;
    h->q = malloc(2 * (size_t)h->number * (sizeof *h->q + sizeof *h->angle) + 1);
    if (!h->q) return false;
    h->at = h->q + h->number;
    h->angle = (double *)(h->at + h->number);
    h->spin = h->angle + h->number;
    begin(h, info);
    h->changed = true;
    return true;
}

static bool is_ours(const heard *h, const char *run_id)
{
    return h->begun && strcmp(h->run_id, run_id) == 0;
}

/** Copies `bytes` into a new block and frees the old one. Returns NULL, and keeps the old one, if
 * there is no memory. */
static void *replaced(const void *old, const void *from, size_t bytes)
{
    void *block = malloc(bytes + 1);
    if (!block) return NULL;
    if (from && bytes > 0) memcpy(block, from, bytes);
    free((void *)old);
    return block;
}

/* ---- particles and vectors of one time ------------------------------------------------------- */

/** Whether there are `times` numbers for each particle; along z only in space. */
static bool are_of_each(const heard *h, uint64_t times, const hdr_doubles *x, const hdr_doubles *y,
                        const hdr_doubles *z)
{
    const uint64_t all = times * h->number;
    return x->count == all && y->count == all && z->count == (heard_has_spheres(h) ? all : 0);
}

/** Whether there are `times` angles for each particle if particles rotate, and none otherwise. */
static bool turn_each(const heard *h, uint64_t times, const hdr_doubles *angle)
{
    return angle->count == (heard_turns(h) ? times * h->number : 0);
}

/** Copies a vector for each particle. Returns false, and copies nothing, if a number is missing. */
static bool take(const heard *h, hdr_point *to, const hdr_doubles *x, const hdr_doubles *y,
                 const hdr_doubles *z)
{
    if (!are_of_each(h, 1, x, y, z)) return false;
    for (uint32_t i = 0; i < h->number; i++)
        to[i] = (hdr_point){element(x, i), element(y, i), z->count > 0 ? element(z, i) : 0.0};
    return true;
}

/** Takes the displacements of dq, which has them times the root of the mass. Returns false, and
 * copies nothing, if a number is missing. */
static bool take_vector(const heard *h, hdr_point *to, const hdr_doubles *x, const hdr_doubles *y,
                        const hdr_doubles *z)
{
    uint32_t i = 0;
    if (!take(h, to, x, y, z)) return false;
    for (int k = 0; k < h->kinds; k++)
        for (const double root = sqrt(h->kind[k].mass); i < h->kind[k].end; i++)
            to[i] = (hdr_point){to[i].x / root, to[i].y / root, to[i].z / root};
    return true;
}

static void take_turns(double *to, const hdr_doubles *angle)
{
    for (uint32_t i = 0; i < angle->count; i++) to[i] = element(angle, i);
}

/** What a message says about the state of particles. */
typedef struct places {
    const hdr_doubles *x, *y, *z, *angle, *spin;
} places;
#define PLACES(m) ((places){&(m)->x, &(m)->y, &(m)->z, &(m)->angle, &(m)->spin})

/** Takes over the state of particles from a message. Returns false, and takes nothing, if something
 * is missing. */
static bool move(heard *h, double time, places to)
{
    if (!turn_each(h, 1, to.angle) || !turn_each(h, 1, to.spin)) return false;
    if (!take(h, h->q, to.x, to.y, to.z)) return false;
    take_turns(h->angle, to.angle);
    take_turns(h->spin, to.spin);
    h->time = time;
    h->changed = true;
    return true;
}

void heard_state(heard *h, const hdr_state *state)
{
    if (!is_ours(h, state->run_id)) return;
    if (state->sim_time < h->vector_time) { /* a bag that is played again */
        h->vector_time = -1.0;
        h->vectors = 0;
    }
    (void)move(h, state->sim_time, PLACES(state));
}

/** Adds a vector, but does not fill its arrays. Returns NULL if there is no room or memory. */
static heard_vector *add(heard *h, const heard_vector *what)
{
    if (h->vectors == HEARD_VECTORS_MAX) return NULL;
    heard_vector *v = &h->vector[h->vectors];
    hdr_point *block = v->d;
    if (!block) block = malloc((size_t)h->number * (sizeof *block + sizeof *v->turn) + 1);
    if (!block) return NULL;
    *v = *what;
    v->d = block;
    v->turn = (double *)(block + h->number);
    h->vectors++;
    return v;
}

/** The vector with this index, whose field is received again; NULL if it is new. */
static heard_vector *with_index(heard *h, uint32_t index)
{
    for (int k = 0; k < h->vectors; k++)
        if (h->vector[k].index == index) return &h->vector[k];
    return NULL;
}

heard_lp heard_lp_at(const heard *h, double time, const heard_vector *v)
{
    heard_lp lp = {.pairs = 0};
    if (h->phases.sample_time != time) return lp;
    for (uint32_t k = 0; k < h->phases.phases.count && lp.pairs < HEARD_PAIRS_MAX; k++) {
        const hdr_lp_phase *phase = &h->phases.phases.data[k];
        if (phase->index != v->index || !SAME_NODES(phase, v)) continue;
        lp.a[lp.pairs] = phase->a;
        lp.b[lp.pairs++] = phase->b;
    }
    return lp;
}

/** Gives coefficients to vectors that came without, from phases of the same time. */
static void note_phases(heard *h)
{
    for (heard_vector *v = h->vector; v < h->vector + h->vectors; v++)
        if (v->lp.pairs == 0) v->lp = heard_lp_at(h, h->vector_time, v);
}

/** Prepares for a vector of a field: if the field has another time, forgets the vectors from before
 * and takes its positions. Returns false if the positions are not those of all particles. */
static bool place_vectors(heard *h, const hdr_mode_field *field)
{
    if (field->sim_time == h->vector_time) return true;
    if (!take(h, h->at, &field->x, &field->y, &field->z)) return false;
    h->vector_time = field->sim_time;
    h->vectors = 0;
    return true;
}

void heard_mode_field(heard *h, const hdr_mode_field *field)
{
    const heard_vector what = {.kind = field->kind,
                               .nx = field->nx,
                               .ny = field->ny,
                               .nz = field->nz,
                               .index = field->index,
                               .exponent = field->exponent,
                               .known = true};
    if (!is_ours(h, field->run_id)) return;
    if (!are_of_each(h, 1, &field->dqx, &field->dqy, &field->dqz)) return;
    if (!turn_each(h, 1, &field->dq_angle) || !place_vectors(h, field)) return;
    if (field->sim_time > h->time) (void)move(h, field->sim_time, PLACES(field));
    heard_vector *v = with_index(h, field->index);
    if (!v) v = add(h, &what);
    if (!v) return;
    (void)take_vector(h, v->d, &field->dqx, &field->dqy, &field->dqz);
    take_turns(v->turn, &field->dq_angle);
    note_phases(h);
    h->changed = true;
}

/** Whether a vector is to be kept. One per step is enough: the first vector of its kind and wave,
 * or the vector with the step's first index. */
static bool is_wanted(const heard *h, const heard_vector *v)
{
    bool is_new = v->kind == HDR_MODE_T || v->kind == HDR_MODE_LP;
    for (int k = 0; k < h->vectors && is_new; k++)
        is_new = h->vector[k].kind != v->kind || !SAME_NODES(&h->vector[k], v);
    for (uint32_t k = 0; k < h->steps.steps.count && !is_new; k++)
        is_new = h->steps.steps.data[k].resolved && h->steps.steps.data[k].first_index == v->index;
    return is_new;
}

/** How many numbers a, and b, each vector of slow_vectors has. */
static uint32_t pairs_of_each(const heard *h) { return heard_has_spheres(h) ? 8 : 4; }

/** Vector k of the message, without its arrays. */
static heard_vector vector_of(const heard *h, const hdr_slow_vectors *slow, uint32_t k)
{
    const uint32_t each = pairs_of_each(h), pairs = slow->pairs.data[k];
    heard_vector v = {.kind = slow->kind.data[k],
                      .nx = slow->nx.data[k],
                      .ny = slow->ny.data[k],
                      .nz = nodes(&slow->nz, k),
                      .index = slow->first_index + k,
                      .exponent = slow->exponents.data[k],
                      .known = slow->dqx.count > 0,
                      .lp.pairs = pairs < each ? pairs : each};
    memcpy(v.lp.a, slow->a.data + (size_t)each * k, each * sizeof *v.lp.a);
    memcpy(v.lp.b, slow->b.data + (size_t)each * k, each * sizeof *v.lp.b);
    return v;
}

/** Whether the message has the dq halves of `times` vectors. */
static bool has_vectors(const heard *h, const hdr_slow_vectors *m, uint64_t times)
{
    return are_of_each(h, times, &m->dqx, &m->dqy, &m->dqz) && turn_each(h, times, &m->dq_angle);
}

/** Whether the arrays of a message are as long as it says. */
static bool is_whole(const heard *h, const hdr_slow_vectors *m)
{
    const uint64_t n = m->vectors, pairs = n * pairs_of_each(h);
    return m->exponents.count == n && m->kind.count == n && m->nx.count == n && m->ny.count == n &&
           m->pairs.count == n && m->a.count == pairs && m->b.count == pairs &&
           (m->nz.count == n || !heard_has_spheres(h)) &&
           (has_vectors(h, m, n) || has_vectors(h, m, 0));
}

/** The part of an array that belongs to vector k; empty if the array is, as along z in the plane.
 */
static hdr_doubles part(const hdr_doubles *all, uint32_t k, uint32_t number)
{
    if (all->count == 0) return *all;
    return (hdr_doubles){all->data + (size_t)k * number * all->stride, number, all->stride};
}

void heard_slow_vectors(heard *h, const hdr_slow_vectors *slow)
{
    if (!is_ours(h, slow->run_id) || !is_whole(h, slow)) return;
    if (!move(h, slow->sim_time, PLACES(slow))) return;
    memcpy(h->at, h->q, h->number * sizeof *h->at);
    h->vector_time = slow->sim_time;
    h->vectors = 0;
    for (uint32_t k = 0; k < slow->vectors; k++) {
        const heard_vector what = vector_of(h, slow, k);
        const heard_vector *v = is_wanted(h, &what) ? add(h, &what) : NULL;
        const hdr_doubles dx = part(&slow->dqx, k, h->number), dy = part(&slow->dqy, k, h->number),
                          dz = part(&slow->dqz, k, h->number),
                          turn = part(&slow->dq_angle, k, h->number);
        if (!v) continue;
        (void)take_vector(h, v->d, &dx, &dy, &dz);
        take_turns(v->turn, &turn);
    }
}

/* ---- steps, phases, status ----------------------------------------------------------------- */

void heard_steps(heard *h, const hdr_steps *steps)
{
    if (!is_ours(h, steps->run_id)) return;
    hdr_step *own = replaced(h->steps.steps.data, steps->steps.data,
                             steps->steps.count * sizeof *own);
    if (!own) return;
    h->steps = *steps;
    h->steps.steps.data = own;
}

void heard_lp_phases(heard *h, const hdr_lp_phases *phases)
{
    if (!is_ours(h, phases->run_id)) return;
    hdr_lp_phase *own = replaced(h->phases.phases.data, phases->phases.data,
                                 phases->phases.count * sizeof *own);
    if (!own) return;
    h->phases = *phases;
    h->phases.phases.data = own;
    note_phases(h);
    h->changed |= phases->sample_time == h->time || phases->sample_time == h->vector_time;
}

void heard_run_status(heard *h, const hdr_run_status *status)
{
    if (!is_ours(h, status->run_id)) return;
    h->changed |= h->time < 0.0 || h->stage != status->stage;
    h->stage = status->stage;
    h->status_time = status->sim_time;
    h->progress = status->progress;
}
