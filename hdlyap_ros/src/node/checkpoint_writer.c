/** Settings and run -> checkpoints. */
#define _GNU_SOURCE /* O_PATH */
#include "checkpoint_writer.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "clock.h"
#include "hdlyap_ros/node.h"

enum { OLD_FILES_MAX = 99 };

static double next_due(const settings *set)
{
    const bool periodic = *set->checkpoint && set->checkpoint_interval > 0.0;
    return periodic ? clock_seconds() + set->checkpoint_interval : INFINITY;
}

static hd_status fault(const char *path, const char *what, char *message, size_t size)
{
    snprintf(message, size, "%.200s: %s", path, what);
    return HD_FILE_FAULT;
}

/* ---- one at a time ------------------------------------------------------------------------- */

/** Locks the file's folder, so that no other node takes the file between looking and writing.
 * Returns -1 if the lock cannot be had soon, because anybody may hold it; then there is no lock. */
static int folder_lock(const char *path)
{
    enum { TRIES = 50 };
    const struct timespec pause = {.tv_nsec = 10000000};
    char folder[PATH_MAX] = ".";
    const char *slash = strrchr(path, '/');
    if (slash) snprintf(folder, sizeof folder, "%.*s", (int)(slash - path) + 1, path);
    const int folder_file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    for (int tries = 0; folder_file >= 0 && tries < TRIES; tries++) {
        if (flock(folder_file, LOCK_EX | LOCK_NB) == 0) return folder_file;
        if (errno != EWOULDBLOCK) break;
        nanosleep(&pause, NULL);
    }
    if (folder_file >= 0) close(folder_file);
    return -1;
}

static void folder_unlock(int folder_file)
{
    if (folder_file >= 0) close(folder_file);
}

/* ---- the first file ------------------------------------------------------------------------ */

/** True if a file of that name exists that is not the one that the run is resumed from. */
static bool is_anothers(const settings *set)
{
    struct stat there, resumed;
    if (stat(set->checkpoint, &there) != 0) return false;
    return !*set->resume || stat(set->resume, &resumed) != 0 || there.st_dev != resumed.st_dev ||
           there.st_ino != resumed.st_ino;
}

static hd_status set_aside(const char *path, char *message, size_t size)
{
    char old[PATH_MAX] = "";
    for (int k = 1; k <= OLD_FILES_MAX; k++) {
        char number[8] = "";
        if (k > 1) snprintf(number, sizeof number, "%d", k);
        const int length = snprintf(old, sizeof old, "%s.old%s", path, number);
        if (length >= (int)sizeof old) return fault(path, strerror(ENAMETOOLONG), message, size);
        if (access(old, F_OK) == 0) continue;
        if (rename(path, old) != 0) return fault(path, strerror(errno), message, size);
        hdr_log(HDR_WARN, "%s was there already: it is now %s", path, old);
        return HD_OK;
    }
    return fault(path, "is there already, and so are its .old to .old99: remove some", message,
                 size);
}

/** Writes the first file beside an old one, which is replaced only when the new one is whole. */
static hd_status save_first(const settings *set, hd_run *run, char *message, size_t size)
{
    char first[PATH_MAX];
    if (!is_anothers(set)) return hd_run_save(run, set->checkpoint, set->scene, message, size);
    if (snprintf(first, sizeof first, "%s.new", set->checkpoint) >= (int)sizeof first)
        return fault(set->checkpoint, strerror(ENAMETOOLONG), message, size);
    hd_status status = hd_run_save(run, first, set->scene, message, size);
    if (status != HD_OK) return status;
    status = set_aside(set->checkpoint, message, size);
    if (status == HD_OK && rename(first, set->checkpoint) != 0)
        status = fault(set->checkpoint, strerror(errno), message, size);
    if (status != HD_OK) (void)unlink(first);
    return status;
}

/** Remembers the identity of the file that was written. */
static void remember(checkpoint_writer *k)
{
    if (k->written >= 0) close(k->written);
    k->written = open(k->set->checkpoint, O_PATH | O_CLOEXEC);
}

hd_status checkpoint_writer_check(const settings *set, char *message, size_t size)
{
    if (!*set->checkpoint) return HD_OK;
    const int lock = folder_lock(set->checkpoint);
    const hd_status status = hd_checkpoint_writable(set->checkpoint, message, size);
    folder_unlock(lock);
    return status;
}

hd_status checkpoint_writer_begin(checkpoint_writer *out, const settings *set, hd_run *run,
                                  char *message, size_t size)
{
    *out = (checkpoint_writer){.set = set, .due = INFINITY, .written = -1, .state = {.time = -1.0}};
    if (!*set->checkpoint) return HD_OK;
    const int lock = folder_lock(set->checkpoint);
    const hd_status status = save_first(set, run, message, size);
    if (status == HD_OK) remember(out);
    folder_unlock(lock);
    if (status != HD_OK) return status;
    out->due = next_due(set);
    out->state.time = hd_run_time(run);
    return HD_OK;
}

/* ---- the next ones ------------------------------------------------------------------------- */

void checkpoint_writer_touch(checkpoint_writer *k) { k->changed = true; }

bool checkpoint_writer_due(const checkpoint_writer *k)
{
    return k->changed && k->due < INFINITY && clock_seconds() >= k->due;
}

/** True if the file is still the one that this run has written: two runs must not write one file in
 * turn. Each writing makes a new file under the name; a copy into the old file goes unnoticed. */
static bool is_mine(const checkpoint_writer *k)
{
    struct stat now, own;
    if (stat(k->set->checkpoint, &now) != 0 || fstat(k->written, &own) != 0) return true;
    return now.st_dev == own.st_dev && now.st_ino == own.st_ino;
}

static hd_status save(checkpoint_writer *k, hd_run *run)
{
    kept *state = &k->state;
    const char *path = k->set->checkpoint;
    const int lock = folder_lock(path);
    const hd_status status =
        is_mine(k) ? hd_run_save(run, path, k->set->scene, state->message, sizeof state->message)
                   : fault(path, "another process has replaced it, so it is not overwritten",
                           state->message, sizeof state->message);
    if (status == HD_OK) remember(k);
    folder_unlock(lock);
    return status;
}

void checkpoint_writer_save(checkpoint_writer *k, hd_run *run)
{
    kept *state = &k->state;
    if (!*k->set->checkpoint || !k->changed) return;
    const bool failed = save(k, run) != HD_OK;
    if (failed) hdr_log(HDR_ERROR, "checkpoint not written: %s", state->message);
    if (!failed && state->failed) hdr_log(HDR_INFO, "checkpoint written again");
    state->failed = failed;
    k->due = next_due(k->set);
    if (failed) return;
    state->time = hd_run_time(run);
    k->changed = false;
}
