#include "backlog.hpp"

#include <algorithm>

/** Whether a subscriber still waits for this message: whether it has owners besides the list and,
 * for the newest message of a latched topic, roscpp. The caller holds the lock. */
bool hdr_backlog::waits(const entry &one) const
{
    const long here = 1 + (latched && &one == &kept.back());
    return one.message.use_count() > here;
}

/** Removes messages for which nobody waits, and counts the dropped ones as lost. The caller holds
 * the lock. */
void hdr_backlog::forget()
{
    while (kept.size() > 1 && !waits(kept.front())) kept.pop_front();
    if (kept.size() <= length) return;
    const auto dropped = [this](const entry &one) { return !waits(one); };
    const auto end = std::remove_if(kept.begin(), kept.end() - 1, dropped);
    lost += kept.end() - 1 - end;
    kept.erase(end, kept.end() - 1);
}

void hdr_backlog::count()
{
    const std::lock_guard<std::mutex> guard(lock);
    published++;
}

void hdr_backlog::add(const buffer &message, double now)
{
    const std::lock_guard<std::mutex> guard(lock);
    if (!message) return;
    kept.push_back({message, now});
    forget();
}

hdr_backlog::numbers hdr_backlog::look(double now)
{
    const std::lock_guard<std::mutex> guard(lock);
    forget();
    if (kept.empty() || !waits(kept.front())) return {published, lost, 0, 0.0};
    return {published, lost, static_cast<int>(kept.size()), now - kept.front().since};
}
