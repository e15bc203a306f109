/** Ranks of a run -> whether they can carry it together, and whether they still agree. */
#include "run/ranks.h"

#include <stdio.h>
#include <string.h>

#include "base/check.h"
#include "base/communicator.h"
#include "base/memory.h"
#include "dynamics/trajectory.h"
#include "hdlyap/blas.h"
#include "hdlyap/hdlyap.h"
#include "hdlyap/memory_limit.h"
#include "observe/observables.h"

/** Facts that must be the same on all ranks; the size is a multiple of a double's, because doubles
 * are shared. */
typedef struct program {
    char text[64];
} program;

static program this_program(void)
{
    program own = {{0}};
    snprintf(own.text, sizeof own.text, "hdlyap %s, %s kernels", HDLYAP_VERSION,
             hd_blas_query().kernel);
    return own;
}

/** Refuses ranks with other BLAS kernels, which round differently: what each rank computes for
 * itself would differ. */
static hd_status same_programs(hd_communicator *c, char *message, size_t size)
{
    const size_t ranks = (size_t)hd_communicator_ranks(c), words = sizeof(program) / sizeof(double);
    if (ranks == 1) return HD_OK;
    program *all = hd_memory_alloc(ranks, sizeof *all);
    hd_status status = hd_communicator_agree(c, all ? HD_OK : HD_NO_MEMORY);
    if (status == HD_OK) {
        all[c->rank] = this_program();
        const hd_shared shared = {1, ranks * words, words, ranks * words, 0};
        status = hd_communicator_share(c, (double *)all, shared);
    }
    for (size_t rank = 1; rank < ranks && status == HD_OK; rank++)
        if (memcmp(&all[rank], &all[0], sizeof *all) != 0)
            status = hd_refuse(message, size, "rank %zu runs %s: must run %s, as rank 0 does", rank,
                               all[rank].text, all[0].text);
    hd_memory_free(all);
    return status;
}

static hd_status check(const hd_scene_def *def, hd_communicator *c, char *message, size_t size)
{
    const int ranks = hd_communicator_ranks(c);
    HD_TRY(same_programs(c, message, size));
    HD_TRY(hd_scene_check(def, message, size));
    HD_TRY(hd_windows_check_ranks(def, ranks, message, size));
    hd_memory_limit room = hd_memory_available();
    room.ranks = ranks;
    if (c) room.bytes /= c->beside;
    return hd_memory_check(def, room, message, size);
}

hd_status hd_ranks_check(const hd_scene_def *def, hd_communicator *c, char *message, size_t size)
{
    const hd_status own = check(def, c, message, size);
    const hd_status all = hd_communicator_agree(c, own);
    if (own == HD_OK && all != HD_OK)
        (void)hd_refuse(message, size, "another rank: %s", hd_status_text(all));
    return all;
}

hd_status hd_ranks_compare(hd_communicator *c, const hd_trajectory *trajectory)
{
    if (!c) return HD_OK;
    const uint32_t own = hd_trajectory_fingerprint(trajectory);
    uint32_t first = own;
    hd_communicator_broadcast(c, &first, sizeof first);
    return hd_communicator_agree(c, own == first ? HD_OK : HD_RANKS_APART);
}
