/** As node.c begins a run. */
#include "begin.h"

#include <string.h>

#include "node/checkpoint_writer.h"
#include "node/settings.h"
#include "topics/moment.h"

/** Two disks, with the own parameters of the scene if that has disks, too. */
static hd_scene_def two_of(const hd_scene_def *asked)
{
    hd_scene_def two = hd_scene_def_default();
    two.number = 2;
    two.density = 0.1;
    two.aspect = 1.0;
    two.exponents = HD_EXPONENTS_NONE;
    if (asked->particles == two.particles) memcpy(two.own, asked->own, sizeof two.own);
    return two;
}

bool begin_run(const hdr_params *params, bool tiny, char *line, size_t size)
{
    const changes none = {.since = -1.0};
    const publishers out = {.run_id = "begun"};
    const char *resume;
    settings set;
    hd_run *run = NULL;
    if (!settings_resume(&resume, params, line, size) ||
        !settings_read(&set, params, NULL, line, size) ||
        checkpoint_writer_check(&set, line, size) != HD_OK)
        return false;
    const hd_scene_def two = two_of(&set.def);
    if (hd_run_create_shared(&run, tiny ? &two : &set.def, NULL, line, size) != HD_OK) return false;
    buffers room = {.taken = 0};
    const moment now = {.out = &out, .set = &set, .run = run, .room = &room, .changes = &none};
    const bool published = topic_publish_run_info(&now) == HD_OK;
    buffers_clear(&room);
    hd_run_free(run);
    return published;
}

/** In place of the wrapper's. */
hdr_lag hdr_publisher_lag(hdr_publisher *publisher) { return *(hdr_lag *)publisher; }

hdr_lag worst_of(hdr_lag *each, int count)
{
    publishers out = {.node = ""};
    for (int k = 0; k < count; k++) out.publisher[k] = (hdr_publisher *)&each[k];
    return publishers_lag(&out);
}
