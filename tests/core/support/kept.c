/** See kept.h. */
#define _POSIX_C_SOURCE 200809L
#include <sys/stat.h>
#include "kept.h"

hd_scene_def kept_scene(int disks, double density, double aspect, int exponents, unsigned observe)
{
    return scene(.number = disks, .density = density, .aspect = aspect, .seed = 7,
                 .exponents = exponents, .observe = observe, .equilibration = 3.0, .warmup = 20.0,
                 .duration = 20.0, .threads = 1);
}

hd_run *kept_run(hd_scene_def def)
{
    hd_run *run;
    char message[256] = "";
    if (hd_run_create(&run, &def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    return run;
}

/** How many were taken: fewer at the end of the run. */
int kept_steps(hd_run *run, int count)
{
    int taken = 0;
    for (; taken < count && hd_run_stage(run) != HD_FINISHED; taken++)
        CHECK_OK(hd_run_advance(run));
    return taken;
}

hd_run *kept_and_resumed(hd_run *run, const char *path, const hd_scene_def *scene)
{
    hd_run *resumed;
    char message[512] = "";
    CHECK_OK(hd_run_save(run, path, KEPT_LABEL, message, sizeof message));
    if (hd_run_resume(&resumed, path, scene, message, sizeof message) != HD_OK)
        fail_msg("%s", message);
    return resumed;
}

bytes kept_bytes(hd_run *run)
{
    bytes b = {NULL, 0};
    FILE *file = open_memstream(&b.data, &b.size);
    hd_archive archive = hd_archive_writer(file);
    hd_run_write(run, &archive, KEPT_LABEL);
    if (hd_archive_end(&archive) != HD_OK) fail_msg("%s: %s", archive.name, archive.fault);
    fclose(file);
    return b;
}

hd_status kept_read(hd_run **run, const bytes *b, const hd_scene_def *scene, char *message,
                    size_t size)
{
    FILE *file = fmemopen(b->data, b->size, "rb");
    hd_archive archive = hd_archive_reader(file, b->size);
    const hd_status status = hd_run_read(run, &archive, scene, NULL, message, size);
    fclose(file);
    return status;
}

size_t kept_element_size(const char *type) { return type[0] == 'S' ? 1 : 8; }

size_t kept_array_size(const char *name)
{
    int64_t count;
    memcpy(&count, name + KEPT_HEAD - 8, sizeof count);
    return KEPT_HEAD + (size_t)count * kept_element_size(name + HD_ARCHIVE_NAME);
}

bytes kept_file(const char *path)
{
    struct stat found;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &found), 0);
    bytes b = {malloc((size_t)found.st_size), (size_t)found.st_size};
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}
