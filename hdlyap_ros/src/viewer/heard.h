/** The last messages of a run, kept after their callbacks, as far as a picture needs them. */
#ifndef HDLYAP_HEARD_H
#define HDLYAP_HEARD_H

#include <stdbool.h>

#include "hdlyap_ros/markers.h"
#include "hdlyap_ros/messages.h"

enum {
    HEARD_VECTORS_MAX = 64,
    HEARD_PAIRS_MAX = 8,
    HEARD_CORNERS_MAX = 512,
    HEARD_SITES_MAX = 8,
    HEARD_KINDS_MAX = 8,
    HEARD_NUMBER_MAX = 10000000
};

/** Coefficients of the pairs of an LP mode, as in LpPhase. */
typedef struct heard_lp {
    uint32_t pairs;
    double a[HEARD_PAIRS_MAX], b[HEARD_PAIRS_MAX];
} heard_lp;

/** One Lyapunov vector, of slow_vectors or of fields. */
typedef struct heard_vector {
    uint8_t kind; /**< kind of its step, as in Mode; nx, ny, nz: wave of the step */
    uint32_t nx, ny, nz, index;
    double exponent;
    heard_lp lp;  /**< coefficients at the time of the vector; no pairs if not known */
    bool known;   /**< whether d and turn are known */
    hdr_point *d; /**< [N] displacements by the vector */
    double *turn; /**< [N] part of the vector in the angles of particles that rotate */
} heard_vector;

/** A kind of particles: those before number `end` that are not of a kind before. */
typedef struct heard_kind {
    uint32_t end;
    double diameter, mass;
} heard_kind;

typedef struct heard {
    bool begun; /**< run_info is known: box, names and what follows */
    char run_id[96], scene[64];
    char particles[32];
    uint32_t number;
    char own[160];                /**< parameters that only these particles have, as text */
    double site[HEARD_SITES_MAX]; /**< [sites] of its disks along its arm, ascending [sigma] */
    int sites;                    /**< 0: one, at its centre */
    heard_kind kind[HEARD_KINDS_MAX];
    int kinds;
    double inertia; /**< moment of inertia [sigma^2]; 0 if particles do not rotate */
    double box[3];  /**< edges of the box; 0 along z for particles in the plane */
    bool periodic[3];
    char wall[3][40]; /**< what else the walls of a direction are; "": they reflect */
    char container[16];
    uint32_t corners; /**< corners of the outline of a curved container; 0 for a box */
    hdr_point outline[HEARD_CORNERS_MAX];
    bool has_t, has_lp; /**< the run classifies modes of these kinds, and the box can have them */
    uint8_t stage;      /**< UINT8_MAX before the first status */
    double progress;
    double status_time; /**< simulated time of the last status; -1 before the first */
    double time;        /**< simulated time of q; -1 before the first */
    hdr_point *q;       /**< [N] positions; z is 0 in the plane */
    double *angle;      /**< [N] angle from the x axis, if particles rotate; in the block of q */
    double *spin;       /**< [N] angular velocity [rad/time unit], likewise; in the block of q */
    heard_vector vector[HEARD_VECTORS_MAX];
    int vectors;
    double vector_time; /**< simulated time of the vectors */
    hdr_point *at;      /**< [N] positions at that time; in the block of q */
    hdr_steps steps;    /**< its array is a copy, as is that of phases */
    hdr_lp_phases phases;
    bool changed; /**< a picture would show something new; the caller resets it */
} heard;

void heard_clear(heard *h); /**< frees; {0} before the first use */

static inline bool heard_has_spheres(const heard *h) { return h->box[2] > 0.0; }
static inline bool heard_turns(const heard *h) { return h->inertia > 0.0; }

/* Each function copies what is needed. Messages of another run are ignored, as is what memory does
 * not suffice for. */

/** The value in effect of a parameter of a run; "" if it has none of this name. */
const char *heard_parameter(const hdr_run_info *info, const char *name);

/** Returns true if this is a new run. */
bool heard_run_info(heard *h, const hdr_run_info *info);
void heard_slow_vectors(heard *h, const hdr_slow_vectors *slow);
/** Takes the state of particles. Vectors stay as they were at their time. */
void heard_state(heard *h, const hdr_state *state);
/** Takes a vector, and the state of particles too unless a later one is known. */
void heard_mode_field(heard *h, const hdr_mode_field *field);
void heard_steps(heard *h, const hdr_steps *steps);
void heard_lp_phases(heard *h, const hdr_lp_phases *phases);
void heard_run_status(heard *h, const hdr_run_status *status);

/** The coefficients of a vector at a time, from lp_phases; no pairs if these are not known. */
heard_lp heard_lp_at(const heard *h, double time, const heard_vector *v);

#endif
