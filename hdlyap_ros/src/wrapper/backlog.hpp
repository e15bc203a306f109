/** The messages of one topic that its subscribers have not been handed yet: how many wait, since
 * when, and how many were lost. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>

#include <boost/shared_array.hpp>

/** Every queue and socket on a message's way holds a reference to it. If this list is the only
 * owner, the message has been handed to the kernel or was dropped. Subscribers are handed messages
 * in order: so a message that nobody waits for was dropped if somebody waits for one before it.
 * Times are in seconds of any clock. Any thread may call. */
class hdr_backlog
{
  public:
    using buffer = boost::shared_array<uint8_t>;

    /** queue: messages that are kept for each subscriber. of_latched: roscpp owns the newest
     * message too, for subscribers that come later. */
    explicit hdr_backlog(size_t queue, bool of_latched = false) : length(queue), latched(of_latched)
    {
    }

    /** Counts a message that will be published. */
    void count();
    /** Adds a message that has been published; it is empty if nobody listens. */
    void add(const buffer &message, double now);

    struct numbers {
        int64_t published; /**< so far */
        int64_t lost;      /**< at least so many were dropped for one subscriber or more */
        int waiting;       /**< the oldest message that waits and all after it */
        double seconds;    /**< how long the oldest has waited */
    };
    numbers look(double now = 0.0);

  private:
    struct entry {
        buffer message;
        double since;
    };
    bool waits(const entry &one) const;
    void forget();

    const size_t length;
    const bool latched;
    std::mutex lock;
    std::deque<entry> kept; /**< the oldest that waits and all after it; always the newest */
    int64_t published = 0, lost = 0;
};
