/** Command line of a benchmark program: --name value, or --name alone. */
#ifndef HD_BENCH_OPTIONS_H
#define HD_BENCH_OPTIONS_H

#include <stdbool.h>

/** One option; exactly one of the pointers is not NULL. A list ends with a name of NULL. */
typedef struct option {
    const char *name;  /**< with its dashes */
    bool *flag;        /**< set */
    const char **text; /**< any */
    int *count;        /**< least .. most */
    double *number;    /**< least .. most */
    double least, most;
} option;

/** An argument that is not in the list, or not allowed, gives one line and ends the program with
 * status 2. */
void options_read(int argc, char **argv, const option *list);

#endif
