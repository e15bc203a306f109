/** A row and a scene -> particles that are moved, kept and made again. */
#include "dynamics/trial.h"

#include <math.h>

#include "base/arrays.h"
#include "base/check.h"
#include "base/memory.h"
#include "scene/scene.h"

hd_status hd_trial_create(hd_trial *t, const hd_dynamics *row, const hd_scene_def *scene,
                          char *message, size_t size)
{
    *t = (hd_trial){.of = row,
                    .scene = *scene,
                    .rows = 2 * (size_t)(row->coordinates * scene->number),
                    .unit = hd_scene_collision_time(scene),
                    .random = hd_random_seeded(scene->seed, 1),
                    .message = message,
                    .size = size};
    HD_TRY(hd_maps_create_of(&t->maps, &t->scene));
    t->file = tmpfile();
    if (t->file) return HD_OK;
    (void)hd_refuse(message, size, "there is no room for a temporary file");
    return HD_FILE_FAULT;
}

void hd_trial_clear(hd_trial *t)
{
    if (t->maps) hd_maps_free_of(t->of, t->maps);
    if (t->file) (void)fclose(t->file);
}

double hd_trial_time(const hd_trial *t, double units, double entries)
{
    return fmin(units * t->unit, entries / t->of->record_rate(&t->scene));
}

double hd_trial_random(hd_trial *t) { return 0.5 + 0.5 * hd_random_symmetric(&t->random); }

static hd_status advance(hd_trial *t, hd_trajectory *tr, hd_record *record, double t_end,
                         const char *member)
{
    const hd_status status = hd_trajectory_extend(tr, record, t_end);
    const char *told = hd_trajectory_fault(tr);
    if (status == HD_OK || status == HD_NO_MEMORY) return status;
    return hd_refuse(t->message, t->size, "%s: %s", member, *told ? told : hd_status_text(status));
}

hd_status hd_trial_advance(hd_trial *t, hd_trajectory *tr, hd_record *record, double t_end)
{
    return advance(t, tr, record, t_end, "advance");
}

hd_status hd_trial_advance_made(hd_trial *t, hd_trajectory *tr, hd_record *record, double t_end)
{
    return advance(t, tr, record, t_end,
                   "archive: a state that was written and read into a new one cannot go on");
}

/* ---- archive ------------------------------------------------------------------------------- */

/** The line of an archive that has failed. */
static hd_status refuse_archive(hd_trial *t, const hd_archive *archive, const char *when)
{
    if (archive->status == HD_NO_MEMORY) return HD_NO_MEMORY;
    return hd_refuse(t->message, t->size, "archive: %s, the array %s: %s", when,
                     archive->name ? archive->name : "?",
                     archive->fault ? archive->fault : hd_status_text(archive->status));
}

hd_status hd_trial_keep(hd_trial *t, hd_image *out, hd_trajectory *tr)
{
    rewind(t->file);
    hd_archive archive = hd_archive_writer(t->file);
    hd_trajectory_archive(tr, &archive);
    if (hd_archive_end(&archive) != HD_OK) return refuse_archive(t, &archive, "writing");
    *out = (hd_image){hd_memory_alloc(archive.bytes, 1), archive.bytes};
    if (!out->bytes) return HD_NO_MEMORY;
    rewind(t->file);
    return fread(out->bytes, 1, out->size, t->file) == out->size ? HD_OK : HD_FILE_FAULT;
}

hd_status hd_trial_make(hd_trial *t, hd_trajectory **out, const hd_image *image)
{
    hd_trajectory *tr;
    *out = NULL;
    HD_TRY(hd_trajectory_create(&tr, &t->scene));
    rewind(t->file);
    const bool written = fwrite(image->bytes, 1, image->size, t->file) == image->size;
    rewind(t->file);
    hd_archive archive = hd_archive_reader(t->file, image->size);
    if (written) hd_trajectory_archive(tr, &archive);
    hd_status status = written ? hd_archive_end(&archive) : HD_FILE_FAULT;
    if (written && status != HD_OK)
        status = refuse_archive(t, &archive, "reading what it has written");
    if (status == HD_OK)
        *out = tr;
    else
        hd_trajectory_free(tr);
    return status;
}

/* ---- a way --------------------------------------------------------------------------------- */

static void tell(const hd_trial *t, const hd_trajectory *tr, double *x)
{
    if (x) hd_trajectory_state(tr, x, x + t->rows / 2);
}

hd_status hd_trial_go(hd_trial *t, hd_record **record, double *begin, double *end,
                      const hd_image *image, double time)
{
    hd_trajectory *tr;
    if (record) HD_TRY(hd_record_create(record, t->of->entry));
    HD_TRY(hd_trial_make(t, &tr, image));
    tell(t, tr, begin);
    const hd_status status = hd_trial_advance(t, tr, record ? *record : NULL,
                                              hd_trajectory_time(tr) + time);
    tell(t, tr, end);
    hd_trajectory_free(tr);
    return status;
}

hd_status hd_trial_carry(hd_trial *t, double *block, int width, const hd_record *record,
                         double begin, double end)
{
    HD_TRY(hd_maps_fill_of(t->of, t->maps, record, begin, end));
    t->of->carry(t->maps, block, width);
    return hd_all_finite(block, t->rows * (size_t)width)
               ? HD_OK
               : hd_refuse(t->message, t->size,
                           "carry: a component of a tangent vector is not finite after the times "
                           "from %g to %g of a record",
                           begin, end);
}
