/** How many nodes have subscribed to a topic, as the master says. roscpp connects to them later,
 * one by one. */
#include "hdlyap_ros/publisher.h"

#include <chrono>
#include <future>
#include <map>
#include <stdexcept>
#include <thread>

#include "guard.hpp"
#include "node.hpp"

namespace
{
using counts = std::map<std::string, int>;
const double answer_poll_seconds = 0.01;

/** The number of subscribed nodes of each topic. Throws if there is no master, or its answer is not
 * understood. */
counts subscribed()
{
    counts nodes;
    XmlRpc::XmlRpcValue request, response, state;
    request[0] = ros::this_node::getName();
    if (!ros::master::execute("getSystemState", request, response, state, false))
        throw std::runtime_error("the ROS master does not answer");
    XmlRpc::XmlRpcValue &topics = state[1]; /* [0] publishers, [2] services */
    for (int k = 0; k < topics.size(); k++) nodes[topics[k][0]] = topics[k][1].size();
    return nodes;
}

/** Asks from a separate thread, because roscpp waits forever for a master that hangs. */
counts subscribed_within(double seconds)
{
    using clock = std::chrono::steady_clock;
    std::packaged_task<counts()> task(subscribed);
    std::future<counts> nodes = task.get_future();
    const auto end = clock::now() + std::chrono::duration<double>(seconds);
    std::thread(std::move(task)).detach();
    while (nodes.wait_for(std::chrono::duration<double>(answer_poll_seconds)) !=
           std::future_status::ready)
        if (clock::now() >= end || hdr_stop_requested())
            throw std::runtime_error("the ROS master does not answer in time");
    return nodes.get();
}
} // namespace

hdr_status hdr_publishers_registered(int registered[], hdr_publisher *const publishers[], int count,
                                     double seconds)
{
    return hdr_guard([&] {
        const counts nodes = subscribed_within(seconds);
        for (int k = 0; k < count; k++) {
            const auto found = publishers[k] ? nodes.find(publishers[k]->topic) : nodes.end();
            registered[k] = found == nodes.end() ? 0 : found->second;
        }
    });
}
