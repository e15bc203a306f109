/** What is told of a quantity that was measured in several rounds: least, median, most. */
#ifndef HD_BENCH_RATIO_H
#define HD_BENCH_RATIO_H

#include "sample.h"
#include "table.h"

/** A table of its own for table_write; prints the heading. folder NULL: prints only, and the table
 * is NULL. */
table *ratio_begin(const char *folder, const char *name);
void ratio_tell(table *t, const char *quantity, int disks, const sample *s);

#endif
