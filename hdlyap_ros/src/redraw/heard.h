/** What a run has said last, kept beyond the callbacks in which it was heard: enough to draw it. */
#ifndef HDLYAP_HEARD_H
#define HDLYAP_HEARD_H

#include <stdbool.h>

#include "hdlyap_ros/messages.h"

enum { HEARD_FIELDS_MAX = 64 };

/** The last field of one kind at one wave vector. */
typedef struct heard_field {
    uint8_t kind;
    uint32_t nx, ny, index;
    double exponent, time;
    double *x, *y, *dx, *dy; /**< [N] each, in one block at x */
} heard_field;

typedef struct heard {
    bool begun; /**< run_info is known: box, names and what follows */
    char run_id[96], scene[64];
    uint32_t disks;
    double box[2];
    bool periodic[2];
    bool has_exponents, has_steps, has_fields; /**< sooner or later */
    double time, *x, *y; /**< of state; in one block at x; time is -1 before the first */
    double *exponents, averaged;
    uint32_t vectors; /**< exponents heard */
    hdr_steps steps;  /**< of an own array */
    hdr_lp_phases phases;
    heard_field field[HEARD_FIELDS_MAX];
    int fields;
} heard;

void heard_clear(heard *h); /**< frees; {0} before the first use */

/* Each copies what is needed; what is of another run, or no memory is left for, is passed over. */
void heard_run_info(heard *h, const hdr_run_info *info);
void heard_state(heard *h, const hdr_state *state);
void heard_spectrum(heard *h, const hdr_spectrum *spectrum);
void heard_steps(heard *h, const hdr_steps *steps);
void heard_phases(heard *h, const hdr_lp_phases *phases);
void heard_mode_field(heard *h, const hdr_mode_field *field);

#endif
