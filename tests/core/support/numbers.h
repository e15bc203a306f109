/** The numbers that a run publishes with a standard error, side by side: those of one scene keep
 * their places, whatever the seed. */
#ifndef HD_TEST_NUMBERS_H
#define HD_TEST_NUMBERS_H

#include <hdlyap/run.h>

typedef struct number {
    double value, error; /**< error negative: not stated */
    /** What it was found from: a bit for each step of hd_steps, the last bit for all that is found
     * from no steps; 0: it is not published. */
    uint64_t of;
} number;

/** Numbers of one kind: one row of a table. */
typedef struct row_of_numbers {
    char name[32];
    int first, count; /**< numbers [first, first + count) */
} row_of_numbers;

enum { NUMBER_ROWS_MAX = 96 };

/** Of this scene; out[NUMBER_ROWS_MAX]. Returns their number. The first are the positive
 * exponents. */
int numbers_rows(const hd_run *run, row_of_numbers *out);
/** As the run would publish them now; out: up to the end of the last row. Of seeds that are
 * compared. */
void numbers_read(const hd_run *run, number *out);

#endif
