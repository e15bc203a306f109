/** What the core knows of the modes -> the messages modes, steps, lp_phases, t_phases and hydro.
 * Owns the buffers that they are written from. */
#ifndef HDLYAP_MODE_REPORT_H
#define HDLYAP_MODE_REPORT_H

#include "publishers.h"
#include "snapshot.h"

typedef struct mode_report mode_report;

/** With buffers for those that the run observes; `to` lives longer and is read only by
 * mode_report_publish. False if out of memory. */
bool mode_report_create(mode_report **out, const publishers *to, const hd_run *run);
void mode_report_free(mode_report *m);

/** Writes to doubles[TOPICS] about how many numbers its messages have. */
void mode_report_sizes(const mode_report *m, double *doubles);

/** Publishes those of a set of topics that are its own, of a run with samples of modes.
 * HD_NOT_FINITE, and nothing of the message concerned is published, if a number of it is not. */
HD_MUST_CHECK hd_status mode_report_publish(mode_report *m, const snapshot *now, unsigned set);

#endif
