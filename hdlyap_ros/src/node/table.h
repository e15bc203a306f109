/** The steps of a run as a table in the node's log, for a user at a terminal. */
#ifndef HDLYAP_TABLE_H
#define HDLYAP_TABLE_H

#include "hdlyap/run.h"
#include "settings.h"

/** What the last table contained; all zero at the start. */
typedef struct table {
    double wall;     /**< when [s] */
    double averaged; /**< time units */
    int known;       /**< number of steps found, plus number of those with a known error */
} table;

/** Called after a report. Prints the table, if the settings ask for it, when the averaged time has
 * doubled or more steps or errors are known, but not more often than the settings say. */
void table_tell(table *t, const settings *set, const hd_run *run);

/** Prints the last table, of a run that has ended. */
void table_result(const settings *set, const hd_run *run);

#endif
