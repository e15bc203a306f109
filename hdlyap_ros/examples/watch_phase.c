/** A ROS node in C: follows one LP phase of a running hdlyap_node, and publishes on ~deviation how
 * far it is from turning evenly, in percent of a turn (std_msgs/Float64). rosrun hdlyap watch_phase
 * _node:=hdlyap _nx:=1 _ny:=0 _number:=1 */
#include <hdlyap_ros/hdlyap_ros.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { EXIT_REFUSED = 2, EXIT_NO_MEMORY, ABSENT = HDR_LP_PHASE_TRACKED + 1 };

static const char *const states[] = {"its step is not resolved", "too weak to have a phase",
                                     "turns too far between samples", "followed",
                                     "the run has no such phase"};

/** A straight line through points: their number, means, and sums of products of what is off them.
 */
typedef struct line {
    double count, time, phase, time_time, time_phase;
} line;

typedef struct watch {
    const char *node;   /**< whose phases */
    int nx, ny, number; /**< the wave vector, and which of its phases, from 1 */
    hdr_publisher *deviation;
    int state;            /**< as in hdr_lp_phase; -1 before the first message */
    double time, tracked; /**< when it was followed last, and for how long */
    line even;
    uint32_t said; /**< second of the last line */
} watch;

/** Adds a point; how far it is above the line. */
static double line_add(line *l, double time, double phase)
{
    const double dt = time - l->time, dphase = phase - l->phase;
    l->count++;
    l->time += dt / l->count;
    l->phase += dphase / l->count;
    l->time_time += dt * (time - l->time);
    l->time_phase += dt * (phase - l->phase);
    if (l->count < 3) return 0.0;
    return phase - l->phase - l->time_phase / l->time_time * (time - l->time);
}

static const hdr_lp_phase *find(const watch *w, const hdr_lp_phases *all)
{
    int number = 0;
    for (uint32_t k = 0; k < all->phases.count; k++) {
        const hdr_lp_phase *phase = &all->phases.data[k];
        const bool ours = phase->nx == (uint32_t)w->nx && phase->ny == (uint32_t)w->ny;
        if (ours && ++number == w->number) return phase;
    }
    return NULL;
}

/** Runs on the wrapper's callback thread; nobody else uses w meanwhile. */
static void on_phases(void *context, const hdr_lp_phases *all)
{
    watch *w = context;
    const hdr_lp_phase *phase = find(w, all);
    const int state = phase && phase->state < ABSENT ? phase->state : ABSENT;
    if (state != w->state)
        hdr_log(state == HDR_LP_PHASE_TRACKED ? HDR_INFO : HDR_WARN,
                "t = %g: phase %d of LP(%d,%d): %s", all->sample_time, w->number, w->nx, w->ny,
                states[state]);
    w->state = state;
    if (state != HDR_LP_PHASE_TRACKED) return;

    const double gone = all->sample_time - w->time, grown = phase->tracked_time - w->tracked;
    if (gone == 0.0 && grown == 0.0) return; /* a report of the same state */
    /* lost and found again, or in another run: since when is less than what has gone by */
    if (gone <= 0.0 || grown < 0.5 * gone) w->even = (line){0};
    w->time = all->sample_time;
    w->tracked = phase->tracked_time;
    const double off = line_add(&w->even, all->sample_time, phase->phase);
    const hdr_float64 percent = {100.0 * off / 6.283185307179586};
    if (hdr_float64_publish(w->deviation, &percent) != HDR_OK)
        hdr_log(HDR_ERROR, "%s", hdr_error_text());
    const uint32_t now = hdr_time_now().sec; /* a line a second is enough, once there is an error */
    if (now != w->said && phase->omega_error >= 0.0)
        hdr_log(HDR_INFO, "t = %g: phase = %.3f, omega = %.5f +- %.5f, deviation %+.2f %%",
                all->sample_time, phase->phase, phase->omega, phase->omega_error, percent.data);
    w->said = now;
}

static bool refuse(const hdr_params *params, const char *name, const char *allowed)
{
    hdr_log(HDR_FATAL, "%s = %s: must be %s", name, hdr_param_text(params, name), allowed);
    return false;
}

static bool read_int(const hdr_params *params, const char *name, int least, int *out)
{
    const hdr_status status = hdr_param_int(params, name, out);
    if (status == HDR_MISSING || (status == HDR_OK && *out >= least)) return true;
    return refuse(params, name, least ? "an integer from 1" : "an integer from 0");
}

static bool read_params(watch *w, const hdr_params *params)
{
    static const char *const known[] = {"node", "nx", "ny", "number", NULL};
    const char *unknown = hdr_params_unknown(params, known);
    if (unknown) return refuse(params, unknown, "removed: there is no parameter of this name");
    if (hdr_param_string(params, "node", &w->node) == HDR_WRONG_TYPE || strlen(w->node) > 200)
        return refuse(params, "node", "the name of a node");
    return read_int(params, "nx", 0, &w->nx) && read_int(params, "ny", 0, &w->ny) &&
           read_int(params, "number", 1, &w->number) &&
           (w->nx || w->ny || refuse(params, "nx", "from 1 where ny is 0"));
}

/** Until it is stopped. */
static hdr_status run(watch *w, hdr_node *node)
{
    char topic[256];
    hdr_subscriber *subscriber; /* is the node's until its end */
    hdr_status status = hdr_float64_advertise(&w->deviation, node, "~deviation", 100);
    snprintf(topic, sizeof topic, "%s/lp_phases", w->node);
    if (status == HDR_OK)
        status = hdr_lp_phases_subscribe(&subscriber, node, topic, 100, on_phases, w);
    while (status == HDR_OK && hdr_node_wait(INFINITY)) continue;
    return status;
}

int main(int argc, char **argv)
{
    hdr_node *node;
    hdr_params *params = NULL;
    watch w = {.node = "hdlyap", .nx = 1, .ny = 0, .number = 1, .state = -1};
    hdr_status status = hdr_node_create(&node, &argc, argv, "watch_phase", 1.0, EXIT_NO_MEMORY);
    if (status == HDR_OK && !node) return 0; /* stopped before there was a master */
    if (status == HDR_OK) status = hdr_params_create(&params, node);
    const bool refused = status == HDR_OK && !read_params(&w, params);
    if (status == HDR_OK && !refused) status = run(&w, node);
    if (status != HDR_OK) hdr_log(HDR_FATAL, "%s", hdr_error_text());
    hdr_node_free(node, 1.0); /* after this no callback runs */
    hdr_params_free(params);
    return refused || status != HDR_OK ? EXIT_REFUSED : 0;
}
