/** The events of one interval. */
#ifndef INTERVAL_H
#define INTERVAL_H

#include "dynamics/trajectory.h"

/** Moves the disks to t_end; the log (or NULL) has the events on the way, and no others. */
HD_MUST_CHECK static inline hd_status trajectory_to(hd_trajectory *trajectory, hd_record *log,
                                                    double t_end)
{
    if (log) hd_record_clear(log);
    return hd_trajectory_extend(trajectory, log, t_end);
}

#endif
