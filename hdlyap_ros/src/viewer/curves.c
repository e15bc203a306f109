/** The plots and the caption of a picture. */
#include "curves.h"

#include <math.h>
#include <stdio.h>

#include "common/numbers.h"
#include "common/nodes.h"
#include "palette.h"
#include "plot.h"

enum {
    CURVE_POINTS = 400, /* of a curve; more cannot be seen */
    LOWEST_MIN = 24,    /* exponents that are magnified at least */
    LOWEST_MAX = 60,
    NAMES_MAX = 12 /* of steps */
};
static const double LINE = 0.2, DOT = 0.55, FIT_LINE = 0.12; /* in units of the text's height */

/* ---- the spectrum -------------------------------------------------------------------------- */

static double exponent(const picture *p, uint32_t index)
{
    return p->exponents.data[(size_t)(index - 1) * p->exponents.stride];
}

/** Index of the last positive exponent, or of the last one carried. */
static uint32_t last_positive(const picture *p)
{
    uint32_t last = p->exponents.count;
    while (last > 1 && exponent(p, last) <= 0.0) last--;
    return last;
}

static bool is_shown(const hdr_step *step)
{
    return step->resolved && !step->conjugate && step->kind != HDR_MODE_ZERO;
}

static void whole(canvas *on, const layout *l, const picture *p)
{
    const uint32_t n = p->exponents.count;
    const double top = plot_round_up(n ? exponent(p, 1) : 1.0);
    const double low = n && exponent(p, n) < -0.1 * top ? -top : 0.0;
    const plot axes = {on, "spectrum", l->spectrum, l->unit, {0.0, low}, {n ? n : 1.0, top}};
    plot_axes(&axes, "spectrum", "index", "lambda");
    canvas_layer(on, "spectrum", HDR_MARKER_LINE_STRIP, PALETTE_INK, LINE * l->unit);
    const uint32_t every = 1 + n / CURVE_POINTS;
    for (uint32_t i = 1; i <= n; i += every)
        canvas_point(on, plot_x(&axes, i), plot_y(&axes, exponent(p, i)), 0.0);
}

/** From which index on exponents are magnified: all steps, within reason. */
static uint32_t first_magnified(const picture *p, uint32_t last)
{
    uint32_t count = LOWEST_MIN;
    for (uint32_t k = 0; p->steps && k < p->steps->steps.count; k++) {
        const hdr_step *step = &p->steps->steps.data[k];
        if (is_shown(step) && last - step->first_index + 4 > count)
            count = last - step->first_index + 4;
    }
    if (count > LOWEST_MAX) count = LOWEST_MAX;
    return last > count ? last - count : 1;
}

static const hdr_step *step_of(const picture *p, uint32_t index)
{
    for (uint32_t k = 0; p->steps && k < p->steps->steps.count; k++) {
        const hdr_step *step = &p->steps->steps.data[k];
        if (is_shown(step) && index >= step->first_index && index <= step->last_index) return step;
    }
    return NULL;
}

/** From the lowest upwards, above to the right and below to the left in turn: there is no other
 * exponent. One is at least a line above the one before it on its side. */
static void step_names(const plot *axes, const picture *p, uint32_t last)
{
    const hdr_step *before = NULL;
    char nodes[NODES_SIZE];
    double least[2] = {-HUGE_VAL, -HUGE_VAL};
    int names = 0;
    for (uint32_t i = last; i > axes->min[0] && names < NAMES_MAX; i--) {
        const hdr_step *step = step_of(p, i);
        if (!step || step == before) continue;
        const int left = names++ % 2;
        const double side = left ? -1.0 : 1.0;
        const double x = plot_x(axes, left ? step->first_index : step->last_index);
        const double y = fmax(plot_y(axes, step->exponent) + side * 0.9 * axes->unit, least[left]);
        canvas_text(axes->on, axes->ns, x + side * 2.4 * axes->unit, y, 0.85 * axes->unit,
                    palette_kind(step->kind), "%s%s%s", hdr_mode_kind_text(step->kind),
                    nodes_write(nodes, picture_has_spheres(p), step->nx, step->ny, step->nz),
                    step->members > 1 ? "+" : "");
        least[left] = y + axes->unit;
        before = step;
    }
}

