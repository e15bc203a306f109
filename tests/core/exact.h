/** The tangent dynamics once more, slowly: long double, and factored after a few events. */
#ifndef HD_EXACT_H
#define HD_EXACT_H

#include "hdlyap/frame.h"

typedef struct exact exact;

/** The same vectors as the frame's; as many as it has rows at most 32. */
exact *exact_create(const hd_frame *frame);
void exact_free(exact *x);

/** Carries them through all of the log. */
void exact_replay(exact *x, const hd_event_log *log);

/** Sum of ln R_ll since the start, column col. */
double exact_log_stretch(const exact *x, int col);

#endif
