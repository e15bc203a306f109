/** All that a run says by its public interface, number by number: of each part of hd_run_parts, row
 * by row of hdlyap/observables.inc, and of the run itself. */
#ifndef HD_SAID_H
#define HD_SAID_H

#include "hdlyap/run.h"

/** One of them: the part that says it, what it is, and which one of its kind. */
typedef struct said_number {
    const char *part, *name;
    size_t place;
    double value;
} said_number;

typedef struct said {
    said_number *number;
    size_t count, room;
    const char *part; /**< which part is read */
} said;

/** Exponents and observables. Simulated times count from where the stage began. */
said said_of_averages(const hd_run *run);
/** These, the trajectory, and what the run says of itself but for the wall clock. */
said said_by(const hd_run *run);
void said_free(said *s);

/** The same numbers, bit by bit; or NaN, both. */
void expect_same_said(const said *a, const said *b);

#endif
