/** Axes of a plot in the scene: numbers -> places. */
#ifndef HDLYAP_PLOT_H
#define HDLYAP_PLOT_H

#include "canvas.h"
#include "layout.h"

typedef struct plot {
    canvas *on;
    const char *ns;
    rect area;
    double unit;           /**< height of text */
    double min[2], max[2]; /**< numbers at the ends of the axes */
} plot;

/** Frame, ticks and labels, and the layers that they are in. */
void plot_axes(const plot *p, const char *title, const char *x_label, const char *y_label);

double plot_x(const plot *p, double number);
double plot_y(const plot *p, double number);
bool plot_contains(const plot *p, double x, double y);

/** A number not below x with few digits, for the end of an axis. */
double plot_round_up(double x);

#endif
