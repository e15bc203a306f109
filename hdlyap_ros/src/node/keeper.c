/** Settings and run -> checkpoints. */
#include "keeper.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "clock.h"
#include "hdlyap_ros/node.h"

static double next_due(const settings *set)
{
    const bool periodic = *set->checkpoint && set->checkpoint_interval > 0.0;
    return periodic ? clock_seconds() + set->checkpoint_interval : INFINITY;
}

static bool is_same_file(const struct stat *a, const char *path)
{
    struct stat b;
    return *path && stat(path, &b) == 0 && a->st_dev == b.st_dev && a->st_ino == b.st_ino;
}

static hd_status set_aside(const settings *set, char *message, size_t size)
{
    char old[PATH_MAX];
    struct stat found;
    if (stat(set->checkpoint, &found) != 0) return HD_OK;
    if (is_same_file(&found, set->resume)) return HD_OK;
    const int length = snprintf(old, sizeof old, "%s.old", set->checkpoint);
    if (length >= (int)sizeof old || rename(set->checkpoint, old) != 0) {
        snprintf(message, size, "%.200s: cannot be set aside: %s", set->checkpoint, strerror(errno));
        return HD_FILE_FAULT;
    }
    hdr_log(HDR_WARN, "%s is of another run: it is now %s", set->checkpoint, old);
    return HD_OK;
}

hd_status keeper_begin(const settings *set, hd_run *run, char *message, size_t size)
{
    if (!*set->checkpoint) return HD_OK;
    const hd_status status = set_aside(set, message, size);
    return status == HD_OK ? hd_run_save(run, set->checkpoint, set->scene, message, size) : status;
}

keeper keeper_of(const settings *set, const hd_run *run)
{
    return (keeper){.set = set,
                    .due = next_due(set),
                    .state = {.time = *set->checkpoint ? hd_run_time(run) : -1.0}};
}

bool keeper_due(const keeper *k) { return k->due < INFINITY && clock_seconds() >= k->due; }

void keeper_save(keeper *k, hd_run *run)
{
    const settings *set = k->set;
    kept *state = &k->state;
    if (!*set->checkpoint) return;
    const bool failed = hd_run_save(run, set->checkpoint, set->scene, state->message,
                                    sizeof state->message) != HD_OK;
    if (failed) hdr_log(HDR_ERROR, "checkpoint not written: %s", state->message);
    if (!failed && state->failed) hdr_log(HDR_INFO, "checkpoint written again");
    if (!failed) state->time = hd_run_time(run);
    state->failed = failed;
    k->due = next_due(set);
}
