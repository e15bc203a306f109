/** Command line of a benchmark program: --name value, or --name alone. */
#ifndef HD_BENCH_OPTIONS_H
#define HD_BENCH_OPTIONS_H

#include <stdbool.h>

#include "restart.h"

/** One option; exactly one of the pointers is not NULL. A list ends with a name of NULL. */
typedef struct option {
    const char *name;  /**< with its dashes */
    bool *flag;        /**< set to true; the option has no value */
    const char **text; /**< any text */
    int *count;        /**< a whole number, least .. most */
    double *number;    /**< a number, least .. most */
    double least, most;
} option;

/** Reads the command line. If an argument is not in the list, or its value is not allowed, prints a
 * line and ends the program with status 2. */
void options_read(int argc, char **argv, const option *list);

#endif
