/** What the subscribers of one topic have not been handed yet: messages in -> how far they are
 * behind, and what they have lost. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>

#include <boost/shared_array.hpp>

/** Every queue and socket on a message's way holds a reference to it, so being its only owner means
 * that it has been handed to the kernel, or dropped. Subscribers are handed messages in their
 * order: one that nobody waits for any more, behind one that somebody does, was dropped. Times in
 * seconds of any clock. Any thread. */
class hdr_backlog
{
  public:
    using buffer = boost::shared_array<uint8_t>;

    /** queue: messages that are kept for each subscriber. For a latched topic: its newest message
     * has one more owner, for those who come late. */
    explicit hdr_backlog(size_t queue, bool of_latched = false) : length(queue), latched(of_latched)
    {
    }

    /** A message will be published. */
    void count();
    /** It has been; empty: nobody listens. */
    void add(const buffer &message, double now);

    struct numbers {
        int64_t published; /**< so far */
        int64_t lost;      /**< of them, at least: dropped for one subscriber or more */
        int waiting;       /**< from the oldest that waits on */
        double seconds;    /**< that this one has waited */
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
    std::deque<entry> kept; /**< from the oldest that waits on, and always the newest */
    int64_t published = 0, lost = 0;
};