static void lowest(canvas *on, const layout *l, const picture *p)
{
    const uint32_t last = p->exponents.count ? last_positive(p) : 1;
    const uint32_t first = first_magnified(p, last);
    const double top = p->exponents.count ? 1.05 * exponent(p, first) : 1.0;
    const plot axes = {on,      "spectrum",         l->lowest,
                       l->unit, {first - 1.0, 0.0}, {last + 1.0, plot_round_up(top)}};
    plot_axes(&axes, "smallest positive exponents", "index", "lambda");
    canvas_layer(on, "spectrum", HDR_MARKER_POINTS, PALETTE_INK, DOT * l->unit);
    for (uint32_t i = first; i <= last && p->exponents.count; i++) {
        const hdr_step *step = step_of(p, i);
        canvas_coloured(on, plot_x(&axes, i), plot_y(&axes, exponent(p, i)), 0.0,
                        step ? palette_kind(step->kind) : PALETTE_INK);
    }
    step_names(&axes, p, last);
}

void curves_spectrum(canvas *on, const layout *l, const picture *p)
{
    whole(on, l, p);
    lowest(on, l, p);
}

/* ---- the dispersion relation --------------------------------------------------------------- */

static void dispersion_range(plot *axes, const picture *p)
{
    double most[2] = {0.0, 0.0};
    for (uint32_t k = 0; p->steps && k < p->steps->steps.count; k++) {
        const hdr_step *step = &p->steps->steps.data[k];
        if (!is_shown(step)) continue;
        most[0] = fmax(most[0], step->wave_number);
        most[1] = fmax(most[1], step->exponent + fmax(step->std_error, 0.0));
    }
    for (int d = 0; d < 2; d++) axes->max[d] = plot_round_up(1.05 * most[d]);
}

static double relation(double k, double c, double c2, double c3)
{
    return k * (c + k * (c2 + k * c3));
}

/** c2 and c3 are NaN where they were not fitted. */
static void fit_curve(const plot *axes, double c, double c2, double c3, int kind)
{
    enum { PIECES = 40 };
    const double bend = isnan(c2) ? 0.0 : c2, third = isnan(c3) ? 0.0 : c3;
    canvas_layer(axes->on, axes->ns, HDR_MARKER_LINE_LIST, palette_kind(kind),
                 FIT_LINE * axes->unit);
    for (int piece = 0; piece < PIECES; piece++) {
        const double k0 = axes->max[0] * piece / PIECES, k1 = axes->max[0] * (piece + 1) / PIECES;
        const double y0 = relation(k0, c, bend, third), y1 = relation(k1, c, bend, third);
        if (plot_contains(axes, k0, y0) && plot_contains(axes, k1, y1))
            canvas_line(axes->on, plot_x(axes, k0), plot_y(axes, y0), plot_x(axes, k1),
                        plot_y(axes, y1));
    }
}

static void error_bars(const plot *axes, const hdr_steps *steps)
{
    canvas_layer(axes->on, axes->ns, HDR_MARKER_LINE_LIST, PALETTE_INK, FIT_LINE * axes->unit);
    for (uint32_t k = 0; k < steps->steps.count; k++) {
        const hdr_step *step = &steps->steps.data[k];
        const double error = fmin(fmax(step->std_error, 0.0), step->exponent);
        if (is_shown(step) && error > 0.0)
            canvas_line(axes->on, plot_x(axes, step->wave_number),
                        plot_y(axes, step->exponent - error), plot_x(axes, step->wave_number),
                        plot_y(axes, step->exponent + error));
    }
}

static void step_points(const plot *axes, const hdr_steps *steps)
{
    canvas_layer(axes->on, axes->ns, HDR_MARKER_POINTS, PALETTE_INK, DOT * axes->unit);
    for (uint32_t k = 0; k < steps->steps.count; k++) {
        const hdr_step *step = &steps->steps.data[k];
        if (is_shown(step))
            canvas_coloured(axes->on, plot_x(axes, step->wave_number), plot_y(axes, step->exponent),
                            0.0, palette_kind(step->kind));
    }
}

