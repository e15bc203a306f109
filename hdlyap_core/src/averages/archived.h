/** The spectrum in a checkpoint, and the bytes that it takes there. */
#ifndef HD_AVERAGES_ARCHIVED_H
#define HD_AVERAGES_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/spectrum.h"

void hd_spectrum_archive(hd_spectrum *spectrum, hd_archive *archive);
double hd_spectrum_bytes(double vectors);

#endif
