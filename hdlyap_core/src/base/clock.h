/** Wall seconds since some fixed moment. They measure what a run costs; results do not depend on
 * them. */
#ifndef HD_CLOCK_H
#define HD_CLOCK_H

double hd_clock_now(void);

#endif
