/** Every number that a run lets its user see. */
#ifndef HD_PUBLISHED_H
#define HD_PUBLISHED_H

#include "hdlyap/run.h"

/** Each is finite, and zero or no smaller than the smallest normal number; fails the test
 * otherwise, with its name. */
void check_published(const hd_run *run);

#endif
