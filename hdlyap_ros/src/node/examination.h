/** The disks as they are now -> whether anything but rounding is seen in them. */
#ifndef HDLYAP_EXAMINATION_H
#define HDLYAP_EXAMINATION_H

#include <stdbool.h>

#include "hdlyap/trajectory.h"

typedef struct examination {
    bool made;
    double overlap;          /**< deepest of any two disks [sigma] */
    double overlap_max;      /**< that rounding explains */
    double energy_error;     /**< of the kinetic energy, relative */
    double energy_error_max; /**< that rounding explains */
} examination;

/** Of a trajectory that has begun with kinetic energy N. Cost O(N). */
examination examine(const hd_trajectory *trajectory);

static inline bool examination_overlap(const examination *e)
{
    return e->made && !(e->overlap <= e->overlap_max);
}

static inline bool examination_drift(const examination *e)
{
    return e->made && !(e->energy_error <= e->energy_error_max);
}

#endif
