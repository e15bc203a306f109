/** What the subscribers of one topic have not been handed yet: messages in -> how far they are
 * behind. */
#pragma once

#include <cstdint>
#include <mutex>

#include <boost/shared_array.hpp>

#include "hdlyap_ros/publisher.h"

/** Every queue and socket on a message's way holds a reference to it, so being its only owner means
 * that it has been handed to the kernel, or dropped. The last message tells whether anything waits;
 * one more, followed until it is gone, how long it had to. Times in seconds of any clock. Any
 * thread. */
class hdr_backlog
{
  public:
    using buffer = boost::shared_array<uint8_t>;

    /** For a latched topic: its newest message has one more owner, for those who come late. */
    explicit hdr_backlog(bool of_latched = false) : latched(of_latched) {}

    void add(const buffer &message, double now);
    /** True if nothing waits. */
    bool empty() const;
    /** The longer of the followed message's wait and that of the one before it; with neither topic
     * nor losing. */
    hdr_lag lag(double now);

  private:
    bool waits(const buffer &message) const;
    void look(double now);

    const bool latched;
    mutable std::mutex lock;
    buffer newest, followed;
    uint64_t count = 0;     /**< messages so far */
    uint64_t first = 0;     /**< count before the followed one */
    double since = 0;       /**< when that came */
    hdr_lag wait{}, past{}; /**< of the followed one, as seen last; of the one before it */
};
