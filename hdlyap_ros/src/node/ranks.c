/** What starts several ranks says so in the environment; MPI is loaded only then. */
#include "ranks.h"

#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "hdlyap/follow.h"

static const char library_name[] = "libhdlyap_mpi.so.0";

typedef hd_status begin_function(hd_communicator **out, int *argc, char ***argv);
typedef void end_function(hd_communicator *ranks);

static void *library;

/** Open MPI, and what speaks PMI or PMIx, as MPICH and srun do. */
static const char *const sizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
static const char *const here[] = {"OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID",
                                   "SLURM_LOCALID"};
enum { STARTERS = sizeof sizes / sizeof *sizes };

/** What it says by the first of these that is more than least; least if none is. */
static int said(const char *const *names, int least)
{
    for (int k = 0; k < STARTERS; k++) {
        const char *text = getenv(names[k]);
        if (text && atoi(text) > least) return atoi(text);
    }
    return least;
}

/** A function of the library; POSIX says how to make one of a pointer. */
static bool find(void *function, const char *name)
{
    if (!library) library = dlopen(library_name, RTLD_NOW | RTLD_GLOBAL);
    *(void **)function = library ? dlsym(library, name) : NULL;
    return *(void **)function != NULL;
}

bool ranks_join(hd_communicator **out, int *argc, char ***argv, char *message, size_t size)
{
    const int ranks = said(sizes, 1);
    begin_function *begin;
    *out = NULL;
    if (ranks == 1) return true;
    if (!find(&begin, "hd_mpi_begin")) {
        *message = '\0';
        if (said(here, 0) > 0) return false; /* the first one of this machine tells it */
        snprintf(message, size, "ranks = %d: must be 1, as this build has no MPI (%s)", ranks,
                 dlerror());
        return false;
    }
    const hd_status status = begin(out, argc, argv);
    if (status == HD_OK) return true;
    snprintf(message, size, "ranks = %d: %s", ranks,
             status == HD_REFUSED ? "this MPI cannot be called by several threads"
                                  : hd_status_text(status));
    return false;
}

/** mpirun passes on the signals that it gets; when to end is for rank 0 to say. */
void ranks_follow(hd_communicator *ranks)
{
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    hd_run_follow(ranks);
}

void ranks_leave(hd_communicator *ranks)
{
    end_function *end;
    if (!ranks) return;
    if (ranks->rank == 0) hd_run_dismiss(ranks);
    if (find(&end, "hd_mpi_end")) end(ranks);
}
