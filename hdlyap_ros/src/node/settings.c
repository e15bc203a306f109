/** Private parameters -> settings. This reads each parameter by its row and checks that they fit
 * together. The core checks the ranges of the scene's own parameters. */
#include "settings.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "change.h"
#include "given.h"
#include "parameters.h"
#include "particles.h"
#include "reader.h"
#include "topics/topic.h"

static bool check_names(reader *r)
{
    for (int k = 0; k < hdr_params_count(r->params); k++) {
        r->name = hdr_params_name(r->params, k);
        if (parameters_has(r->name)) continue;
        char unknown[PARAMETER_UNKNOWN];
        parameters_unknown(unknown, r->name);
        return reader_refuse_as(r, unknown);
    }
    return true;
}

static void *field_of(settings *set, const parameter *p) { return (char *)set + p->offset; }

/** Refuses particles with a parameter whose name another one has: both would read its value. */
static bool check_own_names(const hd_dynamics *of, const reader *r)
{
    for (int k = 0; k < of->parameters; k++) {
        int same = 0;
        for (int other = 0; other < parameters_count(); other++)
            same += strcmp(parameters_at(other).name, of->parameter[k].name) == 0;
        if (same == 1) continue;
        snprintf(r->message, r->size,
                 "particles = %s: must have no parameter %s: another parameter has this name",
                 of->particles, of->parameter[k].name);
        return false;
    }
    return true;
}

/** Reads which particles move. This comes first, as it decides which parameters there are. */
static bool read_what_moves(settings *out, reader *r)
{
    const parameter p = parameters_named("particles");
    r->name = p.name;
    if (!reader_read(r, &p, &out->def)) return false;
    particles_are(hd_dynamics_of(&out->def));
    return check_own_names(particles_now(), r);
}

static bool read_all(settings *out, reader *r)
{
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        r->name = p.name;
        if (!reader_read(r, &p, field_of(out, &p))) return false;
    }
    return true;
}

const char *settings_write_nodes(char text[NODES_SIZE], const hd_scene_def *def,
                                 const hd_wave *wave)
{
    return nodes_write(text, hd_scene_dimension(def) == 3, (uint32_t)wave->n[0],
                       (uint32_t)wave->n[1], (uint32_t)wave->n[2]);
}

/** Adds the particles' own parameters to the text: all, or those that few scenes have. */
static void write_own(char *text, size_t size, const hd_scene_def *def, bool all)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    for (int k = 0; k < of->parameters; k++) {
        const hd_parameter *row = &of->parameter[k];
        const double value = hd_parameter_effect(row, def);
        const size_t length = strlen(text);
        if (row->idle ? row->idle(def) : !all) continue;
        if (hd_parameter_is_word(row, value))
            snprintf(text + length, size - length, ", %s %s", row->name,
                     hd_parameter_word_of(row, (int)value));
        else
            snprintf(text + length, size - length, ", %s %.4g", row->name, value);
    }
}

const char *settings_write_system(char text[SYSTEM_SIZE], const settings *set)
{
    const double packing = hd_scene_packing(&set->def);
    char container[64];
    hd_scene_describe(&set->def, container, sizeof container);
    const bool in_box = hd_scene_dimension(&set->def) > 0;
    const int length = snprintf(text, SYSTEM_SIZE, in_box ? "%d %s in %s" : "%d %s",
                                set->def.number, set->particles, container);
    if (!isnan(packing))
        snprintf(text + length, SYSTEM_SIZE - (size_t)length, ", packing fraction %.3g", packing);
    write_own(text, SYSTEM_SIZE, &set->def, isnan(packing) || set->def.dynamics);
    return text;
}

/** Whether the scene's name is that of its file, not one that the user has given. */
static bool is_of_file(const char *name, const hdr_params *file, const char *path)
{
    const char *own = hdr_param_text(file, "scene"), *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path;
    const size_t length = strlen(name);
    if (*own) return strcmp(own, name) == 0;
    return strncmp(base, name, length) == 0 && strcmp(base + length, ".yaml") == 0;
}

/** Checks the name of the scene. A name does not choose a system: the parameters of the system must
 * come with it, and only the usual system may have the usual name. If the system is not that of the
 * scene's file, its name is gone. */
