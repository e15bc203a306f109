/** Readers are the nodes that subscribe to topics for which the publisher waits. They say how much
 * they have read, which shows whether they would lose a further message. */
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "backlog.hpp"

struct hdr_publisher;

/** Each reader is asked by a separate thread. It may hang as long as the reader's node does, so
 * nobody waits for its end, and it shares ownership of its data. */
class hdr_readers
{
  public:
    hdr_readers();

    /** From now on readers of this topic count. */
    void watch(const hdr_publisher &publisher);
    /** Adds a node that has connected to a topic. */
    void add(const std::string &name);
    /** Has those asked who may be behind; if the publisher is patient, waits while a further
     * message may be lost, but for nobody who reads nothing, and not once a stop is requested. */
    void wait(hdr_publisher &publisher);
    /** To be called once all messages are in sockets. Whether all readers have answered since
     * then and have read all that was published, as far as they say so. Asks those that have not:
     * one that stands still would drop what its socket holds when it hears that the node leaves. */
    bool have_read_all();
    /** How many messages of a topic its readers have dropped from their queues. */
    int64_t lost(const std::string &topic);
    /** Logs which messages were lost, and which ones a reader has not read. */
    void say_lost();
    /** Ends all questions. Has to be called before roscpp ends. */
    void end();

    struct awaited;
    struct reader;
    struct queue;
    struct common;

  private:
    std::shared_ptr<common> all;
};
