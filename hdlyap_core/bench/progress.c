/** Work done -> a line that overwrites itself; ten lines if stderr is a file. */
#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "timing.h"

progress progress_begin(const char *what, double total)
{
    return (progress){.what = what, .total = total, .start = seconds()};
}

void progress_add(progress *p, double work)
{
    p->done += work;
    const double part = fmin(1.0, p->done / p->total), spent = seconds() - p->start;
    const int terminal = isatty(STDERR_FILENO), tenths = (int)(10.0 * part);
    if (!terminal && tenths == p->shown) return;
    p->shown = tenths;
    fprintf(stderr, "%s%s %3.0f %%, %.0f s left   %s", terminal ? "\r" : "", p->what, 100.0 * part,
            spent / part - spent, terminal ? "" : "\n");
}

void progress_end(void)
{
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r%*s\r", 60, "");
}
