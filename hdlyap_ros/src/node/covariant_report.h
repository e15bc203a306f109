/** What the core knows of covariant vectors -> the message covariant. Owns the buffers that it is
 * written from. */
#ifndef HDLYAP_COVARIANT_REPORT_H
#define HDLYAP_COVARIANT_REPORT_H

#include "hdlyap/run.h"
#include "publishers.h"

typedef struct covariant_report covariant_report;

/** Of a run that observes them; `to` lives longer and is read only by covariant_report_publish.
 * Windows of before, from a checkpoint, are not published again. False if out of memory. */
bool covariant_report_create(covariant_report **out, const publishers *to, const hd_run *run);
void covariant_report_free(covariant_report *r);

/** About how many numbers its message has. */
double covariant_report_size(const covariant_report *r);

/** After a step: publishes the averages, if a window has ended in it and somebody listens.
 * HD_NOT_FINITE, and nothing is published, if a number of it is not. */
HD_MUST_CHECK hd_status covariant_report_publish(covariant_report *r, const hd_run *run);

#endif
