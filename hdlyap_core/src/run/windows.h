/** A run's covariant vectors: what the forward pass leaves to them, and the way back in between. */
#ifndef HD_WINDOWS_H
#define HD_WINDOWS_H

#include "hdlyap/covariant.h"

typedef struct hd_windows {
    hd_covariant *covariant;       /**< NULL unless the scene observes them */
    hd_communicator *communicator; /**< NULL: a single rank. Others do the same on the way back */
    double *gathered;              /**< [4N * n], vectors of all ranks; NULL of a single one */
    double sampling;               /**< from the beginning of a window to its first look */
    bool due;                      /**< one begins with the next interval */
    double seconds;                /**< wall seconds spent here */
} hd_windows;

/** Of the communicator that is set. Intervals will be at most `longest`. HD_REFUSED with a line in
 * message where no interval that can be expected makes the windows fit; HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_windows_create(hd_windows *windows, const hd_scene_def *scene,
                                          hd_ortho *ortho, double longest, int threads,
                                          char *message, size_t size);
void hd_windows_free(hd_windows *windows);

/** The averages begin anew with the next interval. */
void hd_windows_clear(hd_windows *windows);

/* Of an interval of the averaging, while somebody looks. */

/** Before the first orthonormalisation: the frame is still that of its start, the next intervals
 * are expected to be so long. */
HD_MUST_CHECK hd_status hd_windows_start(hd_windows *windows, const hd_frame *frame, double begin,
                                         double expected);
/** An orthonormalisation, and the part of the log before it. */
HD_MUST_CHECK hd_status hd_windows_add(hd_windows *windows, const hd_ortho *ortho,
                                       const hd_frame *frame, const hd_event_log *log,
                                       double t_begin, double t_end);
/** The whole interval is done. */
HD_MUST_CHECK hd_status hd_windows_end(hd_windows *windows, const hd_frame *frame,
                                       const hd_trajectory *trajectory);

/** Simulated time of the next look, `now` where an interval begins: a window may begin with it. */
double hd_windows_due(const hd_windows *windows, double now);

/** True while there is a way back to go. */
bool hd_windows_is_going(const hd_windows *windows);
/** Goes on with it for a fraction of a second, or to its end. */
HD_MUST_CHECK hd_status hd_windows_go(hd_windows *windows, bool to_its_end);

#endif
