/** Settings and run -> run_info. */
#include "run_info.h"

#include <stdlib.h>

#include "hdlyap/hdlyap.h"

static const char *boundary_name(hd_boundary boundary)
{
    return boundary == HD_PERIODIC ? "periodic" : "reflecting";
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
    const int count = def->observe ? hd_waves(def, NULL, 0) : 0;
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

/** What the scene says. */
static void fill_scene(hdr_run_info *info, const settings *set)
{
    const hd_scene_def *def = &set->def;
    double box[2];
    hd_scene_box(def, box);
    info->scene = set->scene;
    info->disks = (uint32_t)def->disks;
    info->density = def->density;
    info->aspect = def->aspect;
    info->box_x = box[0];
    info->box_y = box[1];
    info->boundary_x = boundary_name(def->boundary[0]);
    info->boundary_y = boundary_name(def->boundary[1]);
    info->seed = set->seed;
    info->exponents = set->exponents;
    info->zero_exponents = (uint32_t)hd_scene_zero_exponents(def);
    info->equilibration = def->equilibration;
    info->warmup = def->warmup;
    info->duration = def->duration;
    info->target_std_error = def->target_std_error;
    info->interval = def->interval;
    info->accuracy = def->accuracy;
    info->report_interval = def->report_interval;
    info->max_wave_number = def->max_wave_number;
    info->max_mode_number = (uint32_t)def->max_mode_number;
    info->covariant_window = def->covariant_window;
    info->covariant_transient = def->covariant_transient;
    info->covariant_sampling = def->covariant_sampling;
    info->covariant_memory = def->covariant_memory / BYTES_PER_GB;
    info->covariant_storage = settings_storage_name(def->covariant_storage);
}

/** What it runs on. */
static void fill_machine(hdr_run_info *info, const hd_run *run)
{
    const hd_blas blas = hd_blas_query();
    info->version = HDLYAP_VERSION;
    info->vectors = (uint32_t)hd_run_vectors(run);
    info->threads = (uint32_t)hd_run_threads(run);
    info->blas_threads = (uint32_t)blas.threads;
    info->blas_library = blas.library;
    info->blas_kernel = blas.kernel;
    info->blas_threading = blas.threading;
}

hdr_status run_info_publish(const publishers *out, const settings *set, const hd_run *run)
{
    const char *names[TOPICS], *awaited[TOPICS];
    wave_list waves;
    hdr_status status = waves_create(&waves, &set->def) ? HDR_OK : HDR_NO_MEMORY;
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
        .resume = set->resume,
        .resumed_time = *set->resume ? hd_run_time(run) : -1.0,
    };
    fill_scene(&info, set);
    fill_machine(&info, run);
    if (status == HDR_OK) status = hdr_run_info_publish(out->publisher[TOPIC_RUN_INFO], &info);
    free(waves.nx);
    return status;
}
