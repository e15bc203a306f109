/** Colours of Okabe and Ito, safe for colour-blind readers; hue says the kind, as in the figures of
 * hdlyap plot. */
#ifndef HDLYAP_PALETTE_H
#define HDLYAP_PALETTE_H

#include "hdlyap_ros/markers.h"

static const hdr_colour PALETTE_T = {0.0F, 0.447F, 0.698F, 1.0F};  /* #0072B2 */
static const hdr_colour PALETTE_LP = {0.835F, 0.369F, 0.0F, 1.0F}; /* #D55E00 */
static const hdr_colour PALETTE_L = {0.902F, 0.624F, 0.0F,
                                     1.0F}; /* #E69F00, an LP mode that is all L */
static const hdr_colour PALETTE_P = {0.40F, 0.12F, 0.02F, 1.0F}; /* and one that is all P */
static const hdr_colour PALETTE_DISK = {0.86F, 0.86F, 0.86F, 1.0F};
/** As of glass: arrows are seen through it. */
static const hdr_colour PALETTE_SPHERE = {0.5F, 0.5F, 0.5F, 0.3F};
/** Lines and texts that are of no step: legible on white and on rviz's own dark grey.
 */
static const hdr_colour PALETTE_INK = {0.42F, 0.42F, 0.42F, 1.0F};

/** part 0 .. 1 of the way from a to b. */
static inline hdr_colour palette_mix(hdr_colour a, hdr_colour b, double part)
{
    const float p = (float)part;
    return (hdr_colour){a.r + p * (b.r - a.r), a.g + p * (b.g - a.g), a.b + p * (b.b - a.b), 1.0F};
}

static inline hdr_colour palette_kind(int kind)
{
    if (kind == HDR_MODE_T) return PALETTE_T;
    return kind == HDR_MODE_LP ? PALETTE_LP : PALETTE_INK;
}

#endif
