/** What is needed to repeat a run -> message RunInfo. It is sent once, and again after each change
 * of a parameter. */
#include "topics/moment.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hdlyap/hdlyap.h"
#include "node/parameters.h"

/** The word that is the value of a parameter of the scene. */
static const char *word_of(const char *name, const hd_scene_def *def)
{
    const parameter p = parameters_named(name);
    return hd_parameter_word_of(p.row, (int)hd_parameter_value(p.row, def));
}

/** Fills the names of a set of topics. Returns their number. */
static uint32_t names_of(const char *names[TOPICS], unsigned set)
{
    uint32_t count = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t)) names[count++] = topic_name(t);
    return count;
}

/** Fills the nodes of the wave vectors that are classified; none if no observable needs them. */
static bool fill_waves(hdr_run_info *info, const moment *now)
{
    const hd_scene_def *def = &now->set->def;
    const uint32_t count = def->observe & HD_OBSERVE_WAVES ? (uint32_t)hd_waves(def, NULL, 0) : 0;
    hd_wave *waves = moment_take(now, count, sizeof *waves);
    uint32_t *nodes = moment_take(now, 3 * (size_t)count, sizeof *nodes);
    if (!waves || !nodes) return false;
    hd_waves(def, waves, (int)count);
    for (uint32_t k = 0; k < count; k++) {
        for (uint32_t d = 0; d < 3; d++) nodes[d * count + k] = (uint32_t)waves[k].n[d];
    }
    info->wave_nx = (hdr_uints){nodes, count};
    info->wave_ny = (hdr_uints){nodes + count, count};
    info->wave_nz = (hdr_uints){nodes + 2 * (size_t)count, count};
    return true;
}

/** Fills the changes that have been made so far. */
static bool fill_changes(hdr_run_info *info, const moment *now)
{
    const int count = now->changes->made;
    hdr_change *list = moment_take(now, (size_t)count, sizeof *list);
    for (int k = 0; list && k < count; k++) {
        const change *c = &now->changes->list[k];
        list[k] = (hdr_change){
            .sim_time = c->time, .name = c->name, .before = c->before, .value = c->value};
    }
    info->changes = (hdr_change_list){list, (uint32_t)count};
    return list;
}

/** Writes a parameter as name=value, exact to the last bit. */
static void write_own(char *text, size_t size, const hd_parameter *row, double value)
{
    const char *word = hd_parameter_is_word(row, value) ? hd_parameter_word_of(row, (int)value)
                                                        : NULL;
    char digits[32];
    snprintf(digits, sizeof digits, "%.15g", value);
    if (strtod(digits, NULL) != value) snprintf(digits, sizeof digits, "%.17g", value);
    snprintf(text, size, "%s=%s", row->name, word ? word : digits);
}

/** Fills the parameters that only these particles have. */
static bool fill_own(hdr_run_info *info, const moment *now)
{
    enum { LENGTH = 80 };
    const hd_scene_def *def = hd_run_scene(now->run); /* which knows what was chosen */
    const hd_dynamics *of = hd_dynamics_of(def);
    const uint32_t count = (uint32_t)of->parameters;
    const char **list = moment_take(now, count, sizeof *list);
    char *text = moment_take(now, LENGTH * (size_t)count, 1);
    if (!list || !text) return false;
    for (uint32_t k = 0; k < count; k++, text += LENGTH) {
        const hd_parameter *row = &of->parameter[k];
        list[k] = text;
        write_own(text, LENGTH, row, hd_parameter_effect(row, def));
    }
    info->own = (hdr_strings){list, count};
    return true;
}

/** Fills the parameters that were given, as they were written. */
static bool fill_given(hdr_run_info *info, const moment *now)
{
    const hdr_params *given = now->set->given;
    const int count = given ? hdr_params_count(given) : 0;
    size_t size = 0;
    for (int k = 0; k < count; k++) {
        const char *name = hdr_params_name(given, k);
        size += strlen(name) + strlen(hdr_param_text(given, name)) + sizeof "=";
    }
    const char **list = moment_take(now, (size_t)count, sizeof *list);
    char *text = moment_take(now, size, 1);
    if (!list || !text) return false;
    for (int k = 0; k < count; k++) {
        const char *name = hdr_params_name(given, k);
        list[k] = text;
        text += sprintf(text, "%s=%s", name, hdr_param_text(given, name)) + 1;
    }
    info->given = (hdr_strings){list, (uint32_t)count};
    return true;
}

