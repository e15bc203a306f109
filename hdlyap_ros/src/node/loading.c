/** Ends the process with the status of a fault, before any library is initialised, if the address
 * space is too small. OpenBLAS takes a buffer for every processor while it is loaded; without room
 * it retries for ever, before main. For Linux with glibc; other loaders never call this function.
 */
#define _GNU_SOURCE /* sched_getaffinity */
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "hdlyap/blas.h"

enum { EXIT_FAULT = 3 };

/** Number in an environment variable, 0 if it is none; getenv cannot be used yet. */
static int number_of(char **environment, const char *name)
{
    const size_t length = strlen(name);
    for (; *environment; environment++)
        if (strncmp(*environment, name, length) == 0 && (*environment)[length] == '=')
            return atoi(*environment + length + 1);
    return 0;
}

/** Threads that OpenBLAS takes buffers for. */
static int threads_at_load(char **environment)
{
    cpu_set_t allowed;
    const int limit = number_of(environment, "OMP_NUM_THREADS");
    const int cores = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : 1;
    return limit > 0 && limit < cores ? limit : cores;
}

static void look_for_room(int argc, char **argv, char **environment)
{
    char line[128];
    struct timespec now;
    const int threads = threads_at_load(environment);
    const hd_status status = hd_blas_room(threads);
    (void)argc;
    (void)argv;
    if (status == HD_OK) return;
    clock_gettime(CLOCK_REALTIME, &now);
    const int length = snprintf(line, sizeof line,
                                "[FATAL] [%ld.%09ld]: %s: no address space for %d threads of "
                                "OpenBLAS: set OMP_NUM_THREADS lower\n",
                                (long)now.tv_sec, now.tv_nsec, hd_status_text(status), threads);
    const ssize_t written = write(STDERR_FILENO, line, (size_t)length);
    (void)written; /* a failure to write cannot be reported */
    _exit(EXIT_FAULT);
}

__attribute__((section(".preinit_array"),
               used)) static void (*const first)(int, char **, char **) = look_for_room;
