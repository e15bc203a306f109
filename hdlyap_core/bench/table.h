/** A CSV file: a comment with machine and command, a header with units, rows. */
#ifndef HD_BENCH_TABLE_H
#define HD_BENCH_TABLE_H

typedef struct table table;

/** header: names of the columns, with commas between. The path is folder/name.csv. */
table *table_create(const char *folder, const char *name, const char *header);

/** One row, with commas, without the end of line. */
__attribute__((format(printf, 2, 3))) void table_row(table *t, const char *format, ...);

/** Writes the file in one step: it is complete or the old one. A fault ends the program with
 * status 4. argv: the command; dgemm: flops per second measured meanwhile. Frees t. */
void table_write(table *t, char **argv, double dgemm);

#endif
