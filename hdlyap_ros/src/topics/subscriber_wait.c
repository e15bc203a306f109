/** Waiting for one subscriber of each topic is not enough: if several come at the same time,
 * another one may be connected first, and a recorder would miss what is published before it is
 * connected. */
#include "topics/subscriber_wait.h"

#include <math.h>

#include "node/clock.h"

/** Once each topic has a subscriber, the run waits this long for others who have subscribed [s]. */
static const double patience_seconds = 3.0;
/** Time between two questions to the master [s]. A node that subscribes to several topics does so
 * in this time. */
static const double ask_seconds = 0.1;
/** Time between two lines that say for which subscribers the run waits [s]. */
static const double say_seconds = 10.0;

static bool is_missed(const publishers *out, topic t, const int registered[TOPICS])
{
    return hdr_publisher_subscribers(out->publisher[t]) < registered[t];
}

static unsigned missed(const publishers *out, unsigned awaited, const int registered[TOPICS])
{
    unsigned set = 0;
    for (topic t = 0; t < TOPICS; t++)
        if ((awaited & topic_bit(t)) && is_missed(out, t, registered)) set |= topic_bit(t);
    return set;
}

static void warn(const publishers *out, unsigned set, const int registered[TOPICS])
{
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t))
            hdr_log(
                HDR_WARN,
                "%s: %d of %d subscribers connected after %g s: the run starts without the others",
                topic_name(t), hdr_publisher_subscribers(out->publisher[t]), registered[t],
                patience_seconds);
}

/** Whether all subscribers are connected, once each topic has one. They have to be so at two
 * questions in succession, because a node may be about to subscribe to its next topic. */
static bool all_connected(subscriber_wait *a, const publishers *out, unsigned awaited)
{
    int registered[TOPICS];
    const double left = fmax(a->until - clock_seconds(), ask_seconds);
    if (hdr_publishers_registered(registered, out->publisher, TOPICS, left) != HDR_OK) {
        if (hdr_stop_requested()) return false; /* the run does not start, so it needs no warning */
        hdr_log(HDR_WARN, "the run starts with the subscribers connected now: %s",
                hdr_error_text());
        return true;
    }
    const unsigned set = missed(out, awaited, registered);
    const bool was_complete = a->complete, late = clock_seconds() >= a->until;
    a->complete = !set;
    if (late) warn(out, set, registered);
    return late || (was_complete && a->complete);
}

/** Says for which topics the run waits, by their full names, which show at once if somebody listens
 * to another node. */
static void say(subscriber_wait *a, const publishers *out, unsigned missing, double now)
{
    char names[256] = "";
    if (now < a->say) return;
    topic_names(names, sizeof names, missing);
    hdr_log(a->say > 0.0 ? HDR_WARN : HDR_INFO, "%swaiting for subscribers of %s: %s",
            a->say > 0.0 ? "still " : "", out->node, names);
    a->say = now + say_seconds;
}

bool subscriber_wait_over(subscriber_wait *a, const publishers *out, unsigned awaited)
{
    const double now = clock_seconds();
    if (!awaited) return true;
    const unsigned missing = awaited & ~publishers_subscribed(out);
    if (missing) {
        *a = (subscriber_wait){.next = a->next, .say = a->say};
        say(a, out, missing, now);
        return false;
    }
    if (!(a->until > 0.0)) a->until = now + patience_seconds;
    if (now < a->next) return false;
    const bool all = all_connected(a, out, awaited);
    a->next = clock_seconds() + ask_seconds;
    return all;
}
