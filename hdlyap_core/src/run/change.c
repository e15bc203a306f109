/** A new value for a parameter of a run -> what the agenda puts in force later. */
#include <math.h>

#include "base/check.h"
#include "run/order.h"
#include "run/run_state.h"
#include "scene/parameters.h"

double hd_run_change_time(const hd_run *run)
{
    return hd_agenda_change_time(&run->agenda, hd_run_time(run), run->carrier.frame);
}

/** Refuses a duration that would be over before the change is in force. */
static hd_status check_duration(const hd_run *run, double duration, char *message, size_t size)
{
    const double from = hd_run_change_time(run);
    if (hd_agenda_can_last(&run->agenda, duration, from)) return HD_OK;
    return hd_refuse(
        message, size,
        "duration = %.15g: must be 0 or at least %.15g, the time averaged when it changes",
        duration, from - run->agenda.start);
}

hd_status hd_run_change(hd_run *run, const hd_parameter *row, const char *value, char *message,
                        size_t size)
{
    hd_scene_def asked = run->scene;
    int number = 0;
    while (hd_parameter_of(&asked, number) && hd_parameter_of(&asked, number) != row) number++;
    HD_ASSERT(hd_parameter_of(&asked, number));
    hd_order_tell(run->communicator,
                  (hd_order){.kind = HD_ORDER_CHANGE, .integer = number, .text = value});
    if (!row->live)
        return hd_refuse(message, size, "%s = %s: is read at the start and cannot change",
                         row->name, value);
    if (hd_run_stage(run) == HD_FINISHED || run->agenda.due & HD_DUE_STAGE)
        return hd_refuse(message, size, "%s = %s: the run has ended", row->name, value);
    if (!hd_parameter_read(row, &asked, value))
        return hd_refuse(message, size, "%s = %s: must be %s", row->name, value, row->range);
    HD_TRY(hd_scene_check(&asked, message, size));
    HD_TRY(hd_target_check(&asked, message, size));
    HD_TRY(check_duration(run, asked.duration, message, size));
    run->scene = asked;
    hd_agenda_ask(&run->agenda, run->carrier.frame);
    return HD_OK;
}

void hd_run_observe(hd_run *run, unsigned stages)
{
    const unsigned now = hd_target_stages(&run->scene, stages) & run->scene.observe;
    if (now == run->observables.looked_at) return;
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_OBSERVE, .integer = (int)now});
    hd_observables_look(&run->observables, now);
}

void hd_run_watch(hd_run *run, double interval)
{
    HD_ASSERT(interval > 0.0);
    if (interval == run->watch) return;
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_WATCH, .number = interval});
    run->watch = interval;
}
