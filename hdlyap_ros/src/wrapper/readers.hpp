/** Who reads what is published: roscpp's subscribers say how much they have read -> whether a
 * message more may be lost. */
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "backlog.hpp"

struct hdr_publisher;

/** Each is asked by a thread of its own, which may hang as long as the subscriber does, and so is
 * never waited for: what it works on belongs to it too. */
class hdr_readers
{
  public:
    hdr_readers();

    /** Messages of this topic are waited for. */
    void watch(const hdr_publisher &publisher);
    /** A node of this name has connected to a topic. */
    void add(const std::string &name);
    /** Waits while a message more may be lost; not once a stop is requested. */
    void wait(hdr_publisher &publisher);
    /** True if those who can say so have read all that was published; asks them. */
    bool have_read_all();
    /** Lost by their own queues. */
    int64_t lost(const std::string &topic);
    /** In the log: what was lost, and what nobody has read yet. */
    void say_lost();
    /** Nobody is asked any more, before roscpp ends. */
    void end();

    struct reader;
    struct common;

  private:
    std::shared_ptr<common> all;
};
