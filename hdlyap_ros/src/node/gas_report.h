/** What the core knows of the gas -> the message gas. */
#ifndef HDLYAP_GAS_REPORT_H
#define HDLYAP_GAS_REPORT_H

#include "hdlyap/run.h"
#include "publishers.h"

/** Numbers in its message. */
#define GAS_REPORT_SIZE 11.0

/** Publishes the averages of a run that observes them, if there are any. HD_NOT_FINITE, and nothing
 * is published, if a number of them is not. */
HD_MUST_CHECK hd_status gas_report_publish(const publishers *to, const hd_run *run);

#endif
