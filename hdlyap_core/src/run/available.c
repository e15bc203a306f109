/** The memory that the machine, a control group and the process's own limits leave. Linux. */
#define _DEFAULT_SOURCE
#include "hdlyap/memory_limit.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

enum { LINE = 4096 + 64, PATH = LINE }; /* of the longest path of Linux */

static void keep_least(hd_memory_limit *room, double bytes, const char *limit)
{
    if (bytes >= room->bytes) return;
    room->bytes = fmax(bytes, 0.0);
    room->limit = limit;
}

/** Number after a name, at the start of a line of a file; the first number of all if the name is
 * empty; `otherwise` if there is none. */
static double number_in(const char *path, const char *name, double otherwise)
{
    char line[LINE];
    double number = otherwise;
    FILE *file = fopen(path, "re");
    if (!file) return otherwise;
    while (number == otherwise && fgets(line, sizeof line, file))
        if (strncmp(line, name, strlen(name)) == 0 &&
            sscanf(line + strlen(name), " %lf", &number) != 1)
            number = otherwise;
    (void)fclose(file);
    return number;
}

/** A number of a control group, in the file `name` of its folder. */
static double of_group(const char *folder, const char *name, const char *key, double otherwise)
{
    char path[PATH];
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path) return otherwise;
    return number_in(path, key, otherwise);
}

/** Limits room to what a control group and the groups above it leave. Shortens `folder`, part by
 * part, to `root` characters. Cached pages of files count as free. */
static void see_groups(hd_memory_limit *room, char *folder, size_t root, int version)
{
    static const char *const limit[] = {"memory.limit_in_bytes", "memory.max"};
    static const char *const used[] = {"memory.usage_in_bytes", "memory.current"};
    static const char *const idle[] = {"total_inactive_file", "inactive_file"};
    for (;;) {
        const double most = of_group(folder, limit[version], "", INFINITY);
        const double now = of_group(folder, used[version], "", 0.0);
        const double given = of_group(folder, "memory.stat", idle[version], 0.0);
        keep_least(room, most - now + given, "cgroup");
        char *slash = strrchr(folder, '/');
        if (!slash || (size_t)(slash - folder) < root) return;
        *slash = '\0';
    }
}

/** True if a name is in a list that is separated by commas. */
static bool is_listed(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (; list; list = strchr(list, ',')) {
        list += *list == ',';
        if (strncmp(list, name, length) == 0 && (list[length] == ',' || !list[length])) return true;
    }
    return false;
}

/** A line of /proc/self/cgroup: 0::/path of version 2, or 4:memory:/path of version 1. A path may
 * hold colons. */
static void see_group(hd_memory_limit *room, char *line)
{
    static const char *const root[] = {"/sys/fs/cgroup/memory", "/sys/fs/cgroup"};
    char folder[PATH], *list = strchr(line, ':'), *path = list ? strchr(list + 1, ':') : NULL;
    if (!path) return;
    *list++ = *path++ = '\0';
    path[strcspn(path, "\n")] = '\0';
    const int version = strcmp(line, "0") == 0 && !*list;
    if (!version && !is_listed(list, "memory")) return;
    if (snprintf(folder, sizeof folder, "%s%s", root[version], path) >= (int)sizeof folder) return;
    see_groups(room, folder, strlen(root[version]), version);
}

static void see_all_groups(hd_memory_limit *room)
{
    char line[LINE];
    FILE *file = fopen("/proc/self/cgroup", "re");
    if (!file) return;
    while (fgets(line, sizeof line, file)) see_group(room, line);
    (void)fclose(file);
}

static void see_own_limit(hd_memory_limit *room)
{
    struct rlimit limit;
    const double now = number_in("/proc/self/statm", "", 0.0) * (double)sysconf(_SC_PAGESIZE);
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        keep_least(room, (double)limit.rlim_cur - now, "ulimit");
}

hd_memory_limit hd_memory_available(void)
{
    hd_memory_limit room = {INFINITY, "machine", 1};
    const double kilobytes = number_in("/proc/meminfo", "MemAvailable:", INFINITY);
    keep_least(&room, 1024.0 * kilobytes, "machine");
    see_all_groups(&room);
    see_own_limit(&room);
    return room;
}
