/** The queue that roscpp keeps for each subscriber of a topic: how full it is, and whether its
 * subscriber reads. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct hdr_outbox {
    int connection;     /**< roscpp's number of it */
    std::string name;   /**< of the subscriber's node */
    int64_t given;      /**< messages that have been put into the queue */
    int64_t waiting;    /**< those that are in it now */
    uint64_t delivered; /**< bytes that the subscriber's machine has taken; 0 if the system does not
                           say */
};

/** The queues of all subscribers of a topic in other processes. Any thread may call. */
std::vector<hdr_outbox> hdr_outboxes(const std::string &topic);
