/** Windows of covariant vectors in a run: what they do beside other observables. They follow each
 * interval of the averaging, and stop the run to go back through a window. */
#ifndef HD_WINDOWS_H
#define HD_WINDOWS_H

#include "hdlyap/covariant.h"
#include "observe/observable.h"

typedef struct hd_windows hd_windows;

/** A leg: what follows each interval of the averaging, through which the frame is carried. */
typedef struct hd_interval_event {
    enum {
        HD_INTERVAL_BEGINS, /**< the interval begins, with this frame */
        HD_INTERVAL_PIECE,  /**< a piece of it has been carried and orthonormalised */
        /** the interval has ended */
        HD_INTERVAL_ENDS,
        HD_INTERVAL_LOST /**< the frame is changed in another way, so that the next piece does not
                       follow from it */
    } at;
    const hd_frame *frame;
    const hd_ortho *ortho;
    const hd_record *record;
    const hd_trajectory *trajectory;
    double from, to; /**< the piece, counted from the start of the record [time units] */
    double expected; /**< expected length of the next intervals [time units] */
} hd_interval_event;

/** Return HD_OK, or HD_REFUSED with a line that says why the covariant vectors of a scene, if it
 * asks for them, cannot be computed: on so many ranks; with intervals between orthonormalisations
 * that may become this long, because their windows find no room. */
HD_MUST_CHECK hd_status hd_windows_check_ranks(const hd_scene_def *scene, int ranks, char *message,
                                               size_t size);
HD_MUST_CHECK hd_status hd_windows_check_memory(const hd_scene_def *scene, double longest,
                                                char *message, size_t size);

/** What hd_run_parts gives. */
hd_covariant *hd_windows_covariant(hd_windows *windows);

/* In the following windows may be NULL: nobody listens to covariant vectors. */

/** Called for each leg. Fails with HD_NO_MEMORY, on all ranks alike. */
HD_MUST_CHECK hd_status hd_windows_follow(hd_windows *windows, const hd_interval_event *leg);
/** True if a window begins with the next interval. If half of the vectors are carried, the frame is
 * then made isotropic to rounding before [T18]. */
bool hd_windows_begin(const hd_windows *windows);
/** The first time after `now` at which an interval has to end for them; INFINITY: none. */
double hd_windows_due(const hd_windows *windows, double now);
/** True while they have to go back before the run may go on; hd_windows_go_back does so for a
 * fraction of a second, or to_its_end. All ranks agree. */
bool hd_windows_are_behind(const hd_windows *windows);
HD_MUST_CHECK hd_status hd_windows_go_back(hd_windows *windows, bool to_its_end);

#endif
