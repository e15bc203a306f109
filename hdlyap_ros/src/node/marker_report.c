/** The run -> pictures for rviz. */
#include "marker_report.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../view/view.h"
#include "clock.h"
#include "field_report.h"
#include "hdlyap_ros/stage.h"

_Static_assert((int)PICTURE_PAIRS_MAX == (int)HD_MODULATIONS_MAX, "pairs as in the core");
_Static_assert((int)PICTURE_MODES_MAX == (int)MARKER_MODES_MAX, "modes as in the settings");

/** A picture this old is as good as new for a run that stands still [s]. */
static const double rest_seconds = 1.0;

struct marker_report {
    const settings *set;
    mode_report *modes;
    hdr_publisher *publisher;
    view *view;
    double *q, *p, *exponents; /**< [2N], [2N], [n] in one block at q */
    int vectors;
    hd_mode_kind kind[2]; /**< of the modes that there can be in this box */
    int kinds;
    bool due;          /**< for the step under way */
    double next, last; /**< wall times of pictures */
};

static bool parts_create(marker_report *r)
{
    const size_t size = 2 * (size_t)r->set->def.disks;
    r->q = malloc((2 * size + (size_t)r->vectors + 1) * sizeof *r->q);
    if (!r->q || !view_create(&r->view)) return false;
    r->p = r->q + size;
    r->exponents = r->p + size;
    return true;
}

/** Between walls that are close there are no transverse modes. */
static void kinds_find(marker_report *r, const hd_steps *steps)
{
    const hd_mode_kind kinds[] = {HD_MODE_T, HD_MODE_LP};
    for (int k = 0; k < 2; k++) {
        bool found = false;
        for (int s = 0; s < hd_steps_count(steps); s++)
            found |= hd_steps_step(steps, s)->kind == kinds[k];
        if (found) r->kind[r->kinds++] = kinds[k];
    }
}

hdr_status marker_report_create(marker_report **out, hdr_node *ros, const settings *set,
                                const hd_run *run, mode_report *modes)
{
    marker_report *r = *out = calloc(1, sizeof *r);
    if (!r) return HDR_NO_MEMORY;
    *r = (marker_report){
        .set = set, .modes = modes, .vectors = hd_run_vectors(run), .last = -HUGE_VAL};
    if (modes) kinds_find(r, hd_run_steps(run));
    hdr_status status = parts_create(r) ? HDR_OK : HDR_NO_MEMORY;
    if (status == HDR_OK) status = hdr_markers_advertise(&r->publisher, ros, "~markers");
    if (status == HDR_OK) status = hdr_frame_publish(ros, "world", outlets_frame());
    if (status == HDR_OK) return HDR_OK;
    marker_report_free(r);
    *out = NULL;
    return status;
}

void marker_report_free(marker_report *r)
{
    if (!r) return;
    view_free(r->view);
    free(r->q);
    free(r);
}

bool marker_report_watched(const marker_report *r)
{
    return hdr_publisher_subscribers(r->publisher) > 0;
}

/* ---- which modes --------------------------------------------------------------------------- */

/** In the positive half. */
static bool can_be_shown(const hd_step *step)
{
    return step->resolved && !step->conjugate && step->kind != HD_MODE_ZERO;
}

/** The step nearest to zero of a kind; -1 if none is found yet. */
static int lowest_of(const hd_steps *steps, hd_mode_kind kind)
{
    int lowest = -1;
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        if (step->kind != kind || !can_be_shown(step)) continue;
        if (lowest < 0 || step->exponent < hd_steps_step(steps, lowest)->exponent) lowest = s;
    }
    return lowest;
}

/** Step of a mode asked for by its name; -1 while it is not found. */
static int named(const hd_steps *steps, const marker_mode *mode)
{
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        const bool same = (int)step->kind == mode->kind && step->wave.n[0] == mode->n[0] &&
                          step->wave.n[1] == mode->n[1];
        if (same && can_be_shown(step)) return s;
    }
    return -1;
}

/** Modes in the picture; none if nobody observes steps. */
static int modes_count(const marker_report *r)
{
    if (!r->modes) return 0;
    return r->set->markers.count > 0 ? r->set->markers.count : r->kinds;
}

static hd_mode_kind kind_of(const marker_report *r, int k)
{
    if (r->set->markers.count > 0) return (hd_mode_kind)r->set->markers.mode[k].kind;
    return r->kind[k];
}

/** Step that mode k of the picture belongs to; -1 while it is not found. */
static int step_of(const marker_report *r, const hd_steps *steps, int k)
{
    return r->set->markers.count > 0 ? named(steps, &r->set->markers.mode[k])
                                     : lowest_of(steps, kind_of(r, k));
}

/** First of the vectors that the picture wants; their number if it wants none. */
static int first_wanted(const marker_report *r, const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    int first = r->vectors;
    for (int k = 0; k < modes_count(r); k++) {
        const int s = step_of(r, steps, k), col = s < 0 ? first : field_report_example(steps, s);
        if (col < first) first = col;
    }
    return first;
}

void marker_report_demand(marker_report *r, hd_run *run)
{
    const bool watched = marker_report_watched(r);
    const bool paced = r->set->pace > 0.0 && hd_run_stage(run) == HD_AVERAGING;
    const double between = paced ? fmax(r->set->pace / r->set->markers.rate, DBL_MIN) : INFINITY;
    r->due = watched && clock_seconds() >= r->next;
    hd_run_watch(run, watched ? between : INFINITY, r->due ? first_wanted(r, run) : r->vectors);
}

/* ---- the picture --------------------------------------------------------------------------- */

