#include "memory_rate.h"

#include <string.h>

#include "timing.h"

double memory_rate(void)
{
    const size_t bytes = (size_t)1 << 27;
    char *from = room(bytes, 1), *to = room(bytes, 1);
    double best = 0.0;
    for (int k = 0; k < 5; k++) {
        from[k] = (char)(k + 1); /* no copy is like the one before */
        const double start = seconds();
        memcpy(to, from, bytes);
        const double rate = 2.0 * (double)bytes / (seconds() - start);
        if (to[k] == from[k] && rate > best) best = rate;
    }
    free(from);
    free(to);
    return best;
}
