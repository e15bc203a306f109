/** Structure factors that the core knows -> the message structure. Owns the buffers that it is
 * written from. */
#ifndef HDLYAP_STRUCTURE_REPORT_H
#define HDLYAP_STRUCTURE_REPORT_H

#include "publishers.h"
#include "snapshot.h"

typedef struct structure_report structure_report;

/** Of a run that observes them; `to` lives longer and is read only by structure_report_publish.
 * False if out of memory. */
bool structure_report_create(structure_report **out, const publishers *to, const hd_run *run);
void structure_report_free(structure_report *r);

/** About how many numbers its message has. */
double structure_report_size(const structure_report *r);

/** Publishes the amplitudes, and the mean structure factors if fields are due. HD_NOT_FINITE, and
 * nothing is published, if a number is not. */
HD_MUST_CHECK hd_status structure_report_publish(structure_report *r, const snapshot *now);

#endif
