/** One subscriber of each topic is not enough: of those that come at the same time, one is
 * connected first, and a recorder would miss what is published before it is. */
#include "topics/subscriber_wait.h"

#include <math.h>

#include "node/clock.h"

/** How long those who have subscribed are waited for, once each topic has its first one [s]. */
static const double patience_seconds = 3.0;
/** Between two questions to the master [s]: who subscribes to several topics has done so meanwhile.
 */
static const double ask_seconds = 0.1;
/** Between two lines that say who is waited for [s]. */
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

/** Each topic has a subscriber. Complete twice in succession: who has subscribed to one topic may
 * be about to subscribe to the next. */
static bool all_connected(subscriber_wait *a, const publishers *out, unsigned awaited)
{
    int registered[TOPICS];
    const double left = fmax(a->until - clock_seconds(), ask_seconds);
    if (hdr_publishers_registered(registered, out->publisher, TOPICS, left) != HDR_OK) {
        if (hdr_stop_requested()) return false; /* that is why: it does not start */
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

/** Each by its full name: who listens to another node is seen at once. */
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
