/** Standard errors over averaged time -> whether they fall, as they do in a stationary run: as
 * 1/sqrt(time). */
#ifndef HD_ERROR_TREND_H
#define HD_ERROR_TREND_H

#include <stdbool.h>

enum { HD_ERROR_TREND_MARKS = 64 };

typedef struct hd_error_at {
    double time, error; /**< averaged time; its standard error */
} hd_error_at;

/** Zero: nothing known. */
typedef struct hd_error_trend {
    hd_error_at
        mark[HD_ERROR_TREND_MARKS]; /**< the first of each doubling of the time; time 0: none */
    hd_error_at last;
    double first; /**< time of the first error known */
} hd_error_trend;

/** What is known at that averaged time; an error below 0 is not known. A time that has gone back
 * begins anew. */
void hd_error_trend_add(hd_error_trend *trend, double time, double error);

/** True if the error is not what it should be against `since`, an eighth of the time ago or more;
 * false too while the trend is too short to say. */
bool hd_error_trend_stalled(const hd_error_trend *trend, hd_error_at *since);

#endif
