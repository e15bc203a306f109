/** Standard errors over averaged time -> whether they fall, as they do in a stationary run: as
 * 1/sqrt(time). */
#ifndef HDLYAP_ERROR_COURSE_H
#define HDLYAP_ERROR_COURSE_H

#include <stdbool.h>

enum { ERROR_COURSE_MARKS = 64 };

typedef struct error_at {
    double time, error; /**< averaged time; its standard error */
} error_at;

/** Zero: nothing known. */
typedef struct error_course {
    error_at mark[ERROR_COURSE_MARKS]; /**< the first of each doubling of the time; time 0: none */
    error_at last;
    double first; /**< time of the first error known */
} error_course;

/** What is known at that averaged time; an error below 0 is not known. A time that has gone back
 * begins anew. */
void error_course_add(error_course *course, double time, double error);

/** True if the error is not what it should be against `since`, an eighth of the time ago or more;
 * false too while the course is too short to say. */
bool error_course_stalled(const error_course *course, error_at *since);

#endif
