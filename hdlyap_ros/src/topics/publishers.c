/** Publishes the node's topics. */
#include "topics/publishers.h"

#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { QUEUE_MIN = 8, QUEUE_MAX = 1000 };
/** Memory for the queue of each subscriber that is behind. */
static const double queue_bytes = 128e6;

typedef hdr_status (*advertise_function)(hdr_publisher **, hdr_node *, const char *, int);

static const advertise_function advertise[TOPICS] = {
#define TOPIC(name, type, stages, is)                                                              \
    [TOPIC_##name] = (is)&TOPIC_LATCHED ? hdr_##type##_advertise_latched : hdr_##type##_advertise,
#include "topics/rows.inc"
#undef TOPIC
};

/** The id is made of start time, process and seed: no two runs share all three. */
static void run_id_write(char *run_id, size_t size, const char *seed)
{
    struct timespec now;
    struct tm utc;
    char date[32];
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(date, sizeof date, "%Y%m%dT%H%M%S", &utc);
    snprintf(run_id, size, "%s.%06ldZ-%ld-%s", date, now.tv_nsec / 1000, (long)getpid(), seed);
}

/** How many messages of this many bytes a queue may keep. */
static int queue_length(double bytes)
{
    return (int)fmax(QUEUE_MIN, fmin(QUEUE_MAX, queue_bytes / bytes));
}

static hdr_status advertise_one(publishers *out, hdr_node *ros, topic t, double bytes, bool waits)
{
    char name[32];
    const bool aside = topic_is(t, TOPIC_FOR_VIEWERS);
    snprintf(name, sizeof name, "~%s", topic_name(t));
    const hdr_status status = advertise[t](&out->publisher[t], ros, name,
                                           aside ? 1 : queue_length(bytes));
    if (status != HDR_OK || aside) return status;
    return waits ? hdr_publisher_wait(out->publisher[t]) : hdr_publisher_watch(out->publisher[t]);
}

hdr_status publishers_advertise(publishers *out, hdr_node *ros, unsigned set,
                                const double bytes[TOPICS], bool waits, const char *seed)
{
    hdr_status status = HDR_OK;
    *out = (publishers){.node = hdr_node_name(ros)};
    run_id_write(out->run_id, sizeof out->run_id, seed);
    for (topic t = 0; t < TOPICS && status == HDR_OK; t++)
        if (set & topic_bit(t)) status = advertise_one(out, ros, t, bytes[t], waits);
    return status;
}

unsigned publishers_subscribed(const publishers *out)
{
    unsigned set = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (out->publisher[t] && hdr_publisher_subscribers(out->publisher[t]) > 0)
            set |= topic_bit(t);
    return set;
}

double publishers_waited(const publishers *out)
{
    double seconds = 0.0;
    for (topic t = 0; t < TOPICS; t++)
        if (out->publisher[t]) seconds += hdr_publisher_waited(out->publisher[t]);
    return seconds;
}

static bool is_worse(hdr_lag a, hdr_lag b)
{
    return a.lost != b.lost ? a.lost > b.lost : a.seconds > b.seconds;
}

hdr_lag publishers_lag(const publishers *out)
{
    hdr_lag worst = {.topic = ""};
    for (topic t = 0; t < TOPICS; t++) {
        if (!out->publisher[t] || topic_is(t, TOPIC_FOR_VIEWERS)) continue;
        const hdr_lag lag = hdr_publisher_lag(out->publisher[t]);
        if (is_worse(lag, worst)) worst = lag;
    }
    return worst;
}

static hd_status sent(hdr_status status, topic t)
{
    if (status == HDR_NOT_FINITE) return HD_NOT_FINITE;
    if (status != HDR_OK) hdr_log(HDR_ERROR, "%s not sent: %s", topic_name(t), hdr_error_text());
    return HD_OK;
}

#define TOPIC(name, type, stages, is)                                                              \
    hd_status topic_send_##name(const publishers *to, hdr_##type *message)                         \
    {                                                                                              \
        message->header = (hdr_header){.stamp = to->stamp, .frame_id = "box"};                     \
        message->run_id = to->run_id;                                                              \
        return sent(hdr_##type##_publish(to->publisher[TOPIC_##name], message), TOPIC_##name);     \
    }
#include "topics/rows.inc"
