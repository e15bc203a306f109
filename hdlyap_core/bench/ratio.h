/** Prints a quantity that was measured in several rounds: least, median, most. */
#ifndef HD_BENCH_RATIO_H
#define HD_BENCH_RATIO_H

#include "sample.h"
#include "table.h"

/** Prints the heading. Returns a table, which table_write frees; NULL if folder is NULL. */
table *ratio_begin(const char *folder, const char *name);
void ratio_tell(table *t, const char *quantity, int disks, const sample *s);

#endif
