/** What the messages of one time are made of, and the memory that they are made in. */
#ifndef HDLYAP_MOMENT_H
#define HDLYAP_MOMENT_H

#include "common/nodes.h"
#include "hdlyap/run.h"
#include "node/changes.h"
#include "node/settings.h"
#include "topics/extent.h"
#include "topics/progress.h"
#include "topics/publishers.h"

enum { BUFFERS = 8 }; /**< of one message, at most */

/** Memory that grows with what a message needs, and is used by the next one. */
typedef struct buffers {
    void *block[BUFFERS];
    size_t size[BUFFERS];
    int taken;
    double *q, *p; /**< [coordinates N] each, in one block at q; NULL until somebody asks */
    double *angle; /**< [2 N] of what turns: angles, then angular velocities; otherwise NULL */
    bool known;    /**< they are those of now */
} buffers;

/** What covariant has said last. Windows of before, from a checkpoint, are not published again. */
typedef struct covariant_said {
    bool known; /**< since the first look */
    long windows, lost;
    bool warned; /**< of a transient that is too short */
} covariant_said;

/** When slow_vectors were published last. */
typedef struct slow_vectors_pace {
    bool due, sent;    /**< for the step under way; once at least */
    double next, last; /**< wall times of messages */
} slow_vectors_pace;

/** What topics know from one message to the next. */
typedef struct kept_of_topics {
    covariant_said covariant;
    slow_vectors_pace slow_vectors;
} kept_of_topics;

typedef struct moment {
    const publishers *out;
    const settings *set;
    const hd_run *run;      /**< as of the last step; status and cost do not look at it */
    const progress *last;   /**< for these */
    const changes *changes; /**< for run_info */
    double seconds;         /**< spent in publishing */
    buffers *room;
    kept_of_topics *kept;
    topic topic; /**< that is to be published */
} moment;

/** Room for so many elements, until the next message; NULL, with a line in the log, if there is
 * none. */
void *moment_take(const moment *now, size_t count, size_t size);

/** Positions and momenta of all disks, [coordinates N] each, x0 y0 x1 y1 ..; false without memory,
 * with a line in the log. */
bool moment_state(const moment *now, const double **q, const double **p);

void buffers_clear(buffers *room);

/** float64[] of every stride-th element. */
static inline hdr_doubles message_array(const double *data, size_t count, size_t stride)
{
    return (hdr_doubles){.data = data, .count = (uint32_t)count, .stride = (uint32_t)stride};
}

/** Directions of the space. */
static inline int moment_dimension(const moment *now) { return hd_scene_dimension(&now->set->def); }

/** Of one particle. */
static inline int moment_coordinates(const moment *now)
{
    return hd_scene_coordinates(&now->set->def);
}

/** Its last coordinate is an angle, then. */
static inline bool moment_turns(const moment *now) { return hd_scene_inertia(&now->set->def) > 0; }

/** Component d of arrays [count][coordinates]: positions, say. Of a direction that the space has
 * not it is empty. */
static inline hdr_doubles moment_component(const moment *now, const double *data, size_t count,
                                           int d)
{
    if (d >= moment_dimension(now)) return (hdr_doubles){.data = NULL};
    return message_array(data + d, count, (size_t)moment_coordinates(now));
}

/** Angles, or number 1: angular velocities; empty of what does not turn. moment_state before. */
static inline hdr_doubles moment_angle(const moment *now, size_t disks, size_t number)
{
    const double *angle = now->room->angle;
    return angle ? message_array(angle + number * disks, disks, 1) : (hdr_doubles){.data = NULL};
}

/** The fields of a message that has positions and momenta of all disks. */
#define STATE_FIELDS(now, q, p, disks)                                                             \
    .x = moment_component(now, q, disks, 0), .y = moment_component(now, q, disks, 1),              \
    .z = moment_component(now, q, disks, 2), .px = moment_component(now, p, disks, 0),             \
    .py = moment_component(now, p, disks, 1), .pz = moment_component(now, p, disks, 2),            \
    .angle = moment_angle(now, disks, 0), .spin = moment_angle(now, disks, 1)

/** Sends a topic's messages by topic_send_name, if there is something to say. HD_NOT_FINITE. */
#define TOPIC(name, ...) HD_MUST_CHECK hd_status topic_publish_##name(const moment *now);
#include "topics/rows.inc"
#undef TOPIC

#endif
