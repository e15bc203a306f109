/** A run's covariant vectors: what the forward pass leaves to them, and the way back in between. */
#ifndef HD_WINDOWS_H
#define HD_WINDOWS_H

#include "dynamics/trajectory.h"
#include "hdlyap/covariant.h"
#include "tangent/frame.h"
#include "tangent/ortho.h"

/** The observable of HD_OBSERVED_covariant. */
typedef struct hd_windows hd_windows;

double *hd_windows_seconds(hd_windows *windows); /**< wall seconds spent here */

/* Of an interval of the averaging, while somebody looks. */

/** What the window has is of no use: another one begins with the next interval. Until then nothing
 * is added. */
void hd_windows_lose(hd_windows *windows);
/** True if a window begins with the next interval. */
bool hd_windows_begins(const hd_windows *windows);

/** Before the first orthonormalisation: the frame is still that of its start, the next intervals
 * are expected to be so long. */
HD_MUST_CHECK hd_status hd_windows_start(hd_windows *windows, const hd_frame *frame, double begin,
                                         double expected);
/** An orthonormalisation, and the part of the log before it. */
HD_MUST_CHECK hd_status hd_windows_add(hd_windows *windows, const hd_ortho *ortho,
                                       const hd_frame *frame, const hd_record *record,
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
