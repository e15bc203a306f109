/** Which vector stands for a step. */
#ifndef HDLYAP_EXAMPLE_H
#define HDLYAP_EXAMPLE_H

#include "hdlyap/steps.h"

/** Column that stands for a resolved step: the first of its set that belongs to the step itself,
 * else the first one. */
static inline int example_of(const hd_steps *steps, int s)
{
    const hd_step *step = hd_steps_step(steps, s);
    for (int col = step->col; col < step->col + step->count; col++)
        if (hd_steps_of_vector(steps, col) == s) return col;
    return step->col;
}

#endif
