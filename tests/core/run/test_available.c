/** What a machine leaves, as its files say: no file is read but those that are given here. */
#include <dlfcn.h>
#include <sys/resource.h>
#include <unistd.h>
#include "testing.h"

typedef struct text {
    const char *path, *contents;
} text;

static const text *texts; /* the last one has no path */

/** Of texts; others are not there. */
FILE *fopen(const char *path, const char *mode)
{
    FILE *(*real)(const char *, const char *);
    void *found = dlsym(RTLD_NEXT, "fopen");
    memcpy(&real, &found, sizeof real);
    if (!texts) return real(path, mode);
    for (const text *t = texts; t->path; t++)
        if (strcmp(t->path, path) == 0)
            return fmemopen((void *)(uintptr_t)t->contents, strlen(t->contents), "r");
    return NULL;
}

static void expect(const text *there, double bytes, const char *limit)
{
    texts = there;
    const hd_memory_limit room = hd_memory_available();
    texts = NULL;
    assert_true(room.bytes == bytes);
    assert_string_equal(room.limit, limit);
    assert_int_equal(room.ranks, 1);
}

TEST(of_the_machine)
{
    expect((text[]){{"/proc/meminfo", "MemFree: 7 kB\nMemAvailable: 4096 kB\n"}, {NULL, NULL}},
           4096.0 * 1024.0, "machine");
    expect((text[]){{NULL, NULL}}, INFINITY, "machine");
}

/** The least of a group and those above it: its limit less what is used, but for idle pages. */
TEST(of_a_group)
{
    expect((text[]){{"/proc/meminfo", "MemAvailable: 4096 kB\n"},
                    {"/proc/self/cgroup", "0::/job/step\n"},
                    {"/sys/fs/cgroup/job/step/memory.max", "max\n"},
                    {"/sys/fs/cgroup/job/step/memory.current", "400000\n"},
                    {"/sys/fs/cgroup/job/memory.max", "3000000\n"},
                    {"/sys/fs/cgroup/job/memory.current", "1000000\n"},
                    {"/sys/fs/cgroup/job/memory.stat", "anon 5\ninactive_file 250000\n"},
                    {NULL, NULL}},
           2250000.0, "cgroup");
    expect((text[]){{"/proc/self/cgroup", "5:cpu:/other\n4:memory:/job\n"},
                    {"/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "3000000\n"},
                    {"/sys/fs/cgroup/memory/job/memory.usage_in_bytes", "1000000\n"},
                    {"/sys/fs/cgroup/memory/job/memory.stat",
                     "inactive_file 7\ntotal_inactive_file 250000\n"},
                    {NULL, NULL}},
           2250000.0, "cgroup");
    expect((text[]){{"/proc/self/cgroup", "5:cpu:/a:memory:/b\n0::/docker:/pod:memory:x\n"},
                    {"/sys/fs/cgroup/docker:/pod:memory:x/memory.max", "1000\n"},
                    {NULL, NULL}},
           1000.0, "cgroup");
    expect((text[]){{"/proc/self/cgroup", "5:cpu:/other\n4:hugetlb,memory:/a:b\n"},
                    {"/sys/fs/cgroup/memory/a:b/memory.limit_in_bytes", "1000\n"},
                    {"/sys/fs/cgroup/memory/other/memory.limit_in_bytes", "10\n"},
                    {NULL, NULL}},
           1000.0, "cgroup");
    expect((text[]){{"/proc/self/cgroup", "0::/job\n"},
                    {"/sys/fs/cgroup/job/memory.max", "1000\n"},
                    {"/sys/fs/cgroup/job/memory.current", "4000\n"},
                    {NULL, NULL}},
           0.0, "cgroup");
}

/** Address space that is not used yet. */
TEST(of_the_process)
{
    struct rlimit before, limit;
    const double page = (double)sysconf(_SC_PAGESIZE);
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    if (before.rlim_max != RLIM_INFINITY) skip();
    limit = (struct rlimit){.rlim_cur = (rlim_t)1 << 40, .rlim_max = before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_AS, &limit), 0);
    expect((text[]){{"/proc/self/statm", "1000 10 1\n"}, {NULL, NULL}},
           1099511627776.0 - 1000.0 * page, "ulimit");
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
}
