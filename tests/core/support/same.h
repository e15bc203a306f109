/** Two runs that must be in the same state, bit for bit. */
#ifndef HD_SAME_H
#define HD_SAME_H

#include "hdlyap/run.h"

/** What is kept; and, of what nothing else depends on, what is read. */
void expect_same_state(hd_run *a, hd_run *b);

#endif
