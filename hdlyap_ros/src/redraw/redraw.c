/** The pictures of a run from its messages, for bags that were recorded without them: a node of the
 * same name as the one that was recorded, which hears its topics and publishes ~markers. rosrun
 * hdlyap redraw __name:=hdlyap [_modes:=[T(1,0), LP(1,0)]] */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../view/view.h"
#include "hdlyap_ros/hdlyap_ros.h"
#include "heard.h"

enum { EXIT_REFUSED = 2, EXIT_NO_MEMORY = 3, QUEUE = 1000 };

typedef struct redraw {
    heard said;
    view *view;
    hdr_publisher *markers;
    const char *const *modes; /**< names; NULL: the lowest T and LP field */
    int count;
    double drawn;     /**< simulated time of the last picture */
    int drawn_fields; /**< of that time in it: topics do not keep step */
} redraw;

/* ---- from what was heard to a picture ------------------------------------------------------ */

static void write_name(char *name, size_t size, const heard_field *f)
{
    snprintf(name, size, "%s(%u,%u)", f->kind == HDR_MODE_T ? "T" : "LP", (unsigned)f->nx,
             (unsigned)f->ny);
}

/** Simulated time of the newest fields; that of the state if there are none. */
static double newest(const heard *h)
{
    double time = h->fields > 0 ? -1.0 : h->time;
    for (int k = 0; k < h->fields; k++) time = fmax(time, h->field[k].time);
    return time;
}

static int fields_at(const heard *h, double time)
{
    int count = 0;
    for (int k = 0; k < h->fields; k++) count += h->field[k].time == time;
    return count;
}

/** The field nearest to zero of a kind at a time; NULL if there is none. */
static const heard_field *lowest(const heard *h, uint8_t kind, double time)
{
    const heard_field *found = NULL;
    for (int k = 0; k < h->fields; k++) {
        const heard_field *f = &h->field[k];
        if (f->kind == kind && f->time == time && (!found || f->exponent < found->exponent))
            found = f;
    }
    return found;
}

static const heard_field *named(const heard *h, const char *wanted, double time)
{
    for (int k = 0; k < h->fields; k++) {
        char name[32];
        write_name(name, sizeof name, &h->field[k]);
        if (h->field[k].time == time && strcmp(name, wanted) == 0) return &h->field[k];
    }
    return NULL;
}

static hdr_doubles array_of(const double *data, uint32_t count)
{
    return (hdr_doubles){.data = data, .count = count, .stride = 1};
}

/** Coefficients of the vector that the field shows, if they are of the same time. */
static void fill_pairs(picture_mode *mode, const heard *h, const heard_field *f)
{
    if (h->phases.phases.count == 0 || h->phases.sim_time != f->time) return;
    for (uint32_t k = 0; k < h->phases.phases.count && mode->pairs < PICTURE_PAIRS_MAX; k++) {
        const hdr_lp_phase *phase = &h->phases.phases.data[k];
        if (phase->index != f->index || phase->nx != f->nx || phase->ny != f->ny) continue;
        mode->a[mode->pairs] = phase->a;
        mode->b[mode->pairs++] = phase->b;
    }
}

/** f NULL: not known. */
static void fill_mode(picture_mode *mode, const heard *h, const heard_field *f, const char *name)
{
    snprintf(mode->name, sizeof mode->name, "%s", name);
    mode->kind = name[0] == 'T' ? HDR_MODE_T : HDR_MODE_LP;
    if (!f) return;
    write_name(mode->name, sizeof mode->name, f);
    mode->known = true;
    mode->index = f->index;
    mode->exponent = f->exponent;
    mode->dx = array_of(f->dx, h->disks);
    mode->dy = array_of(f->dy, h->disks);
    if (f->kind == HDR_MODE_LP) fill_pairs(mode, h, f);
}

static void fill_modes(picture *p, const redraw *r, double time)
{
    static const char *const kinds[] = {"T", "LP"};
    const heard *h = &r->said;
    p->modes = r->modes ? r->count : 2;
    for (int k = 0; k < p->modes; k++) {
        const heard_field *f = r->modes ? named(h, r->modes[k], time)
                                        : lowest(h, k == 0 ? HDR_MODE_T : HDR_MODE_LP, time);
        fill_mode(&p->mode[k], h, f, r->modes ? r->modes[k] : kinds[k]);
    }
}

/** Where the disks were at a time of fields, or now. */
static void fill_places(picture *p, const heard *h, double time)
{
    const double *x = h->x, *y = h->y;
    for (int k = 0; k < h->fields; k++)
        if (h->field[k].time == time) x = h->field[k].x, y = h->field[k].y;
    p->x = array_of(x, h->disks);
    p->y = array_of(y, h->disks);
}

