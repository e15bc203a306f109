/** Orders of rank 0 -> the same calls of the run on the other ranks. */
#include "hdlyap/follow.h"

#include "base/check.h"
#include "hdlyap/checkpoint.h"
#include "scene/parameters.h"
#include "run/order.h"

void hd_run_lead(hd_communicator *communicator)
{
    HD_ASSERT(communicator->rank == 0);
    communicator->leads = 1;
}

void hd_run_dismiss(hd_communicator *communicator)
{
    hd_order_tell(communicator, (hd_order){.kind = HD_ORDER_END});
    if (communicator) communicator->leads = 0;
}

static hd_status change(hd_run *run, const hd_order *order)
{
    const hd_parameter *row = hd_parameter_of(hd_run_scene(run), order->integer);
    HD_ASSERT(row);
    return hd_run_change(run, row, order->text, NULL, 0);
}

static void free_run(hd_run **run)
{
    hd_run_free(*run);
    *run = NULL;
}

/** Carries out an order. Its status is also that of rank 0, which handles a failure. */
static hd_status obey(hd_run **run, hd_communicator *c, const hd_order *o)
{
    switch (o->kind) {
    case HD_ORDER_CREATE: return hd_run_create_shared(run, o->scene, c, NULL, 0);
    case HD_ORDER_RESUME: return hd_run_resume_shared(run, o->text, o->scene, c, NULL, 0);
    case HD_ORDER_FREE: free_run(run); break;
    case HD_ORDER_ADVANCE: return hd_run_advance(*run);
    case HD_ORDER_OBSERVE: hd_run_observe(*run, (unsigned)o->integer); break;
    case HD_ORDER_WATCH: hd_run_watch(*run, o->number); break;
    case HD_ORDER_CHANGE: return change(*run, o);
    case HD_ORDER_MEASURE: return hd_run_measure(*run, o->integer);
    case HD_ORDER_RESET: return hd_run_reset_average(*run);
    case HD_ORDER_SAVE: return hd_run_save(*run, "", "", NULL, 0);
    case HD_ORDER_END: break;
    }
    return HD_OK;
}

void hd_run_follow(hd_communicator *communicator, const hd_dynamics *const *own, int count)
{
    hd_run *run = NULL;
    hd_order_room room;
    hd_order order;
    HD_ASSERT(communicator->rank > 0);
    do {
        order = hd_order_hear(communicator, &room, (hd_known){own, count});
        (void)obey(&run, communicator, &order);
    } while (order.kind != HD_ORDER_END);
    free_run(&run);
}
