/** Defaults of what is asked for, and what follows from it. */
#include "hdlyap/scene.h"

#include <math.h>

#include "scene/archived.h"
#include "scene/scene_check.h"

hd_scene_def hd_scene_def_default(void)
{
    return (hd_scene_def){
        .disks = 780,
        .density = 0.8,
        .aspect = 0.867,
        .boundary = {HD_PERIODIC, HD_PERIODIC},
        .seed = 1,
        .exponents = HD_EXPONENTS_POSITIVE,
        .equilibration = 100.0,
        .warmup = 50.0,
        .duration = 0.0,
        .target_std_error = 0.0,
        .interval = 0.0,
        .accuracy = 1e-8,
        .report_interval = 1.0,
        .observe = 0,
        .max_wave_number = 0.0,
        .max_mode_number = 0,
        .threads = 0,
        .covariant_window = 50.0,
        .covariant_transient = 100.0,
        .covariant_sampling = 5.0,
        .covariant_memory = 4e9,
        .covariant_storage = HD_STORAGE_MEMORY,
    };
}

void hd_scene_box(const hd_scene_def *def, double box[2])
{
    box[0] = sqrt((double)def->disks / (def->density * def->aspect));
    box[1] = def->aspect * box[0];
}

int hd_scene_zero_exponents(const hd_scene_def *def)
{
    return 2 + 2 * (def->boundary[0] == HD_PERIODIC) + 2 * (def->boundary[1] == HD_PERIODIC);
}

int hd_scene_vectors(const hd_scene_def *def)
{
    const int all = 4 * def->disks;
    if (def->exponents == HD_EXPONENTS_ALL) return all;
    if (def->exponents == HD_EXPONENTS_POSITIVE) return (all - hd_scene_zero_exponents(def)) / 2;
    return def->exponents;
}

/** Ranges beyond what the types hold are checked with the whole of it. */
void hd_scene_archive(hd_scene_def *def, hd_archive *archive)
{
    const struct {
        const char *name;
        double *x;
    } doubles[] = {{"scene density", &def->density},
                   {"scene aspect", &def->aspect},
                   {"scene equilibration", &def->equilibration},
                   {"scene warmup", &def->warmup},
                   {"scene duration", &def->duration},
                   {"scene target_std_error", &def->target_std_error},
                   {"scene interval", &def->interval},
                   {"scene accuracy", &def->accuracy},
                   {"scene report_interval", &def->report_interval},
                   {"scene max_wave_number", &def->max_wave_number},
                   {"scene covariant_window", &def->covariant_window},
                   {"scene covariant_transient", &def->covariant_transient},
                   {"scene covariant_sampling", &def->covariant_sampling},
                   {"scene covariant_memory", &def->covariant_memory}};
    int boundary[2] = {(int)def->boundary[0], (int)def->boundary[1]}, observe = (int)def->observe;
    int storage = (int)def->covariant_storage;
    hd_archive_int(archive, "scene disks", &def->disks, HD_DISKS_MIN, HD_DISKS_MAX);
    hd_archive_int(archive, "scene boundary x", &boundary[0], HD_PERIODIC, HD_REFLECTING);
    hd_archive_int(archive, "scene boundary y", &boundary[1], HD_PERIODIC, HD_REFLECTING);
    hd_archive_bits(archive, "scene seed", &def->seed);
    hd_archive_int(archive, "scene exponents", &def->exponents, HD_EXPONENTS_ALL, 4 * HD_DISKS_MAX);
    hd_archive_int(archive, "scene observe", &observe, 0, HD_OBSERVE_ALL);
    hd_archive_int(archive, "scene max_mode_number", &def->max_mode_number, 0, HD_DISKS_MAX);
    hd_archive_int(archive, "scene threads", &def->threads, 0, HD_THREADS_MAX);
    hd_archive_int(archive, "scene covariant_storage", &storage, HD_STORAGE_MEMORY,
                   HD_STORAGE_RECOMPUTE);
    for (size_t k = 0; k < sizeof doubles / sizeof *doubles; k++)
        hd_archive_double(archive, doubles[k].name, doubles[k].x);
    for (int d = 0; d < 2; d++) def->boundary[d] = (hd_boundary)boundary[d];
    def->observe = (unsigned)observe;
    def->covariant_storage = (hd_storage)storage;
}
