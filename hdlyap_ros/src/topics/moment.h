/** A moment: what the messages of one time are made from, and the memory for their arrays. */
#ifndef HDLYAP_MOMENT_H
#define HDLYAP_MOMENT_H

#include "common/nodes.h"
#include "hdlyap/run.h"
#include "node/changes.h"
#include "node/settings.h"
#include "topics/extent.h"
#include "topics/progress.h"
#include "topics/publishers.h"

enum { BUFFERS = 12 }; /**< the most that one message takes */

/** Memory that grows to what a message needs; the next message uses it again. */
typedef struct buffers {
    void *block[BUFFERS];
    size_t size[BUFFERS];
    int taken;
    double *q, *p;   /**< [coordinates N] each, in one block at q; NULL until moment_state */
    double *momenta; /**< [coordinates N] m v, with masses; those of p over their roots */
    double *angle;   /**< [2 N] angles, then angular velocities; NULL unless particles rotate */
    bool known;      /**< q, p, momenta and angle are those of now */
} buffers;

/** What the topic covariant has published last. Windows that a checkpoint holds are not published
 * again. */
typedef struct covariant_said {
    bool known; /**< false until the windows were first counted */
    long windows, lost;
    bool warned; /**< true after a warning that the transient is too short */
} covariant_said;

/** When slow_vectors were published last. */
typedef struct slow_vectors_pace {
    bool due, sent;    /**< due: a message follows the step under way; sent: there has been one */
    double next, last; /**< wall times of the next and of the last message */
} slow_vectors_pace;

/** What topics keep from one message to the next. */
typedef struct kept_of_topics {
    covariant_said covariant;
    slow_vectors_pace slow_vectors;
} kept_of_topics;

typedef struct moment {
    const publishers *out;
    const settings *set;
    const hd_run *run;      /**< after its last step; status and cost do not use it */
    const progress *last;   /**< how far the run is; only status and cost use it */
    const changes *changes; /**< only run_info uses it */
    double seconds, waited; /**< wall time spent so far in publishing, and in waiting for
                               subscribers beside that */
    buffers *room;
    kept_of_topics *kept;
    topic topic; /**< the topic that is published */
} moment;

/** Memory for `count` elements, valid until the next message. Returns NULL, and logs it, if there
 * is none. */
void *moment_take(const moment *now, size_t count, size_t size);

/** Positions and momenta of all particles, [coordinates N] each, x0 y0 x1 y1 ..., momenta over the
 * root of the mass. Returns false, and
 * logs it, if there is no memory. */
bool moment_state(const moment *now, const double **q, const double **p);

void buffers_clear(buffers *room);

/** A float64[] that consists of every stride-th element. */
static inline hdr_doubles message_array(const double *data, size_t count, size_t stride)
{
    return (hdr_doubles){.data = data, .count = (uint32_t)count, .stride = (uint32_t)stride};
}

/** The order of the growth of this many vectors over times of one length, for a message. */
static inline hdr_growth_order growth_order(hd_order_over order, size_t vectors)
{
    return (hdr_growth_order){
        .time = order.time,
        .count = (uint64_t)order.count,
        .violations = message_array(order.violations, vectors - 1, 1),
        .domination_violations = message_array(order.domination_violations, vectors - 1, 1),
    };
}

/** The dimension of space. */
static inline int moment_dimension(const moment *now) { return hd_scene_dimension(&now->set->def); }

/** The number of coordinates of a particle. */
static inline int moment_coordinates(const moment *now)
{
    return hd_scene_coordinates(&now->set->def);
}

/** Whether particles rotate: their last coordinate is an angle then. */
static inline bool moment_turns(const moment *now) { return hd_scene_inertia(&now->set->def) > 0; }

/** Whether particles have other coordinates than positions in a box and an angle. */
static inline bool moment_has_others(const moment *now)
{
    const int dimension = moment_dimension(now);
    return dimension == 0 || moment_coordinates(now) > dimension + moment_turns(now);
}

/** Component d of an array [count][coordinates], such as positions; empty if space has no direction
 * d. */
static inline hdr_doubles moment_component(const moment *now, const double *data, size_t count,
                                           int d)
{
    if (d >= moment_dimension(now)) return (hdr_doubles){.data = NULL};
    return message_array(data + d, count, (size_t)moment_coordinates(now));
}

/** Component d of the momenta m v. moment_state has to be called before. */
static inline hdr_doubles moment_momentum(const moment *now, size_t particles, int d)
{
    return moment_component(now, now->room->momenta, particles, d);
}

/** number 0: angles, 1: angular velocities; empty unless particles rotate. moment_state has to be
 * called before. */
static inline hdr_doubles moment_angle(const moment *now, size_t particles, size_t number)
{
    const double *angle = now->room->angle;
    return angle ? message_array(angle + number * particles, particles, 1)
                 : (hdr_doubles){.data = NULL};
}

/** The fields of a message that has positions and momenta of all particles. */
#define STATE_FIELDS(now, q, particles)                                                            \
    .x = moment_component(now, q, particles, 0), .y = moment_component(now, q, particles, 1),      \
    .z = moment_component(now, q, particles, 2), .px = moment_momentum(now, particles, 0),         \
    .py = moment_momentum(now, particles, 1), .pz = moment_momentum(now, particles, 2),            \
    .angle = moment_angle(now, particles, 0), .spin = moment_angle(now, particles, 1)

/** Sends the messages of a topic by topic_send_NAME, if there is something to send. Fails with
 * HD_NOT_FINITE. */
#define TOPIC(name, ...) HD_MUST_CHECK hd_status topic_publish_##name(const moment *now);
#include "topics/rows.inc"
#undef TOPIC

#endif