static void draw(redraw *r, const hdr_cost *cost)
{
    const heard *h = &r->said;
    const double time = newest(h);
    hdr_markers markers;
    const int fields = fields_at(h, time);
    if (!h->begun || time < 0.0 || (time == r->drawn && fields == r->drawn_fields)) return;
    picture p = {
        .scene = h->scene,
        .phase = hdr_phase_name(cost->phase),
        .box = {h->box[0], h->box[1]},
        .periodic = {h->periodic[0], h->periodic[1]},
        .time = time,
        .averaged = h->averaged,
        .progress = cost->progress,
        .has_exponents = h->has_exponents,
        .exponents = array_of(h->exponents, h->vectors),
        .steps = h->has_steps ? &h->steps : NULL,
    };
    r->drawn = time;
    r->drawn_fields = fields;
    fill_places(&p, h, time);
    if (h->has_fields) fill_modes(&p, r, time);
    if (!view_draw(r->view, &markers, &p, "box") ||
        hdr_markers_publish(r->markers, &markers) != HDR_OK)
        hdr_log(HDR_ERROR, "no picture of t = %g", time);
}

/* ---- the node ------------------------------------------------------------------------------ */

static void on_run_info(void *context, const hdr_run_info *info)
{
    redraw *r = context;
    heard_run_info(&r->said, info);
    r->drawn = -1.0;
}
static void on_state(void *context, const hdr_state *state)
{
    heard_state(&((redraw *)context)->said, state);
}
static void on_spectrum(void *context, const hdr_spectrum *s)
{
    heard_spectrum(&((redraw *)context)->said, s);
}
static void on_steps(void *context, const hdr_steps *steps)
{
    heard_steps(&((redraw *)context)->said, steps);
}
static void on_phases(void *context, const hdr_lp_phases *p)
{
    heard_phases(&((redraw *)context)->said, p);
}
static void on_field(void *context, const hdr_mode_field *f)
{
    heard_mode_field(&((redraw *)context)->said, f);
}
/** The last message of each report. */
static void on_cost(void *context, const hdr_cost *cost) { draw(context, cost); }

static hdr_status connect(redraw *r, hdr_node *node)
{
    hdr_subscriber *s; /* the node's, until its end */
    hdr_status status = hdr_markers_advertise(&r->markers, node, "~markers");
    if (status == HDR_OK) status = hdr_frame_publish(node, "world", "box");
    if (status == HDR_OK)
        status = hdr_run_info_subscribe(&s, node, "~run_info", QUEUE, on_run_info, r);
    if (status == HDR_OK) status = hdr_state_subscribe(&s, node, "~state", QUEUE, on_state, r);
    if (status == HDR_OK)
        status = hdr_spectrum_subscribe(&s, node, "~spectrum", QUEUE, on_spectrum, r);
    if (status == HDR_OK) status = hdr_steps_subscribe(&s, node, "~steps", QUEUE, on_steps, r);
    if (status == HDR_OK)
        status = hdr_lp_phases_subscribe(&s, node, "~lp_phases", QUEUE, on_phases, r);
    if (status == HDR_OK)
        status = hdr_mode_field_subscribe(&s, node, "~fields", QUEUE, on_field, r);
    if (status == HDR_OK) status = hdr_cost_subscribe(&s, node, "~cost", QUEUE, on_cost, r);
    return status;
}

static bool read_modes(redraw *r, const hdr_params *params)
{
    static const char *const known[] = {"modes", NULL};
    const char *unknown = hdr_params_unknown(params, known);
    const hdr_status status = hdr_param_string_list(params, "modes", &r->modes, &r->count);
    if (unknown)
        hdr_log(HDR_FATAL, "%s = %s: must be removed: there is no parameter of this name", unknown,
                hdr_param_text(params, unknown));
    else if (status == HDR_WRONG_TYPE ||
             (r->modes && (r->count < 1 || r->count > PICTURE_MODES_MAX)))
        hdr_log(HDR_FATAL, "modes = %s: must be a list of 1 to %d modes such as T(1,0)",
                hdr_param_text(params, "modes"), PICTURE_MODES_MAX);
    else
        return true;
    return false;
}

int main(int argc, char **argv)
{
    hdr_node *node = NULL;
    hdr_params *params = NULL;
    redraw r = {.drawn = -1.0};
    hdr_status status = hdr_node_create(&node, &argc, argv, "hdlyap", 1.0, EXIT_NO_MEMORY);
    if (status == HDR_OK && !node) return 0; /* stopped before there was a master */
    if (status == HDR_OK) status = hdr_params_create(&params, node);
    const bool refused = status == HDR_OK && !read_modes(&r, params);
    if (status == HDR_OK && !refused && !view_create(&r.view)) status = HDR_NO_MEMORY;
    if (status == HDR_OK && !refused) status = connect(&r, node);
    while (status == HDR_OK && !refused && hdr_node_wait(INFINITY)) continue;
    if (status != HDR_OK) hdr_log(HDR_FATAL, "%s", hdr_error_text());
    hdr_node_free(node, 1.0); /* after this no callback runs */
    hdr_params_free(params);
    view_free(r.view);
    heard_clear(&r.said);
    return refused ? EXIT_REFUSED : status == HDR_OK ? 0 : EXIT_NO_MEMORY;
}
