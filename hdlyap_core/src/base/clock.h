/** Wall seconds from some fixed moment, for what the run costs; results never depend on it. */
#ifndef HD_CLOCK_H
#define HD_CLOCK_H

double hd_clock_now(void);

#endif
