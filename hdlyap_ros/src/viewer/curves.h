/** The plots of a picture: the spectrum, its lowest exponents with their steps, the dispersion
 * relation. */
#ifndef HDLYAP_CURVES_H
#define HDLYAP_CURVES_H

#include "canvas.h"
#include "layout.h"

/** The whole spectrum, and its smallest positive exponents with the names of their steps. */
void curves_spectrum(canvas *on, const layout *l, const picture *p);

/** Exponents of the steps against the wave number, with their errors and the fits. */
void curves_dispersion(canvas *on, const layout *l, const picture *p);

/** The exponent of each resolved step of the positive half is drawn so far and no farther. */
void curves_caption(canvas *on, const layout *l, const picture *p);

#endif
