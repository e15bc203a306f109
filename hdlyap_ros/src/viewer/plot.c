/** Axes of a plot in the scene. */
#include "plot.h"

#include <math.h>
#include <string.h>

#include "palette.h"

/** Of the axes, in units of the text's height. */
static const double TICK = 0.4, LABEL_DISTANCE = 1.3, LINE = 0.12;
enum { TICKS = 4 };

double plot_x(const plot *p, double number)
{
    return p->area.x + p->area.width * (number - p->min[0]) / (p->max[0] - p->min[0]);
}

double plot_y(const plot *p, double number)
{
    return p->area.y + p->area.height * (number - p->min[1]) / (p->max[1] - p->min[1]);
}

bool plot_contains(const plot *p, double x, double y)
{
    return x >= p->min[0] && x <= p->max[0] && y >= p->min[1] && y <= p->max[1];
}

/** 1, 2 or 5 times a power of ten, not below x > 0. */
static double round_step(double x)
{
    const double ten = pow(10.0, floor(log10(x))), digit = x / ten;
    return ten * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

double plot_round_up(double x)
{
    if (!(x > 0.0)) return 1.0;
    const double step = round_step(x / TICKS);
    return step * ceil(x / step);
}

static double first_tick(const plot *p, int axis, double *step)
{
    *step = round_step((p->max[axis] - p->min[axis]) / TICKS);
    return *step * ceil(p->min[axis] / *step - 1e-9);
}

static void draw_frame(const plot *p)
{
    const rect *r = &p->area;
    double step;
    canvas_layer(p->on, p->ns, HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * p->unit);
    canvas_line(p->on, r->x, r->y, r->x + r->width, r->y);
    canvas_line(p->on, r->x, r->y, r->x, r->y + r->height);
    for (double x = first_tick(p, 0, &step); x <= p->max[0] + 1e-9 * step; x += step)
        canvas_line(p->on, plot_x(p, x), r->y, plot_x(p, x), r->y + TICK * p->unit);
    for (double y = first_tick(p, 1, &step); y <= p->max[1] + 1e-9 * step; y += step)
        canvas_line(p->on, r->x, plot_y(p, y), r->x + TICK * p->unit, plot_y(p, y));
}

/** Without the remains of rounding. */
static double tidy(double number, double step) { return fabs(number) < 1e-6 * step ? 0.0 : number; }

static void draw_numbers(const plot *p)
{
    const double away = LABEL_DISTANCE * p->unit, height = 0.85 * p->unit;
    double step;
    for (double x = first_tick(p, 0, &step); x <= p->max[0] + 1e-9 * step; x += step)
        canvas_text(p->on, p->ns, plot_x(p, x), p->area.y - away, height, PALETTE_INK, "%.4g",
                    tidy(x, step));
    for (double y = first_tick(p, 1, &step); y <= p->max[1] + 1e-9 * step; y += step)
        canvas_text(p->on, p->ns, p->area.x - away, plot_y(p, y), height, PALETTE_INK, "%.4g",
                    tidy(y, step));
}

void plot_axes(const plot *p, const char *title, const char *x_label, const char *y_label)
{
    const rect *r = &p->area;
    const double away = LABEL_DISTANCE * p->unit;
    draw_frame(p);
    draw_numbers(p);
    canvas_text(p->on, p->ns, r->x + 0.5 * r->width, r->y - 2.2 * away, p->unit, PALETTE_INK, "%s",
                x_label);
    canvas_text(p->on, p->ns, r->x + 0.5 * r->width, r->y + r->height + 1.2 * away, p->unit,
                PALETTE_INK, "%s", title);
    canvas_text(p->on, p->ns, r->x - away, r->y + r->height + 0.9 * away, p->unit, PALETTE_INK,
                "%s", y_label);
}
