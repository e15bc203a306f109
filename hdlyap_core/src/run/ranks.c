/** Ranks of a run -> what they agree on, and what each must know of the others. */
#include "run/ranks.h"

#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "base/check.h"
#include "base/memory.h"
#include "events/trajectory_state.h"
#include "hdlyap/blas.h"
#include "hdlyap/hdlyap.h"
#include "hdlyap/room.h"
#include "run/factorise.h"
#include "tangent/threads.h"

hd_status hd_run_agree(const hd_run *run, hd_status status)
{
    return hd_communicator_agree(run->communicator, status);
}

/* ---- the start ----------------------------------------------------------------------------- */

/** What must be the same on all of them, in whole numbers of the size that is shared. */
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

/** Other kernels round otherwise: what each computes alike would not be alike. */
static hd_status same_programs(hd_communicator *c, char *message, size_t size)
{
    const size_t ranks = (size_t)hd_communicator_ranks(c), words = sizeof(program) / sizeof(double);
    if (ranks == 1) return HD_OK;
    program *all = hd_memory_alloc(ranks, sizeof *all);
    HD_TRY(hd_communicator_agree(c, all ? HD_OK : HD_NO_MEMORY));
    all[c->rank] = this_program();
    const hd_shared shared = {1, ranks * words, words, ranks * words, 0};
    hd_status status = hd_communicator_share(c, (double *)all, shared);
    for (size_t rank = 1; rank < ranks && status == HD_OK; rank++)
        if (memcmp(&all[rank], &all[0], sizeof *all) != 0)
            status = hd_refuse(message, size, "rank %zu is %s: must be %s, as rank 0", rank,
                               all[rank].text, all[0].text);
    hd_memory_free(all);
    return status;
}

static hd_status check(const hd_scene_def *def, hd_communicator *c, char *message, size_t size)
{
    const int ranks = hd_communicator_ranks(c);
    HD_TRY(same_programs(c, message, size));
    HD_TRY(hd_scene_check(def, message, size));
    if (ranks > 1 && def->observe & HD_OBSERVE_COVARIANT &&
        hd_scene_carried(def) < hd_scene_vectors(def))
        return hd_refuse(message, size,
                         "ranks = %d: must be 1 for covariant vectors with exponents = all; "
                         "all_independent has them on several ranks",
                         ranks);
    hd_room room = hd_room_available();
    room.ranks = ranks;
    if (c) room.bytes /= c->beside;
    return hd_room_check(def, room, message, size);
}

hd_status hd_run_check_together(const hd_scene_def *def, hd_communicator *c, char *message,
                                size_t size)
{
    const hd_status own = check(def, c, message, size);
    const hd_status all = hd_communicator_agree(c, own);
    if (own == HD_OK && all != HD_OK)
        (void)hd_refuse(message, size, "another rank: %s", hd_status_text(all));
    return all;
}

int hd_run_threads_most(const hd_run *run)
{
    const int wanted = run->scene.threads, cores = hd_blas_query().cores;
    const int most = hd_threads_most(wanted, 4 * run->scene.disks, run->carried);
    if (!run->communicator || wanted > 0) return most;
    const int own = cores / run->communicator->beside;
    return own < 1 ? 1 : own < most ? own : most;
}

/* ---- vectors ------------------------------------------------------------------------------- */

bool hd_run_vectors_wanted(const hd_run *run)
{
    const unsigned due = HD_OBSERVE_HYDRO | (run->due.fields ? HD_OBSERVE_FIELDS : 0u);
    return hd_run_is_observing(run) && (run->observe & due);
}

bool hd_run_is_watched(const hd_run *run)
{
    return hd_run_is_observing(run) && run->watch.first < run->vectors;
}

/** First of the vectors that somebody wants to read now; n if nobody does. */
static int first_wanted(const hd_run *run)
{
    const hd_steps *steps = run->observer.steps;
    int first = hd_run_is_watched(run) ? run->watch.first : run->vectors;
    if (hd_run_vectors_wanted(run) && run->fields_first < first) first = run->fields_first;
    for (int k = 0; hd_run_vectors_wanted(run) && k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->resolved && step->col < first) first = step->col;
    }
    return first;
}

static hd_status gathered_room(hd_run *run, size_t size)
{
    if (size > run->gathered_size) {
        hd_memory_free(run->gathered_room);
        run->gathered_room = hd_memory_alloc(size, sizeof *run->gathered_room);
        run->gathered_size = run->gathered_room ? size : 0;
    }
    return hd_run_agree(run, run->gathered_size >= size ? HD_OK : HD_NO_MEMORY);
}

/** All 4N: the half, and with it the other one. */
static hd_status gather_both_halves(hd_run *run)
{
    const int rows = hd_frame_rows(run->frame), n = run->carried;
    const size_t size = (size_t)rows * (size_t)n;
    HD_TRY(gathered_room(run, 3 * size));
    double *half = run->gathered_room + 2 * size;
    hd_frame_gather(run->frame, 0, n, half);
    hd_conjugate_fill(run->gathered_room, (hd_columns){half, n, 0, n}, rows);
    run->gathered = (hd_columns){run->gathered_room, rows, 0, rows};
    return HD_OK;
}

hd_status hd_run_gather(hd_run *run)
{
    const int first = first_wanted(run), count = run->vectors - first;
    if (!run->communicator || count == 0) return HD_OK;
    if (run->conjugate) return gather_both_halves(run);
    HD_TRY(gathered_room(run, (size_t)hd_frame_rows(run->frame) * (size_t)count));
    hd_frame_gather(run->frame, first, count, run->gathered_room);
    run->gathered = (hd_columns){run->gathered_room, count, first, count};
    return HD_OK;
}

/* ---- the disks ------------------------------------------------------------------------------ */

/** Of positions and momenta to the last bit. */
static uint32_t fingerprint(const hd_trajectory *tr)
{
    const int n = hd_trajectory_disks(tr);
    uLong crc = 0;
    for (int i = 0; i < n; i++) {
        const hd_disk *disk = &tr->motion.disk[i];
        crc = crc32_z(crc, (const Bytef *)disk->q, sizeof disk->q);
        crc = crc32_z(crc, (const Bytef *)disk->p, sizeof disk->p);
    }
    return (uint32_t)crc;
}

hd_status hd_run_compare_disks(const hd_run *run)
{
    if (!run->communicator) return HD_OK;
    const uint32_t own = fingerprint(run->advance.trajectory);
    uint32_t first = own;
    hd_communicator_broadcast(run->communicator, &first, sizeof first);
    return hd_run_agree(run, own == first ? HD_OK : HD_RANKS_APART);
}
