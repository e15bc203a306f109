/** Vectors of the frame -> the messages of fields, one for each vector asked for. Owns the
 * reconstruction of the L and P modes. */
#ifndef HDLYAP_FIELD_REPORT_H
#define HDLYAP_FIELD_REPORT_H

#include "publishers.h"
#include "settings.h"
#include "snapshot.h"

typedef struct field_report field_report;

/** Both live longer; `to` is read only by field_report_publish. False if out of memory. */
bool field_report_create(field_report **out, const publishers *to, const settings *set);
void field_report_free(field_report *r);

/** Column that stands for a resolved step: the first of its set that belongs to the step itself,
 * else the first one. */
int field_report_example(const hd_steps *steps, int s);

/** Numbers in the largest message. */
double field_report_size(const field_report *r);

/** Of a run with samples of modes; reads the state. HD_NOT_FINITE, and nothing of the message
 * concerned is published, if a number of it is not. */
HD_MUST_CHECK hd_status field_report_publish(field_report *r, const snapshot *now);

#endif