static void fill_name(picture_mode *mode, const marker_report *r, const hd_steps *steps, int k,
                      int s)
{
    const char *kind = kind_of(r, k) == HD_MODE_T ? "T" : "LP";
    const marker_mode *asked = &r->set->markers.mode[k];
    const int *n = s >= 0 ? hd_steps_step(steps, s)->wave.n : asked->n;
    if (s < 0 && r->set->markers.count == 0)
        snprintf(mode->name, sizeof mode->name, "%s", kind);
    else
        snprintf(mode->name, sizeof mode->name, "%s(%d,%d)", kind, n[0], n[1]);
}

static void fill_pairs(picture_mode *mode, const hd_modes *modes, const hd_step *step, int col)
{
    const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(modes), step->subspace);
    const int pairs = subspace->dimension / 2;
    mode->pairs = (uint32_t)pairs;
    for (int c = 0; c < pairs; c++) {
        mode->a[c] = hd_modes_coefficients(modes, subspace->column + c)[col];
        mode->b[c] = hd_modes_coefficients(modes, subspace->column + pairs + c)[col];
    }
}

static void fill_mode(picture_mode *mode, const marker_report *r, const hd_run *run, int k)
{
    const hd_steps *steps = hd_run_steps(run);
    const hd_columns known = hd_run_columns(run);
    const int s = step_of(r, steps, k), col = s < 0 ? -1 : field_report_example(steps, s);
    const size_t disks = (size_t)r->set->def.disks, stride = (size_t)known.stride;
    *mode = (picture_mode){.kind = (uint8_t)kind_of(r, k)};
    fill_name(mode, r, steps, k, s);
    if (s < 0) return;
    mode->found = true;
    mode->index = (uint32_t)col + 1;
    mode->exponent = hd_spectrum_exponent(hd_run_spectrum(run), col);
    if (col < known.first || col >= known.first + known.count) return;
    mode->known = true;
    mode->dx = outlets_array(known.data + (col - known.first), disks, 4 * stride);
    mode->dy = outlets_array(known.data + stride + (size_t)(col - known.first), disks, 4 * stride);
    if (mode->kind == HDR_MODE_LP)
        fill_pairs(mode, hd_run_modes(run), hd_steps_step(steps, s), col);
}

static void fill_exponents(picture *p, marker_report *r, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    p->has_exponents = r->vectors > 0;
    p->averaged = spectrum ? hd_spectrum_time(spectrum) : 0.0;
    if (!(p->averaged > 0.0)) return;
    for (int k = 0; k < r->vectors; k++) r->exponents[k] = hd_spectrum_exponent(spectrum, k);
    p->exponents = outlets_array(r->exponents, (size_t)r->vectors, 1);
}

static void fill_scene(picture *p, const settings *set)
{
    p->scene = set->scene;
    hd_scene_box(&set->def, p->box);
    for (int d = 0; d < 2; d++) p->periodic[d] = set->def.boundary[d] == HD_PERIODIC;
}

static bool is_finite(const picture *p, const double *q, size_t disks)
{
    for (int k = 0; k < p->modes; k++) {
        const picture_mode *m = &p->mode[k];
        double sum = m->exponent;
        for (uint32_t i = 0; i < m->dx.count; i++)
            sum += m->dx.data[i * m->dx.stride] + m->dy.data[i * m->dy.stride];
        for (uint32_t c = 0; c < m->pairs; c++) sum += m->a[c] + m->b[c];
        if (!isfinite(sum)) return false;
    }
    return outlets_finite(q, 2 * disks) &&
           (p->exponents.count == 0 || outlets_finite(p->exponents.data, p->exponents.count));
}

static hd_status draw(marker_report *r, const hd_run *run)
{
    const size_t disks = (size_t)r->set->def.disks;
    picture p = {
        .phase = hdr_phase_name((unsigned)hd_run_stage(run)),
        .time = hd_run_time(run),
        .progress = hd_run_cost(run).progress,
        .x = outlets_array(r->q, disks, 2),
        .y = outlets_array(r->q + 1, disks, 2),
        .modes = modes_count(r),
    };
    hdr_steps steps;
    hdr_markers markers;
    hd_trajectory_state(hd_run_trajectory(run), r->q, r->p);
    fill_scene(&p, r->set);
    fill_exponents(&p, r, run);
    for (int k = 0; k < p.modes; k++) fill_mode(&p.mode[k], r, run, k);
    if (r->modes && !mode_report_steps(r->modes, &steps, run)) return HD_NOT_FINITE;
    if (r->modes) p.steps = &steps;
    if (!is_finite(&p, r->q, disks)) return HD_NOT_FINITE;
    if (!view_draw(r->view, &markers, &p, outlets_frame()))
        hdr_log(HDR_ERROR, "markers not drawn: out of memory");
    else if (hdr_markers_publish(r->publisher, &markers) != HDR_OK)
        hdr_log(HDR_ERROR, "markers not sent: %s", hdr_error_text());
    return HD_OK;
}

/** True once the vectors that are wanted are known: a step may end elsewhere. */
static bool is_ready(const marker_report *r, const hd_run *run)
{
    const hd_columns known = hd_run_columns(run);
    const int first = first_wanted(r, run);
    return first == r->vectors || (known.count > 0 && known.first <= first);
}

hd_status marker_report_publish(marker_report *r, const hd_run *run)
{
    if (!r->due || !is_ready(r, run)) return HD_OK;
    const double now = clock_seconds();
    r->next = fmax(r->next + 1.0 / r->set->markers.rate, now);
    r->last = now;
    return draw(r, run);
}

hd_status marker_report_rest(marker_report *r, const hd_run *run)
{
    if (clock_seconds() - r->last < rest_seconds) return HD_OK;
    return draw(r, run);
}
