#include "backlog.hpp"

#include <algorithm>

/** Owners here: newest, followed, or both; and roscpp, of the newest one. Lock held. */
bool hdr_backlog::waits(const buffer &message) const
{
    const long here = (message == newest) * (1 + latched) + (message == followed);
    return message && message.use_count() > here;
}

/** What is gone has waited until it was last seen waiting, at least. Lock held. */
void hdr_backlog::look(double now)
{
    if (!followed) return;
    if (waits(followed)) {
        wait.seconds = now - since;
        wait.messages = static_cast<int>(count - first);
        return;
    }
    past = wait;
    followed.reset();
}

void hdr_backlog::add(const buffer &message, double now)
{
    const std::lock_guard<std::mutex> guard(lock);
    count++;
    look(now);
    newest = message;
    if (followed) return;
    followed = message;
    first = count - 1;
    since = now;
    wait = {};
}

bool hdr_backlog::empty() const
{
    const std::lock_guard<std::mutex> guard(lock);
    return !waits(newest);
}

hdr_lag hdr_backlog::lag(double now)
{
    const std::lock_guard<std::mutex> guard(lock);
    look(now);
    hdr_lag longer = {};
    if (!waits(newest)) return longer;
    longer.seconds = std::max(wait.seconds, past.seconds);
    longer.messages = std::max(wait.messages, past.messages);
    return longer;
}
