/** Calls of rank 0 -> the same calls on the other ranks. */
#include "hdlyap/follow.h"

#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "hdlyap/checkpoint.h"
#include "hdlyap/parameters.h"
#include "run/order.h"

enum { PATH_SIZE = 4096 };

/** As it goes over the wire. Ranks of another version are refused with the first run; where this
 * has another size there, MPI ends them all before. */
typedef struct message {
    int kind, integer, with_scene, with_path;
    double number;
    hd_scene_def scene;
} message;

/** A rank that follows. */
typedef struct follower {
    hd_communicator *communicator;
    hd_run *run;
    message now;
    char path[PATH_SIZE];
} follower;

/* ---- rank 0 -------------------------------------------------------------------------------- */

void hd_run_lead(hd_communicator *communicator)
{
    HD_ASSERT(communicator->rank == 0);
    communicator->leads = 1;
}

void hd_order_tell(hd_communicator *c, hd_order order)
{
    if (!c || !c->leads) return;
    message m = {.kind = (int)order.kind, .integer = order.integer, .number = order.number};
    char path[PATH_SIZE] = "";
    m.with_scene = order.scene != NULL;
    m.with_path = order.path != NULL;
    if (order.scene) m.scene = *order.scene;
    if (order.path) strncpy(path, order.path, sizeof path - 1);
    hd_communicator_broadcast(c, &m, sizeof m);
    if (order.path) hd_communicator_broadcast(c, path, sizeof path);
}

void hd_run_dismiss(hd_communicator *communicator)
{
    hd_order_tell(communicator, (hd_order){.kind = HD_ORDER_END});
    if (communicator) communicator->leads = 0;
}

/* ---- the others ---------------------------------------------------------------------------- */

static hd_status make_run(follower *f)
{
    const hd_scene_def *scene = f->now.with_scene ? &f->now.scene : NULL;
    HD_ASSERT(!f->run);
    if (f->now.kind == HD_ORDER_CREATE)
        return hd_run_create_shared(&f->run, scene, f->communicator, NULL, 0);
    return hd_run_resume_shared(&f->run, f->path, scene, f->communicator, NULL, 0);
}

static hd_status change(follower *f)
{
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    HD_ASSERT(f->now.integer >= 0 && f->now.integer < count);
    return hd_run_change(f->run, &rows[f->now.integer], f->now.number, NULL, 0);
}

static void free_run(follower *f)
{
    hd_run_free(f->run);
    f->run = NULL;
}

/** Its status is that of rank 0, which deals with it. */
static hd_status obey(follower *f)
{
    const message *m = &f->now;
    switch ((hd_order_kind)m->kind) {
    case HD_ORDER_CREATE:
    case HD_ORDER_RESUME: return make_run(f);
    case HD_ORDER_FREE: free_run(f); break;
    case HD_ORDER_ADVANCE: return hd_run_advance(f->run);
    case HD_ORDER_OBSERVE: hd_run_observe(f->run, (unsigned)m->integer); break;
    case HD_ORDER_WATCH: hd_run_watch(f->run, m->number, m->integer); break;
    case HD_ORDER_CHANGE: return change(f);
    case HD_ORDER_FIELDS_EVERY: hd_run_fields_every(f->run, m->number); break;
    case HD_ORDER_FIELDS_FROM: hd_run_fields_from(f->run, m->integer); break;
    case HD_ORDER_RESET: return hd_run_reset_average(f->run);
    case HD_ORDER_SAVE: return hd_run_save(f->run, "", "", NULL, 0);
    case HD_ORDER_END: break;
    }
    return HD_OK;
}

void hd_run_follow(hd_communicator *communicator)
{
    follower f = {.communicator = communicator};
    HD_ASSERT(communicator->rank > 0);
    do {
        hd_communicator_broadcast(communicator, &f.now, sizeof f.now);
        if (f.now.with_path) hd_communicator_broadcast(communicator, f.path, sizeof f.path);
        (void)obey(&f);
    } while (f.now.kind != HD_ORDER_END);
    free_run(&f);
}
