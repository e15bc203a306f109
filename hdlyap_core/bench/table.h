/** A CSV file: a comment with machine and command, a header with units, rows. */
#ifndef HD_BENCH_TABLE_H
#define HD_BENCH_TABLE_H

typedef struct table table;

/** Begins a table, which will be folder/name.csv. header: names of the columns, with commas
 * between. */
table *table_create(const char *folder, const char *name, const char *header);

/** Adds a row. The text has commas, but no end of line. */
__attribute__((format(printf, 2, 3))) void table_row(table *t, const char *format, ...);

/** Writes the file in one step, so that it is complete or still the old one, and frees t. A fault
 * ends the program with status 4. argv: the command; dgemm: flops per second measured meanwhile. */
void table_write(table *t, char **argv, double dgemm);

#endif
