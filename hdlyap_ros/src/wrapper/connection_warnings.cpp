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
const double answer_seconds = 1.0; /**< in which a node has to answer at its address */

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

/** Counts the looks at which a subscriber is not connected. Returns true at the one from which on
 * it should be. */
bool judge(hdr_subscriber *subscriber, const std::map<std::string, std::string> &types)
{
    const auto found = types.find(subscriber->topic);
    const bool unconnected = found != types.end() && is_unconnected(*subscriber);
    const bool other = unconnected && found->second != subscriber->datatype;
    subscriber->looks = unconnected ? subscriber->looks + 1 : 0;
    if (subscriber->looks == 1 && other)
        hdr_log(HDR_ERROR, "%s is published as %s and not connected: it must be %s",
                subscriber->topic.c_str(), found->second.c_str(), subscriber->datatype.c_str());
    return subscriber->looks == patience && !other;
}

/** Whether nodes answer at their addresses, each of which is asked once. */
struct answers {
    bool operator()(const std::string &address)
    {
        const auto known = all.find(address);
        if (known != all.end()) return known->second;
        return all[address] = address_answers(address, answer_seconds);
    }
    std::map<std::string, bool> all;
};

/** The names of the nodes that publish a topic; none if there is no master. */
std::vector<std::string> speakers(const std::string &topic)
{
    std::vector<std::string> names;
    XmlRpc::XmlRpcValue request, response, state;
    request[0] = ros::this_node::getName();
    if (!ros::master::execute("getSystemState", request, response, state, false)) return names;
    for (int k = 0; k < state[0].size(); k++)
        for (int n = 0; n < state[0][k][1].size() && topic == std::string(state[0][k][0]); n++)
            names.push_back(state[0][k][1][n]);
    return names;
}

/** Why a topic that is published is not connected. */
std::string reason(const std::string &topic, const std::string &datatype, answers &answer)
{
    XmlRpc::XmlRpcValue request, response, address;
    request[0] = ros::this_node::getName();
    for (const std::string &name : speakers(topic)) {
        request[1] = name;
        if (ros::master::execute("lookupNode", request, response, address, false) &&
            !answer(address))
            return name + " does not answer at its address " + std::string(address) +
                   ": it is gone, or its " + address_must_be;
    }
    return "its node is gone, or has another version of the message " + datatype;
}

void look(hdr_node *node)
{
    if (!any_is_unconnected(node)) return;
    const auto types = published();
    std::vector<std::pair<std::string, std::string>> late;
    {
        const std::lock_guard<std::mutex> lock(node->mutex);
        for (const auto &subscriber : node->subscribers)
            if (judge(subscriber.get(), types))
                late.emplace_back(subscriber->topic, subscriber->datatype);
    }
    answers answer;
    for (const auto &one : late)
        hdr_log(HDR_WARN, "%s is published, but not connected: %s", one.first.c_str(),
                reason(one.first, one.second, answer).c_str());
}
} // namespace

void connection_warnings_start(hdr_node *node)
{
    const std::lock_guard<std::mutex> lock(node->mutex);
    if (!node->lookout)
        node->lookout = node->handle.createWallTimer(
            ros::WallDuration(period_seconds), [node](const ros::WallTimerEvent &) { look(node); });
}
