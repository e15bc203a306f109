/** What is needed to repeat a run -> message RunInfo. It is sent once, and again after each change
 * of a parameter. */
#include "topics/moment.h"

#include <stdio.h>
#include <string.h>

#include "hdlyap/hdlyap.h"
#include "node/parameter_value.h"

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

static uint8_t kind_of(const parameter *p)
{
    const hd_parameter_kind of_row = p->row ? p->row->kind : HD_PARAMETER_TEXT;
    if (p->kind == TOPICS_OBSERVED || p->kind == TOPICS_AWAITED) return HDR_PARAMETER_LIST;
    if (p->kind == WHOLE_NUMBER || of_row == HD_PARAMETER_INT) return HDR_PARAMETER_INTEGER;
    const bool number = of_row == HD_PARAMETER_REAL || of_row == HD_PARAMETER_INTERVAL;
    return p->kind == REAL_NUMBER || number ? HDR_PARAMETER_NUMBER : HDR_PARAMETER_WORD;
}

/** True if only these particles have this parameter, and it means something. */
static bool is_own(const parameter *p, const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    return p->row && p->row >= of->parameter && p->row < of->parameter + of->parameters &&
           !(p->row->idle && p->row->idle(def));
}

/** Fills the parameters with their present values. */
static bool fill_parameters(hdr_run_info *info, const moment *now)
{
    const size_t most = (size_t)parameters_count();
    const bool in_box = hd_scene_dimension(&now->set->def) > 0;
    hdr_parameter *list = moment_take(now, most, sizeof *list);
    char(*room)[PARAMETER_VALUE] = moment_take(now, 2 * most, sizeof *room);
    if (!list || !room) return false;
    uint32_t count = 0;
    for (int k = 0; k < (int)most; k++, room += 2) {
        const parameter p = parameters_at(k);
        const bool own = is_own(&p, &now->set->def);
        const hd_scene_def *def = own ? hd_run_scene(now->run) /* which has what it chose */
                                      : &now->set->def;
        const char *value = parameter_value(room[0], &p, now->set);
        if (p.kind == CHANGES || (!in_box && p.row && hd_parameter_is_of_box(p.row))) continue;
        list[count++] = (hdr_parameter){
            .name = p.name,
            .kind = kind_of(&p),
            .value = value,
            .effect = parameter_effect(room[1], &p, def, hd_run_threads(now->run), value),
            .unit = p.unit,
            .as_before = !p.may_differ,
            .own = own};
    }
    info->parameters = (hdr_parameter_list){list, count};
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

/** Fills what follows from the parameters of the scene. */
static void fill_scene(hdr_run_info *info, const hd_scene_def *def)
{
    double box[HD_DIMENSION_MAX] = {0.0};
    if (hd_scene_dimension(def) > 0) hd_scene_box(def, box);
    info->dimension = (uint32_t)hd_scene_dimension(def);
    info->coordinates = (uint32_t)hd_scene_coordinates(def);
    info->inertia = hd_scene_inertia(def);
    info->packing_fraction = hd_scene_packing(def);
    info->box_x = box[0];
    info->box_y = box[1];
    info->box_z = hd_scene_dimension(def) == 3 ? box[2] : 0.0;
    info->zero_exponents = (uint32_t)hd_scene_counts(def).zero;
}

/** Fills where a particle has its disks. */
static bool fill_sites(hdr_run_info *info, const moment *now)
{
    double *site = moment_take(now, HD_SITES_MAX, sizeof *site);
    if (!site) return false;
    info->sites = (hdr_doubles){site, (uint32_t)hd_scene_sites(&now->set->def, site), 1};
    return true;
}

/** Fills numbers, sizes and masses of the kinds of particles. */
static bool fill_kinds(hdr_run_info *info, const moment *now)
{
    hd_kind kind[HD_KINDS_MAX];
    uint32_t *number = moment_take(now, HD_KINDS_MAX, sizeof *number);
    double *real = moment_take(now, 2 * HD_KINDS_MAX, sizeof *real);
    if (!number || !real) return false;
    const uint32_t count = (uint32_t)hd_scene_kinds(&now->set->def, kind);
    for (uint32_t k = 0; k < count; k++) {
        number[k] = (uint32_t)kind[k].number;
        real[k] = kind[k].diameter;
        real[HD_KINDS_MAX + k] = kind[k].mass;
    }
    info->kind_numbers = (hdr_uints){number, count};
    info->kind_diameters = (hdr_doubles){real, count, 1};
    info->kind_masses = (hdr_doubles){real + HD_KINDS_MAX, count, 1};
    return true;
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
    hdr_run_info info = {.resumed_time = now->changes->since};
    if (!fill_waves(&info, now) || !fill_outline(&info, now) || !fill_sites(&info, now) ||
        !fill_kinds(&info, now) || !fill_changes(&info, now) || !fill_parameters(&info, now) ||
        !fill_given(&info, now))
        return HD_OK;
    fill_scene(&info, &now->set->def);
    fill_machine(&info, now->run);
    return topic_send_run_info(now->out, &info);
}
