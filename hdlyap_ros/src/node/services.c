/** Services, answered on the callback thread and carried out by the worker between two steps. A
 * call for a checkpoint or a change waits for it, and so do all other callbacks, as there is one
 * thread. */
#include "services.h"

#include <stdio.h>
#include <stdlib.h>

#include "change.h"
#include "hdlyap_ros/params.h"
#include "parameters.h"

static bool on_pause(void *context, bool pause, char *message, size_t size)
{
    worker *w = context;
    const worker_state state = worker_state_now(w);
    if (state.stage == WORKER_ENDED) {
        snprintf(message, size, "the run has ended");
        return false;
    }
    worker_pause(w, pause);
    snprintf(message, size, "%s after simulated time %.6g", pause ? "pauses" : "goes on",
             state.last.time);
    return true;
}

static bool on_reset_average(void *context, char *message, size_t size)
{
    worker *w = context;
    const worker_state state = worker_state_now(w);
    if (state.stage == WORKER_ENDED || state.last.stage != HD_AVERAGING) {
        snprintf(message, size, "there are no averages now");
        return false;
    }
    worker_reset_average(w);
    snprintf(message, size, "averages start afresh after simulated time %.6g", state.last.time);
    return true;
}

/** Longest time that a call waits: long enough for a step and for a large file. */
static const double answer_seconds = 30.0;

static bool on_checkpoint(void *context, char *message, size_t size)
{
    worker *w = context;
    return worker_checkpoint(w, answer_seconds, message, size);
}

/** Writes a change to the parameter server, where the node finds it when it is started again. */
static void write_to_server(hdr_node *ros, const char *assignment)
{
    change made;
    char message[256];
    if (!change_parse(&made, assignment, message, sizeof message)) return;
    const parameter p = parameters_named(made.name);
    if (p.row && p.row->kind == HD_PARAMETER_TEXT)
        hdr_param_write_string(ros, made.name, made.value);
    else
        hdr_param_write_double(ros, made.name, strtod(made.value, NULL));
}

static bool on_set(void *context, const char *assignment, char *message, size_t size)
{
    const services *s = context;
    if (!worker_set(s->worker, answer_seconds, assignment, message, size)) return false;
    write_to_server(s->ros, assignment);
    return true;
}

static bool on_stop(void *context, char *message, size_t size)
{
    worker *w = context;
    return worker_end_averaging(w, answer_seconds, message, size);
}

hdr_status services_advertise(services *out, hdr_node *ros, worker *w)
{
    *out = (services){.ros = ros, .worker = w};
    const hdr_status status = hdr_service_set_bool(ros, "~pause", on_pause, w);
    if (status != HDR_OK) return status;
    const hdr_status reset = hdr_service_trigger(ros, "~reset_average", on_reset_average, w);
    if (reset != HDR_OK) return reset;
    const hdr_status keep = hdr_service_trigger(ros, "~checkpoint", on_checkpoint, w);
    if (keep != HDR_OK) return keep;
    const hdr_status stop = hdr_service_trigger(ros, "~stop", on_stop, w);
    if (stop != HDR_OK) return stop;
    return hdr_service_set(ros, "~set", on_set, out);
}