static bool check_scene_name(settings *set, reader *r)
{
    static const char *const system[] = {"particles",  "container", "number",     "density",
                                         "aspect",     "aspect_z",  "boundary_x", "boundary_y",
                                         "boundary_z", "shear_b"};
    const parameter name = parameters_named("scene");
    const char *path;
    const hdr_params *file = hdr_params_file(r->params, &path);
    bool given = file != NULL, usual = !set->def.dynamics, changed = false;
    for (size_t k = 0; k < sizeof system / sizeof *system; k++) {
        const parameter p = parameters_named(system[k]);
        if (*hdr_param_text(r->params, system[k])) given = true;
        if (given_is_changed(r->params, system[k])) changed = true;
        if (hd_parameter_value(p.row, &set->def) != p.row->default_value) usual = false;
    }
    r->name = name.name;
    if (!*hdr_param_text(r->params, r->name)) {
        if (!usual) set->scene = "unnamed";
        return true;
    }
    if (changed && is_of_file(set->scene, file, path)) set->scene = "unnamed";
    return given || strcmp(set->scene, name.default_value) == 0 ||
           reader_refuse(
               r, "given with its particles, container, number, density, aspects or boundaries: a "
                  "name chooses none of them, roslaunch hdlyap run.launch scene:=.. does");
}

/** Refuses particles that messages cannot hold: these have a coordinate for each direction of
 * space, and an angle for particles that turn. */
static bool check_particles(const settings *set, reader *r)
{
    r->name = "particles";
    const hd_dynamics *of = hd_dynamics_of(&set->def);
    return of->dimension == 0 || of->coordinates == of->dimension + (of->inertia != NULL) ||
           reader_refuse(
               r, "particles with a coordinate for each direction of their box, or with an "
                  "angle and an inertia besides: messages have no fields for other coordinates");
}

/** Checks parameters that are not the scene's, if their rows state a range. */
static bool check_ranges(settings *set, reader *r)
{
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        if (!(p.max > p.min) || (p.kind != REAL_NUMBER && p.kind != WHOLE_NUMBER)) continue;
        const void *field = field_of(set, &p);
        const double value = p.kind == REAL_NUMBER ? *(const double *)field : *(const int *)field;
        r->name = p.name;
        if (!(value >= p.min && value <= p.max)) return reader_refuse(r, p.range);
    }
    return true;
}

/** Refuses observables that are not in `topics`, if the user has given them; leaves them out
 * silently if they are defaults. */
static bool leave_all_but(settings *set, reader *r, unsigned topics, const char *when,
                          const char *value)
{
    char names[PARAMETER_ALLOWED], allowed[PARAMETER_ALLOWED + PARAMETER_TEXT];
    if (!(set->observables & ~topics)) return true;
    topic_names(names, sizeof names, topics);
    snprintf(allowed, sizeof allowed, "%s%s when %s = %s", *names ? "a list out of " : "[]", names,
             when, value);
    if (*hdr_param_text(r->params, r->name)) return reader_refuse(r, allowed);
    set->observables &= topics;
    return true;
}

static bool check_observables(settings *set, reader *r)
{
    const hd_dynamics *of = hd_dynamics_of(&set->def);
    const unsigned of_particles = topics_of_particles(of);
    r->name = "observables";
    if (!leave_all_but(set, r, of_particles, "particles", of->particles)) return false;
    if (set->def.exponents == HD_EXPONENTS_NONE &&
        !leave_all_but(set, r, of_particles & ~topics_that_are(TOPIC_OF_VECTORS), "exponents",
                       "none"))
        return false;
    set->def.observe = topic_stages(set->observables);
    return true;
}

static bool check_awaited(settings *set, reader *r)
{
    const unsigned published = set->observables | topics_that_are(TOPIC_ALWAYS);
    r->name = "wait_for_subscribers";
    if (set->awaited == ALL_PUBLISHED) set->awaited = published;
    return !(set->awaited & ~published) ||
           reader_refuse(r, "out of run_info, status, cost and the observables");
}

static bool is_usual(settings *set, const parameter *p)
{
    const void *field = field_of(set, p);
    switch (p->kind) {
    case OF_SCENE: return hd_parameter_value(p->row, &set->def) == p->row->default_value;
    case PARTICLES: return false; /* nothing needs to be observed for it */
    case FIELD_CHOICE: return set->fields.count == 0;
    case REAL_NUMBER: return *(const double *)field == strtod(p->default_value, NULL);
    case WHOLE_NUMBER: return *(const int *)field == atoi(p->default_value);
    default: return false;
    }
}

