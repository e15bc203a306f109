/** What may change while a run goes on: value -> what is asked for, until run.c takes it up between
 * two samples. */
#include <math.h>

#include "base/check.h"
#include "hdlyap/parameters.h"
#include "run/order.h"
#include "run/run_state.h"

static bool is_averaging(const hd_run *run)
{
    return run->schedule.stage == HD_AVERAGING && run->frame;
}

double hd_run_change_time(const hd_run *run)
{
    return is_averaging(run) ? fmax(hd_run_time(run), run->interval_end) : hd_run_time(run);
}

/** Of a run that does not stand at its end: until it holds, time goes on. */
static hd_status check_duration(const hd_run *run, double duration, char *message, size_t size)
{
    const double from = hd_run_change_time(run), least = from - run->schedule.start;
    hd_schedule asked = run->schedule;
    asked.length[HD_AVERAGING] = duration;
    if (asked.stage != HD_AVERAGING || duration == 0 || hd_schedule_reaches(&asked, from))
        return HD_OK;
    return hd_refuse(message, size,
                     "duration = %.15g: must be 0 or at least %.15g, averaged before it can change",
                     duration, least);
}

hd_status hd_run_change(hd_run *run, const hd_parameter *row, double value, char *message,
                        size_t size)
{
    hd_scene_def asked = run->scene;
    int count;
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_CHANGE,
                                                .integer = (int)(row - hd_scene_parameters(&count)),
                                                .number = value});
    if (!row->live)
        return hd_refuse(message, size, "%s = %.15g: is read at the start", row->name, value);
    if (run->schedule.stage == HD_FINISHED || run->due.stage_end)
        return hd_refuse(message, size, "%s = %.15g: the run has ended", row->name, value);
    hd_parameter_assign(row, &asked, value);
    HD_TRY(hd_scene_check(&asked, message, size));
    HD_TRY(check_duration(run, asked.duration, message, size));
    run->scene = asked;
    run->in_force.changing = true;
    run->sample.ends |= is_averaging(run);
    return HD_OK;
}

void hd_run_fields_every(hd_run *run, double interval)
{
    const bool said = run->fields_said;
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_FIELDS_EVERY, .number = interval});
    run->fields_said = true;
    if (interval == run->field_interval) return; /* of a run that goes on it may not hold yet */
    run->field_interval = interval;
    if (!said) run->in_force.field_interval = interval;
    run->in_force.changing |= said;
    run->sample.ends |= said && is_averaging(run);
}
