/** The frame and its intervals in a checkpoint, and the bytes that they take there. */
#ifndef HD_TANGENT_ARCHIVED_H
#define HD_TANGENT_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/frame.h"
#include "hdlyap/localization.h"
#include "tangent/interval.h"

/** Reads or writes the frame. With several ranks each one reads the whole file; when writing, rank
 * 0 gets the vectors of all. Fails with HD_NO_MEMORY on all ranks. */
HD_MUST_CHECK hd_status hd_frame_archive(hd_frame *frame, hd_archive *archive);
/** Numbers that it reads or writes. */
double hd_frame_archived(const hd_dynamics *of, int particles, int vectors);
/** Bytes of a frame of this many vectors on one rank, without its tangent maps. */
double hd_frame_bytes(const hd_dynamics *of, double rows, double vectors, double threads);
double hd_ortho_bytes(double rows, double vectors, double ranks);
/** most: as hd_conjugate_create. */
double hd_conjugate_bytes(double rows, double most);
void hd_interval_archive(hd_interval *interval, hd_archive *archive);
void hd_localization_archive(hd_localization *shape, hd_archive *archive);
double hd_localization_bytes(double vectors);

#endif