static void set_default(settings *set, const parameter *p)
{
    void *field = field_of(set, p);
    switch (p->kind) {
    case OF_SCENE:
    case PARTICLES: break;
    case REAL_NUMBER: *(double *)field = strtod(p->default_value, NULL); break;
    case WHOLE_NUMBER: *(int *)field = atoi(p->default_value); break;
    case NAME:
    case CHOICE:
    case FILE_PATH: *(const char **)field = p->default_value; break;
    case TOPICS_OBSERVED:
    case TOPICS_AWAITED: *(unsigned *)field = topics_named(p->default_value); break;
    case FIELD_CHOICE: *(field_choice *)field = (field_choice){.text = p->default_value}; break;
    case CHANGES: break;
    }
}

/** Leaves a parameter out that comes with the scene's file, of whose observables others were asked
 * for. */
static bool leave_out(settings *set, const hdr_params *params, const parameter *p)
{
    if (!given_is_of_file(params, p->name) || !given_is_changed(params, "observables"))
        return false;
    hdr_log(HDR_INFO, "%s of the scene is left out: no observable needs it", p->name);
    set_default(set, p);
    if (p->kind == OF_SCENE) hd_parameter_assign(p->row, &set->def, p->row->default_value);
    return true;
}

/** Refuses parameters that have no effect, as what they belong to is not observed. They may have
 * their defaults. */
static bool check_needs(settings *set, reader *r)
{
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        char usual[PARAMETER_TEXT], names[PARAMETER_TEXT], allowed[3 * PARAMETER_TEXT];
        r->name = p.name;
        if (!p.needs || (set->observables & p.needs) || is_usual(set, &p)) continue;
        if (!*hdr_param_text(r->params, p.name) || leave_out(set, r->params, &p)) continue;
        parameter_usual(usual, &p);
        topic_names(names, sizeof names, p.needs);
        snprintf(allowed, sizeof allowed,
                 p.needs & (p.needs - 1) ? "%s without an observable out of %s"
                                         : "%s unless %s is an observable",
                 usual, names);
        return reader_refuse(r, allowed);
    }
    return true;
}

/** Expects a scene that has been checked. */
static bool check_field_indices(const settings *set, reader *r)
{
    const int vectors = hd_scene_counts(&set->def).vectors;
    char allowed[80];
    r->name = "field_indices";
    snprintf(allowed, sizeof allowed,
             "steps or a list of integers from 1 to %d, the vectors carried", vectors);
    for (int k = 0; k < set->fields.count; k++)
        if (set->fields.index[k] < 1 || set->fields.index[k] > vectors)
            return reader_refuse(r, allowed);
    return true;
}

/** Expects a scene that has been checked. */
static bool check_slow_vectors(const settings *set, reader *r)
{
    const int vectors = hd_scene_counts(&set->def).vectors;
    char allowed[80];
    r->name = "slow_vectors_count";
    snprintf(allowed, sizeof allowed,
             "from 0 (the lowest T and LP steps) to %d, the vectors carried", vectors);
    return (set->slow_vectors_count >= 0 && set->slow_vectors_count <= vectors) ||
           reader_refuse(r, allowed);
}

static bool check_changes(const settings *set, char *message, size_t size)
{
    char line[256];
    for (int k = 0; k < set->changes.count; k++) {
        change each;
        if (change_parse_timed(&each, set->changes.text[k], line, sizeof line)) continue;
        snprintf(message, size, "changes = %.60s: must be changes that ~set can make: %s",
                 set->changes.text[k], line);
        make_one_line(message);
        return false;
    }
    return true;
}

static void write_texts(settings *out)
{
    const parameter p = parameters_named("exponents");
    const char *word = hd_parameter_word_of(p.row, out->def.exponents);
    snprintf(out->seed, sizeof out->seed, "%" PRIu64, out->def.seed);
    snprintf(out->exponents, sizeof out->exponents, "%d", out->def.exponents);
    if (word) snprintf(out->exponents, sizeof out->exponents, "%s", word);
    out->particles = hd_dynamics_of(&out->def)->particles;
}

