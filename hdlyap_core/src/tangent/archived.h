/** What a checkpoint holds of the frame and its intervals. */
#ifndef HD_TANGENT_ARCHIVED_H
#define HD_TANGENT_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/frame.h"
#include "hdlyap/localization.h"
#include "tangent/interval.h"

/** Of several ranks each reads all of a file, and the one that writes gets all vectors;
 * HD_NO_MEMORY on all of them. */
HD_MUST_CHECK hd_status hd_frame_archive(hd_frame *frame, hd_archive *archive);
void hd_interval_archive(hd_interval *interval, hd_archive *archive);
void hd_localization_archive(hd_localization *shape, hd_archive *archive);

#endif
