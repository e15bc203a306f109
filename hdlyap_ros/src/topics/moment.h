/** What the messages of one time are made of, and the memory that they are made in. */
#ifndef HDLYAP_MOMENT_H
#define HDLYAP_MOMENT_H

#include "hdlyap/run.h"
#include "node/settings.h"
#include "topics/extent.h"
#include "topics/progress.h"
#include "topics/publishers.h"

enum { BUFFERS = 4 }; /**< of one message, at most */

/** Memory that grows with what a message needs, and is used by the next one. */
typedef struct buffers {
    void *block[BUFFERS];
    size_t size[BUFFERS];
    int taken;
    double *q, *p; /**< [2N] each, in one block at q; NULL until somebody asks */
    bool known;    /**< they are those of now */
} buffers;

typedef struct moment {
    const publishers *out;
    const settings *set;
    const hd_run *run;    /**< as of the last step; status and cost do not look at it */
    const progress *last; /**< for these */
    double seconds;       /**< spent in publishing */
    buffers *room;
    topic topic; /**< that is to be published */
} moment;

/** Room for so many elements, until the next message; NULL, with a line in the log, if there is
 * none. */
void *moment_take(const moment *now, size_t count, size_t size);

/** Positions and momenta of all disks, [2N] each, x0 y0 x1 y1 ..; false without memory, with a line
 * in the log. */
bool moment_state(const moment *now, const double **q, const double **p);

void buffers_clear(buffers *room);

/** float64[] of every stride-th element. */
static inline hdr_doubles message_array(const double *data, size_t count, size_t stride)
{
    return (hdr_doubles){.data = data, .count = (uint32_t)count, .stride = (uint32_t)stride};
}

/** What a topic can do, beside its row: topic_name in its file. */
typedef struct topic_maker {
    /** But for texts; NULL: one message in a bag */
    topic_size (*size)(const extent *e);
    /** Sends its messages by topic_send_name, if there is something to say. HD_NOT_FINITE. */
    hd_status (*publish)(const moment *now, void *state);
    size_t state; /**< bytes that it keeps between messages, at first all 0; 0: none */
    void (*begin)(void *state, const moment *now); /**< NULL: all 0 will do */
} topic_maker;

/** Of a topic's messages in a scene. */
topic_size topic_size_of(topic t, const extent *e);

#define TOPIC(name, type, stages, is) extern const topic_maker topic_##name;
#include "topics/rows.inc"
#undef TOPIC

#endif
