/** Joins the ranks of a run. What starts several ranks says so in the environment; MPI is loaded
 * only then. */
#include "ranks.h"

#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "hdlyap/follow.h"
#include "particles.h"

static const char library_name[] = "libhdlyap_mpi.so.0";

typedef hd_status begin_function(hd_communicator **out, int *argc, char ***argv, char *message,
                                 size_t size);
typedef void end_function(hd_communicator *ranks);

static void *library;

/** True on the first rank of a machine, which reports faults; reads the variables of Open MPI,
 * MPICH and srun. */
static bool is_first_here(void)
{
    static const char *const here[] = {"OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID",
                                       "SLURM_LOCALID"};
    for (size_t k = 0; k < sizeof here / sizeof *here; k++) {
        const char *text = getenv(here[k]);
        if (text && atoi(text) > 0) return false;
    }
    return true;
}

/** Finds a function of the library; POSIX says how to make one of a pointer. */
static bool find(void *function, const char *name)
{
    if (!library) library = dlopen(library_name, RTLD_NOW | RTLD_GLOBAL);
    *(void **)function = library ? dlsym(library, name) : NULL;
    return *(void **)function != NULL;
}

bool ranks_join(hd_communicator **out, int *argc, char ***argv, char *message, size_t size)
{
    const char *variable;
    const int ranks = hd_ranks_started(&variable);
    char line[256];
    begin_function *begin;
    hd_status status = HD_REFUSED;
    *out = NULL;
    if (ranks == 1) return true;
    if (find(&begin, "hd_mpi_begin"))
        status = begin(out, argc, argv, line, sizeof line);
    else
        snprintf(line, sizeof line, "must be 1, as this build has no MPI (%s)", dlerror());
    if (status == HD_OK) return true;
    *message = '\0';
    if (is_first_here())
        snprintf(message, size, "ranks = %d: %s", ranks,
                 status == HD_REFUSED ? line : hd_status_text(status));
    return false;
}

/** Ignores signals, which mpirun passes on to all ranks: rank 0 decides when to end. */
void ranks_follow(hd_communicator *ranks)
{
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    int count;
    const hd_dynamics *const *brought = particles_brought(&count);
    hd_run_follow(ranks, brought, count);
}

void ranks_leave(hd_communicator *ranks)
{
    end_function *end;
    if (!ranks) return;
    if (ranks->rank == 0) hd_run_dismiss(ranks);
    if (find(&end, "hd_mpi_end")) end(ranks);
}
