/** Sample -> a printed line, a row of a table. */
#include "ratio.h"

#include <stdio.h>

table *ratio_begin(const char *folder, const char *name)
{
    printf("%-52s %8s %8s %8s\n", "", "least", "median", "most");
    return folder ? table_create(folder, name, "quantity,disks,minimum,median,maximum,rounds")
                  : NULL;
}

void ratio_tell(table *t, const char *quantity, int disks, const sample *s)
{
    const double least = sample_least(s), median = sample_median(s), most = sample_most(s);
    printf("%-52s %8.4g %8.4g %8.4g\n", quantity, least, median, most);
    if (t) table_row(t, "%s,%d,%.6g,%.6g,%.6g,%d", quantity, disks, least, median, most, s->count);
}
