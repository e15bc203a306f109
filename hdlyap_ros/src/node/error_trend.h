/** Standard errors over averaged time -> whether they fall, as they do in a stationary run: as
 * 1/sqrt(time). */
#ifndef HDLYAP_ERROR_TREND_H
#define HDLYAP_ERROR_TREND_H

#include <stdbool.h>

enum { ERROR_TREND_MARKS = 64 };

typedef struct error_at {
    double time, error; /**< averaged time; its standard error */
} error_at;

/** Zero: nothing known. */
typedef struct error_trend {
    error_at mark[ERROR_TREND_MARKS]; /**< the first of each doubling of the time; time 0: none */
    error_at last;
    double first; /**< time of the first error known */
} error_trend;

/** What is known at that averaged time; an error below 0 is not known. A time that has gone back
 * begins anew. */
void error_trend_add(error_trend *trend, double time, double error);

/** True if the error is not what it should be against `since`, an eighth of the time ago or more;
 * false too while the trend is too short to say. */
bool error_trend_stalled(const error_trend *trend, error_at *since);

#endif
