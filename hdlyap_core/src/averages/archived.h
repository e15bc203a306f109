/** What a checkpoint holds of a spectrum. */
#ifndef HD_AVERAGES_ARCHIVED_H
#define HD_AVERAGES_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/spectrum.h"

void hd_spectrum_archive(hd_spectrum *spectrum, hd_archive *archive);

#endif
