/** The run -> pictures for rviz, a few a second while somebody looks. Owns the topic ~markers. */
#ifndef HDLYAP_MARKER_REPORT_H
#define HDLYAP_MARKER_REPORT_H

#include "mode_report.h"
#include "settings.h"

typedef struct marker_report marker_report;

/** Advertises ~markers, and says which frame the box is. All live longer; modes may be NULL.
 * HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status marker_report_create(marker_report **out, hdr_node *ros,
                                               const settings *set, const hd_run *run,
                                               mode_report *modes);
void marker_report_free(marker_report *r);

/** True while somebody looks. */
bool marker_report_watched(const marker_report *r);

/** Tells the run which vectors the next step is to end with. */
void marker_report_demand(marker_report *r, hd_run *run);

/** Draws the run as it is after a step, if it is time to. HD_NOT_FINITE; one that is not drawn for
 * want of memory is only logged. */
HD_MUST_CHECK hd_status marker_report_publish(marker_report *r, const hd_run *run);

/** Draws a run that will stand still, unless that has just been done: who comes while it does gets
 * this picture. */
HD_MUST_CHECK hd_status marker_report_rest(marker_report *r, const hd_run *run);

#endif