bool settings_resume(const char **path, const hdr_params *params, char *message, size_t size)
{
    reader r = {.params = params, .name = "resume", .message = message, .size = size};
    const parameter p = parameters_named(r.name), file = parameters_named("checkpoint");
    *path = "";
    if (!reader_read(&r, &p, path)) return false;
    if (strcmp(*path, RESUME_AUTO) != 0) return true;
    r.name = file.name;
    *path = "";
    if (!reader_read(&r, &file, path)) return false;
    const bool is_absent = access(*path, F_OK) != 0 && errno == ENOENT;
    if (is_absent) *path = ""; /* any other fault is found when it is read */
    return true;
}

/** Puts the file that `auto` stands for in its place. */
static bool resolve_resume(settings *set, reader *r, bool is_resumed)
{
    r->name = "resume";
    if (strcmp(set->resume, RESUME_AUTO) != 0) return true;
    set->resume = is_resumed ? set->checkpoint : "";
    return *set->checkpoint ||
           reader_refuse(r, "given with a checkpoint, which it goes on from if it is there");
}

/** Observables that a checkpoint with these stages can publish; some need no stage. */
static unsigned topics_kept(unsigned stages)
{
    unsigned set = topics_that_are(TOPIC_OBSERVABLE);
    for (topic t = 0; t < TOPICS; t++)
        if (topic_stages(topic_bit(t)) & ~stages) set &= ~topic_bit(t);
    return set;
}

static settings defaults(const hd_checkpoint *kept)
{
    settings set = {.def = particles_usual(), .seed = ""};
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        set_default(&set, &p);
    }
    if (!kept) return set;
    set.def = kept->scene;
    set.scene = kept->label;
    set.observables = topics_kept(kept->scene.observe);
    return set;
}

/** Warns if so few exponents are asked for that none belongs to a step. */
static void warn_of_steps(settings *set)
{
    const hd_scene_def *def = &set->def;
    const int least = hd_steps_exponents_least(def), vectors = hd_scene_counts(def).vectors;
    const unsigned empty = set->observables & topics_that_are(TOPIC_OF_STEPS);
    char names[PARAMETER_TEXT];
    hd_scene_def usual = *def;
    if (!empty || vectors == 0 || vectors >= least) return;
    usual.exponents = hd_scene_exponents_usual(def);
    topic_names(names, sizeof names, empty);
    snprintf(set->warning, sizeof set->warning,
             "exponents = %d: none of them belongs to a step, which %s need; at least %d "
             "exponents include a step, %s (%d) includes all",
             vectors, names, least, usual.exponents == HD_EXPONENTS_ALL ? "all" : "positive",
             hd_scene_counts(&usual).vectors);
}

/** Warns of a parameter of the particles' own that was asked for and has no effect, as the mass of
 * a second kind that no particle is of. */
static void warn_of_idle(settings *set, const hdr_params *params)
{
    const hd_dynamics *of = hd_dynamics_of(&set->def);
    for (int k = 0; k < of->parameters; k++) {
        const hd_parameter *row = &of->parameter[k];
        const double value = hd_parameter_value(row, &set->def);
        if (!row->idle || !row->idle(&set->def) || value == row->default_value) continue;
        const size_t length = strlen(set->warning);
        if (*hdr_param_text(params, row->name) && !given_is_of_file(params, row->name))
            snprintf(set->warning + length, sizeof set->warning - length,
                     "%s%s = %.15g has no effect with the other parameters", length ? "; " : "",
                     row->name, value);
    }
}

bool settings_read(settings *out, const hdr_params *params, const hd_checkpoint *kept,
                   char *message, size_t size)
{
    reader r = {.params = params, .message = message, .size = size};
    *out = defaults(kept);
    out->given = params;
    if (!read_what_moves(out, &r) || !check_names(&r) || !read_all(out, &r)) return false;
    if (!resolve_resume(out, &r, kept)) return false;
    if (!kept && !check_scene_name(out, &r)) return false;
    if (!check_particles(out, &r) || !check_ranges(out, &r) || !check_observables(out, &r) ||
        !check_awaited(out, &r) || !check_needs(out, &r))
        return false;
    write_texts(out);
    if (hd_scene_check(&out->def, message, size) != HD_OK ||
        hd_target_check(&out->def, message, size) != HD_OK) {
        make_one_line(message);
        return false;
    }
    warn_of_steps(out);
    warn_of_idle(out, params);
    return check_field_indices(out, &r) && check_slow_vectors(out, &r) &&
           check_changes(out, message, size);
}
