/** The frame of a run from one orthonormalisation to the next. */
#ifndef HD_FACTORISE_H
#define HD_FACTORISE_H

#include "run/run_state.h"

/** What modes are needed for. */
enum {
    HD_OBSERVE_OF_MODES = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES |
                          HD_OBSERVE_FIELDS | HD_OBSERVE_HYDRO | HD_OBSERVE_T_PHASES |
                          HD_OBSERVE_STRUCTURE
};

/** What needs all vectors at every report. */
enum { HD_OBSERVE_AT_REPORTS = HD_OBSERVE_HYDRO | HD_OBSERVE_STRUCTURE };

/** True while modes are looked at. */
bool hd_run_is_observing(const hd_run *run);
/** True while the widths of vectors are looked at. */
bool hd_run_is_localizing(const hd_run *run);
/** True while covariant vectors are wanted of what is carried. */
bool hd_run_is_windowing(const hd_run *run);

/** Carries the frame from t_begin to t_end of the log. Fails as hd_frame_replay. */
HD_MUST_CHECK hd_status hd_run_replay(hd_run *run, double t_begin, double t_end);

/** The norm in which the frame is orthonormalised; measured: somebody wants the vectors. */
hd_norm hd_run_norm(const hd_run *run, bool measured);

/** Carries the frame through the whole log and orthonormalises it: now, in the norm of hd_run_norm.
 * HD_ILL_CONDITIONED if no piece is short enough. */
HD_MUST_CHECK hd_status hd_run_factorise(hd_run *run, bool measured);

/** Tells the interval how much of the accuracy the averaging has not used up: at its start, and
 * after each orthonormalisation. */
void hd_run_save_accuracy(hd_run *run);

#endif
