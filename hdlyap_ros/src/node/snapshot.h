/** The run at the time of a report: what all its messages are made of. */
#ifndef HDLYAP_SNAPSHOT_H
#define HDLYAP_SNAPSHOT_H

#include "hdlyap/run.h"

typedef struct snapshot {
    const hd_run *run;
    const double *q, *p; /**< [2N] each, x0 y0 x1 y1 ..; only for who has said that it reads them */
} snapshot;

#endif
