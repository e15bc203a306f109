/** The usual functions, for what a row of dynamics leaves out: its maps are a part of the record;
 * and what entries of all records have in common: they are doubles. */
#include <math.h>
#include <stdbool.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/dynamics.h"
#include "dynamics/record.h"
#include "scene/scene.h"

/* ---- tangent maps -------------------------------------------------------------------------- */

hd_status hd_maps_create_of(void **maps, const hd_scene_def *scene)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    if (of->maps_create) return of->maps_create(maps, scene);
    hd_record_slice *slice = *maps = hd_memory_alloc(1, sizeof *slice);
    if (!slice) return HD_NO_MEMORY;
    slice->particles = scene->number;
    slice->scene = scene;
    return HD_OK;
}

void hd_maps_free_of(const hd_dynamics *of, void *maps)
{
    if (of->maps_free)
        of->maps_free(maps);
    else
        hd_memory_free(maps);
}

hd_status hd_maps_fill_of(const hd_dynamics *of, void *maps, const hd_record *record,
                          double t_begin, double t_end)
{
    if (of->maps_fill) return of->maps_fill(maps, record, t_begin, t_end);
    hd_record_slice *slice = maps;
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    slice->count = those.end - those.first;
    slice->entry = slice->count > 0 ? hd_record_entry(record, those.first) : NULL;
    slice->begin = t_begin;
    slice->end = t_end;
    return HD_OK;
}

hd_status hd_null_vectors_of(int *count, const hd_scene_def *scene, const double *q,
                             const double *p, double *column)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    *count = of->null_vectors ? of->null_vectors(scene, q, p, column) : 0;
    if (*count == -1) return HD_NO_MEMORY;
    return *count >= 0 && *count <= hd_scene_zero_exponents(scene) ? HD_OK : HD_DYNAMICS_FAULT;
}

/* ---- record -------------------------------------------------------------------------------- */

static size_t doubles_of(const hd_record *record)
{
    return record->count * (record->size / sizeof(double));
}

static const char *usual_fault(const hd_record *record)
{
    const size_t step = record->size / sizeof(double);
    const double *x = record->entry;
    double before = 0.0;
    for (size_t k = 0; k < doubles_of(record); k++) {
        if (!isfinite(x[k])) return "a number is not finite";
        if (k % step > 0) continue;
        if (!(x[k] >= before)) return "an entry comes before the one before it";
        if (!(x[k] <= record->duration)) return "an entry comes after the end of the record";
        before = x[k];
    }
    return NULL;
}

const char *hd_record_fault(const hd_record *record, const hd_scene_def *scene)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    const char *usual = usual_fault(record);
    return usual || !of->fault ? usual : of->fault(record, scene);
}

void hd_record_archive(hd_record *record, hd_archive *archive, const hd_scene_def *scene)
{
    size_t count = record->count;
    hd_archive_double(archive, "log duration", &record->duration);
    hd_archive_count(archive, "log count", &count, record->size);
    if (!archive->writing && hd_archive_good(archive)) {
        const hd_status status = hd_record_reserve(record, count);
        if (status != HD_OK)
            hd_archive_fail(archive, status, "log count", "there is no memory for so many entries");
        record->count = status == HD_OK ? count : 0;
    }
    if (!hd_archive_good(archive)) return;
    hd_archive_doubles(archive, "log entries", record->entry, doubles_of(record));
    const char *fault = hd_record_fault(record, scene);
    if (fault) hd_archive_refuse(archive, "log", fault);
}

double hd_record_bytes_of(const hd_scene_def *scene, double entries)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    return of->record_bytes ? of->record_bytes(entries) : hd_record_bytes(2.0 * entries, of->entry);
}

/* ---- particles ----------------------------------------------------------------------------- */

double hd_trajectory_bytes(const hd_scene_def *scene)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    const double noted = hd_trajectory_noted(scene) * sizeof(double);
    return noted + (of->bytes ? of->bytes(scene)
                              : 4.0 * of->coordinates * (double)scene->number * sizeof(double));
}
