/** What a run has said last, kept beyond the callbacks in which it was heard: enough to draw it. */
#ifndef HDLYAP_HEARD_H
#define HDLYAP_HEARD_H

#include <stdbool.h>

#include "hdlyap_ros/markers.h"
#include "hdlyap_ros/messages.h"

enum { HEARD_VECTORS_MAX = 64, HEARD_PAIRS_MAX = 8, HEARD_CORNERS_MAX = 512 };

/** Coefficients of the pairs of an LP mode, as in LpPhase. */
typedef struct heard_lp {
    uint32_t pairs;
    double a[HEARD_PAIRS_MAX], b[HEARD_PAIRS_MAX];
} heard_lp;

/** One Lyapunov vector, of slow_vectors or of fields. */
typedef struct heard_vector {
    uint8_t kind; /**< of its step, as in Mode, and where that lies */
    uint32_t nx, ny, nz, index;
    double exponent;
    heard_lp lp;  /**< as far as known with the vector */
    bool known;   /**< the vector itself, at its place and time: */
    hdr_point *d; /**< [N] its dq half */
    double *turn; /**< [N] of what turns: the part of it that turns each to the left */
} heard_vector;

typedef struct heard {
    bool begun; /**< run_info is known: box, names and what follows */
    char run_id[96], scene[64];
    char particles[32];
    uint32_t disks;
    char own[160];  /**< of what else moves its own parameters; "" without any */
    double bond;    /**< of a dumbbell's two disks; 0 of one disk [sigma] */
    double inertia; /**< of what turns; 0 of what does not [sigma^2] */
    double box[3];  /**< 0 along z of disks, spheres otherwise */
    bool periodic[3];
    char container[16];
    uint32_t corners; /**< of the outline of a curved container, which the box holds; 0 of a box */
    hdr_point outline[HEARD_CORNERS_MAX];
    bool has_t, has_lp; /**< modes of these kinds: can be in the box, and are looked for */
    uint8_t stage;      /**< UINT8_MAX before the first status */
    double progress;
    double status_time; /**< of the last status; -1 before the first */
    double time;        /**< of the disks; -1 before the first */
    hdr_point *q;       /**< [N] where they are; z is 0 of disks */
    double *angle;      /**< [N] of what turns, from the x axis, behind q as the next */
    double *spin;       /**< [N] of what turns [rad/time unit] */
    heard_vector vector[HEARD_VECTORS_MAX];
    int vectors;
    double vector_time; /**< of the vectors */
    hdr_point *at;      /**< [N] where the disks were then, behind q */
    hdr_steps steps;    /**< of an own array, as the next */
    hdr_lp_phases phases;
    bool changed; /**< since the caller took that back: a picture would show something else */
} heard;

void heard_clear(heard *h); /**< frees; {0} before the first use */

static inline bool heard_has_spheres(const heard *h) { return h->box[2] > 0.0; }
static inline bool heard_turns(const heard *h) { return h->inertia > 0.0; }

/* Each copies what is needed; what is of another run, or no memory is left for, is passed over. */

/** True if a run begins, or begins again. */
bool heard_run_info(heard *h, const hdr_run_info *info);
void heard_slow_vectors(heard *h, const hdr_slow_vectors *slow);
/** The disks move; vectors stay those of their time. */
void heard_state(heard *h, const hdr_state *state);
/** A vector of its time; the disks are there too, unless they are further already. */
void heard_mode_field(heard *h, const hdr_mode_field *field);
void heard_steps(heard *h, const hdr_steps *steps);
void heard_lp_phases(heard *h, const hdr_lp_phases *phases);
void heard_run_status(heard *h, const hdr_run_status *status);

/** Of a vector at a time, as phases have it; without pairs if they do not. */
heard_lp heard_lp_at(const heard *h, double time, const heard_vector *v);

#endif
