/** What the core knows of how far vectors spread -> the message localization. Owns the buffers that
 * it is written from. */
#ifndef HDLYAP_LOCALIZATION_REPORT_H
#define HDLYAP_LOCALIZATION_REPORT_H

#include "hdlyap/run.h"
#include "publishers.h"

typedef struct localization_report localization_report;

/** Of a run that observes it; `to` lives longer and is read only by localization_report_publish.
 * False if out of memory. */
bool localization_report_create(localization_report **out, const publishers *to, const hd_run *run);
void localization_report_free(localization_report *r);

/** About how many numbers its message has. */
double localization_report_size(const localization_report *r);

/** Publishes the averages, if there are any. HD_NOT_FINITE, and nothing is published, if a number
 * of them is not. */
HD_MUST_CHECK hd_status localization_report_publish(localization_report *r, const hd_run *run);

#endif
