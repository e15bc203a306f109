/** Wall time that only goes forward. */
#ifndef HDLYAP_CLOCK_H
#define HDLYAP_CLOCK_H

/** Seconds since some moment in the past. */
double clock_seconds(void);

#endif