/** Fills the parameters of the scene. One that RunInfo.msg lacks does not compile. */
static void fill_scene(hdr_run_info *info, const settings *set)
{
    const hd_scene_def *def = &set->def;
    const bool has_z = hd_scene_dimension(def) == 3;
    double box[HD_DIMENSION_MAX];
    hd_scene_box(def, box);
    info->scene = set->scene;
    info->particles = set->particles;
    info->dimension = (uint32_t)hd_scene_dimension(def);
    info->coordinates = (uint32_t)hd_scene_coordinates(def);
    info->inertia = hd_scene_inertia(def);
    info->packing_fraction = hd_scene_packing(def);
    info->box_x = box[0];
    info->box_y = box[1];
    info->box_z = has_z ? box[2] : 0.0;
    info->container = word_of("container", def);
    info->boundary_x = hd_scene_boundary_word(def, 0);
    info->boundary_y = hd_scene_boundary_word(def, 1);
    info->boundary_z = hd_scene_boundary_word(def, 2);
    info->seed = set->seed;
    info->exponents = set->exponents;
    info->zero_exponents = (uint32_t)hd_scene_counts(def).zero;
    info->target = def->target.line;
    info->interval = def->interval;
    info->phase_interval = def->phase_interval;
    info->fluctuation_time = def->fluctuation_time;
    info->warmup = hd_scene_warmup(def);
#define HD_INT(name, ...) info->name = (uint32_t)def->name;
#define HD_REAL(name, ...) info->name = def->name;
#define HD_OTHER(...)
#include "hdlyap/parameters.inc"
    if (def->aspect * box[0] != box[1]) info->aspect = box[1] / box[0]; /* a circle has its own */
}

/** Fills the outline of a curved container; it is empty for a box. */
static bool fill_outline(hdr_run_info *info, const moment *now)
{
    double *x = moment_take(now, 2 * HD_OUTLINE, sizeof *x);
    if (!x) return false;
    const uint32_t count = (uint32_t)hd_scene_outline(&now->set->def, x, x + HD_OUTLINE);
    info->outline_x = (hdr_doubles){x, count, 1};
    info->outline_y = (hdr_doubles){x + HD_OUTLINE, count, 1};
    return true;
}

/** Fills the version, ranks, threads and BLAS of the run. */
static void fill_machine(hdr_run_info *info, const hd_run *run)
{
    const hd_blas blas = hd_blas_query();
    info->version = HDLYAP_VERSION;
    info->vectors = (uint32_t)hd_run_vectors(run);
    info->ranks = (uint32_t)hd_run_ranks(run);
    info->threads = (uint32_t)hd_run_threads(run);
    info->blas_threads = (uint32_t)blas.threads;
    info->blas_library = blas.library;
    info->blas_kernel = blas.kernel;
    info->blas_threading = blas.threading;
}

hd_status topic_publish_run_info(const moment *now)
{
    const settings *set = now->set;
    const char *names[TOPICS], *awaited[TOPICS];
    hdr_run_info info = {
        .observables = {.data = names, .count = names_of(names, set->observables)},
        .field_indices = set->fields.text,
        .wait_for_subscribers = {.data = awaited, .count = names_of(awaited, set->awaited)},
        .slow_subscribers = set->slow_subscribers,
        .pace = set->pace,
        .slow_vectors_rate = set->slow_vectors_rate,
        .slow_vectors_count = (uint32_t)set->slow_vectors_count,
        .checkpoint = set->checkpoint,
        .checkpoint_interval = set->checkpoint_interval,
        .resume = set->resume,
        .resumed_time = now->changes->since,
    };
    if (!fill_waves(&info, now) || !fill_outline(&info, now) || !fill_changes(&info, now) ||
        !fill_own(&info, now) || !fill_given(&info, now))
        return HD_OK;
    fill_scene(&info, set);
    fill_machine(&info, now->run);
    return topic_send_run_info(now->out, &info);
}
