/** The steps of a run as a table in the node's log, for who looks at a terminal. */
#ifndef HDLYAP_TABLE_H
#define HDLYAP_TABLE_H

#include "hdlyap/run.h"
#include "settings.h"

/** What the last table said. Zero at the start. */
typedef struct table {
    double wall;     /**< when [s] */
    double averaged; /**< time units */
    int known;       /**< steps found, each once more if its error is known */
} table;

/** After a report: prints it if the settings ask for it, and the averages have doubled or more is
 * known of the steps, not more often than asked for. */
void table_tell(table *t, const settings *set, const hd_run *run);

/** The last one, of a run that has ended. */
void table_result(const settings *set, const hd_run *run);

#endif
