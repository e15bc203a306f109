/** What is needed to repeat a run -> RunInfo: once, and after a change of parameters. */
#include "topics/run_info.h"

#include <stdlib.h>

#include "hdlyap/hdlyap.h"
#include "node/parameters.h"
#include "topics/moment.h"

/** Value of a parameter of the scene that has words. */
static const char *word_of(const char *name, const hd_scene_def *def)
{
    const parameter p = parameters_named(name);
    return hd_parameter_word_of(p.row, (int)hd_parameter_value(p.row, def));
}

/** [count] names of a set of topics. */
static uint32_t names_of(const char *names[TOPICS], unsigned set)
{
    uint32_t count = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t)) names[count++] = topic_name(t);
    return count;
}

/** Nodes of the wave vectors that are classified; none where nothing needs them. */
typedef struct wave_list {
    uint32_t count;
    uint32_t *nx, *ny; /**< in one block at nx */
} wave_list;

static bool waves_create(wave_list *list, const hd_scene_def *def)
{
    const int count = def->observe & HD_OBSERVE_WAVES ? hd_waves(def, NULL, 0) : 0;
    hd_wave *waves = malloc(((size_t)count + 1) * sizeof *waves);
    *list = (wave_list){.nx = malloc((2 * (size_t)count + 1) * sizeof *list->nx)};
    const bool created = waves && list->nx;
    if (created) {
        list->count = (uint32_t)count;
        list->ny = list->nx + count;
        hd_waves(def, waves, count);
    }
    for (uint32_t k = 0; k < list->count; k++) {
        list->nx[k] = (uint32_t)waves[k].n[0];
        list->ny[k] = (uint32_t)waves[k].n[1];
    }
    free(waves);
    return created;
}

/** Those that have been made; NULL without memory. */
static hdr_change *changes_listed(const changes *all)
{
    hdr_change *list = malloc(((size_t)all->made + 1) * sizeof *list);
    for (int k = 0; list && k < all->made; k++) {
        const change *c = &all->list[k];
        list[k] = (hdr_change){
            .sim_time = c->time, .name = c->name, .before = c->before, .value = c->value};
    }
    return list;
}

/** What the scene says. A parameter of it without a field in RunInfo.msg does not compile. */
static void fill_scene(hdr_run_info *info, const settings *set)
{
    const hd_scene_def *def = &set->def;
    double box[2];
    hd_scene_box(def, box);
    info->scene = set->scene;
    info->box_x = box[0];
    info->box_y = box[1];
    info->boundary_x = word_of("boundary_x", def);
    info->boundary_y = word_of("boundary_y", def);
    info->seed = set->seed;
    info->exponents = set->exponents;
    info->zero_exponents = (uint32_t)hd_scene_zero_exponents(def);
    info->interval = def->interval;
    info->phase_interval = def->phase_interval;
    info->warmup = hd_scene_warmup(def);
    info->covariant_storage = word_of("covariant_storage", def);
#define HD_INT(name, ...) info->name = (uint32_t)def->name;
#define HD_REAL(name, ...) info->name = def->name;
#define HD_OTHER(...)
#include "hdlyap/parameters.inc"
}

/** What it runs on. */
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

hdr_status run_info_publish(const publishers *out, const settings *set, const hd_run *run,
                            const changes *all)
{
    const char *names[TOPICS], *awaited[TOPICS];
    wave_list waves;
    hdr_change *changed = changes_listed(all);
    const bool created = waves_create(&waves, &set->def) && changed;
    hdr_run_info info = {
        .header = message_header(),
        .run_id = out->run_id,
        .observables = {.data = names, .count = names_of(names, set->observables)},
        .wave_nx = {.data = waves.nx, .count = waves.count},
        .wave_ny = {.data = waves.ny, .count = waves.count},
        .field_indices = set->fields.text,
        .field_interval = set->field_interval,
        .wait_for_subscribers = {.data = awaited, .count = names_of(awaited, set->awaited)},
        .pace = set->pace,
        .slow_vectors_rate = set->slow_vectors_rate,
        .slow_vectors_count = (uint32_t)set->slow_vectors_count,
        .checkpoint = set->checkpoint,
        .checkpoint_interval = set->checkpoint_interval,
        .changes = {.data = changed, .count = (uint32_t)all->made},
        .resume = set->resume,
        .resumed_time = *set->resume ? hd_run_time(run) : -1.0,
    };
    fill_scene(&info, set);
    fill_machine(&info, run);
    hdr_status status = created ? HDR_OK : HDR_NO_MEMORY;
    if (created) status = hdr_run_info_publish(out->publisher[TOPIC_run_info], &info);
    free(waves.nx);
    free(changed);
    return status;
}

const topic_maker topic_run_info = {.size = NULL}; /* one in a bag, whatever the scene */
