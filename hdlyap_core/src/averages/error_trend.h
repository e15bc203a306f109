/** Standard errors over averaged time -> whether they fall, as they do in a stationary run: as
 * 1/sqrt(time). */
#ifndef HD_ERROR_TREND_H
#define HD_ERROR_TREND_H

#include <stdbool.h>

#include "base/archive.h"

enum { HD_ERROR_TREND_MARKS = 64 };

typedef struct hd_error_at {
    double time, error; /**< averaged time; its standard error */
} hd_error_at;

/** The trend of an error. All zeros: no error is known yet. */
typedef struct hd_error_trend {
    hd_error_at mark[HD_ERROR_TREND_MARKS]; /**< the first error in each doubling of the averaged
                                               time; time 0: none */
    hd_error_at last;
    double first; /**< averaged time at which the first error was known */
} hd_error_trend;

/** Adds the error at an averaged time; a negative error is not known yet. A time before the last
 * one starts the trend anew. */
void hd_error_trend_add(hd_error_trend *trend, double time, double error);

/** Whether the error has failed to fall since `since`, when the averaged time was an eighth of
 * today's or less. False while the averaged time is too short to tell. */
bool hd_error_trend_stalled(const hd_error_trend *trend, hd_error_at *since);

void hd_error_trend_archive(hd_error_trend *trend, hd_archive *archive);

#endif