/** LP steps in a circle are not. */
static bool is_related(const hdr_steps *steps) { return !isnan(steps->l_long_c2); }

void curves_dispersion(canvas *on, const layout *l, const picture *p)
{
    plot axes = {on, "dispersion", l->dispersion, l->unit, {0.0, 0.0}, {1.0, 1.0}};
    dispersion_range(&axes, p);
    plot_axes(&axes,
              p->steps && !is_related(p->steps) ? "T blue, LP orange (no relation)"
                                                : "dispersion: T blue, LP orange",
              "k [1/sigma]", "lambda");
    if (!p->steps) return;
    const hdr_steps *s = p->steps;
    if (s->t_points > 0) fit_curve(&axes, s->c_t, s->c_t2, s->c_t3, HDR_MODE_T);
    if (s->l_points > 0) fit_curve(&axes, s->c_l, s->c_l2, s->c_l3, HDR_MODE_LP);
    error_bars(&axes, p->steps);
    step_points(&axes, p->steps);
}

/* ---- the caption --------------------------------------------------------------------------- */

/** "c_T 3.2304(37), misfit 0.5    "; without what is not known. */
static size_t write_fit(char *text, size_t size, const char *name, bool known, double value,
                        double error, double misfit)
{
    char number[64] = "unknown";
    if (known) number_of_fit(number, sizeof number, value, error, misfit);
    return (size_t)snprintf(text, size, "%s %s    ", name, number);
}

/** Of exponents and steps, where they are asked for. */
static void write_results(char *text, size_t size, const picture *p)
{
    const hdr_steps *s = p->steps;
    size_t n = 0;
    if (p->has_exponents)
        n += write_fit(text, size, "lambda_max", p->exponents.count > 0, p->lambda_max,
                       p->lambda_max_error, -1.0);
    if (!s) return;
    n += (size_t)snprintf(text + n, size - n, "\n");
    n += write_fit(text + n, size - n, "c_T", s->t_points > 0, s->c_t, s->c_t_error, s->t_misfit);
    if (is_related(s))
        n += write_fit(text + n, size - n, "c_L", s->l_points > 0, s->c_l, s->c_l_error,
                       s->l_misfit);
    write_fit(text + n, size - n, "v", s->v_phases > 0, s->v, s->v_error, s->v_misfit);
}

/** Where the run is. */
static void write_time(char *text, size_t size, const picture *p)
{
    char done[24] = "";
    if (p->progress > 0.0) snprintf(done, sizeof done, " (%.0f %%)", 100.0 * p->progress);
    if (p->time >= 0.0)
        snprintf(text, size, "t = %.1f, %s%s, averaged %.1f", p->time, p->stage, done, p->averaged);
    else
        snprintf(text, size, "waiting for its first message");
}

static void write_box(char *text, size_t size, const picture *p)
{
    static const char *const end[] = {"reflecting", "periodic"};
    if (picture_has_spheres(p))
        snprintf(text, size, "%.4g x %.4g x %.4g, x %s, y %s, z %s", p->box[0], p->box[1],
                 p->box[2], end[p->periodic[0]], end[p->periodic[1]], end[p->periodic[2]]);
    else if (p->round)
        snprintf(text, size, "in a circle");
    else
        snprintf(text, size, "x %s, y %s", end[p->periodic[0]], end[p->periodic[1]]);
}

void curves_caption(canvas *on, const layout *l, const picture *p)
{
    char results[300] = "", time[80], box[100];
    write_box(box, sizeof box, p);
    write_results(results, sizeof results, p);
    write_time(time, sizeof time, p);
    canvas_text(on, "caption", l->caption_x, l->caption_y, 1.3 * l->unit, PALETTE_INK,
                "%.60s: %u %s, %s\n%s%s%s\n%s", p->scene, (unsigned)p->disks,
                picture_has_spheres(p) ? "spheres" : "disks", box, time, *p->note ? "   " : "",
                p->note, results);
}
