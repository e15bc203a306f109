/** Warns of subscribers that are connected to nobody although their topic is published. roscpp does
 * not say why that is so. */
#include "node.hpp"

#include <algorithm>
#include <map>

namespace
{
const double period_seconds = 0.5;
/** After this many looks a publisher of the right type should be connected. */
const int patience = 6;

bool is_unconnected(const hdr_subscriber &subscriber)
{
    return subscriber.subscriber.getNumPublishers() == 0;
}

bool any_is_unconnected(hdr_node *node)
{
    const std::lock_guard<std::mutex> lock(node->mutex);
    return std::any_of(node->subscribers.begin(), node->subscribers.end(),
                       [](const auto &subscriber) { return is_unconnected(*subscriber); });
}

/** The type of every published topic; empty if there is no master. */
std::map<std::string, std::string> published()
{
    std::map<std::string, std::string> types;
    XmlRpc::XmlRpcValue request, response, topics;
    request[0] = ros::this_node::getName();
    request[1] = "";
    if (!ros::master::execute("getPublishedTopics", request, response, topics, false)) return types;
    for (int k = 0; k < topics.size(); k++) types[topics[k][0]] = std::string(topics[k][1]);
    return types;
}

void judge(hdr_subscriber *subscriber, const std::map<std::string, std::string> &types)
{
    const auto found = types.find(subscriber->topic);
    const bool unconnected = found != types.end() && is_unconnected(*subscriber);
    const bool other = unconnected && found->second != subscriber->datatype;
    subscriber->looks = unconnected ? subscriber->looks + 1 : 0;
    if (subscriber->looks == 1 && other)
        hdr_log(HDR_ERROR, "%s is published as %s and not connected: it must be %s",
                subscriber->topic.c_str(), found->second.c_str(), subscriber->datatype.c_str());
    if (subscriber->looks == patience && !other)
        hdr_log(
            HDR_WARN,
            "%s is published, but not connected: its node is gone, or has another version of the "
            "message %s",
            subscriber->topic.c_str(), subscriber->datatype.c_str());
}

void look(hdr_node *node)
{
    if (!any_is_unconnected(node)) return;
    const auto types = published();
    const std::lock_guard<std::mutex> lock(node->mutex);
    for (const auto &subscriber : node->subscribers) judge(subscriber.get(), types);
}
} // namespace

void connection_warnings_start(hdr_node *node)
{
    const std::lock_guard<std::mutex> lock(node->mutex);
    if (!node->lookout)
        node->lookout = node->handle.createWallTimer(
            ros::WallDuration(period_seconds), [node](const ros::WallTimerEvent &) { look(node); });
}
