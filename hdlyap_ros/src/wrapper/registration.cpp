/** The node's own list of topics -> registrations with the master. roscpp does this only once, when
 * a topic or a service is made. The node asks itself by XML-RPC, because roscpp's lists are
 * private. */
#include "registration.hpp"

#include <ros/connection_manager.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

using XmlRpc::XmlRpcValue;

namespace
{
/** Calls this node's own function of the slave API. */
bool ask_myself(const char *function, const XmlRpcValue &request, XmlRpcValue &answer)
{
    const int port = static_cast<int>(ros::XMLRPCManager::instance()->getServerPort());
    XmlRpc::XmlRpcClient client("127.0.0.1", port, "/");
    XmlRpcValue response;
    const bool answered = client.execute(function, request, response) &&
                          response.getType() == XmlRpcValue::TypeArray && response.size() == 3;
    if (answered) answer = response[2];
    client.close();
    return answered;
}

/** A question of this node, with what it asks about. */
XmlRpcValue question(const XmlRpcValue &about = XmlRpcValue())
{
    XmlRpcValue request;
    request[0] = ros::this_node::getName();
    if (about.valid()) request[1] = about;
    return request;
}

bool register_one(const char *function, XmlRpcValue &request, XmlRpcValue &answer)
{
    XmlRpcValue response;
    request[3] = ros::XMLRPCManager::instance()->getServerURI();
    return ros::master::execute(function, request, response, answer, false);
}

/** Tells the subscriber of a topic the addresses of its publishers. Those that are connected are
 * added to the list: they may register later than this node, and the subscriber drops all that the
 * list lacks. */
bool tell_publishers(XmlRpcValue &topic, XmlRpcValue &publishers)
{
    XmlRpcValue links, ignored, update = question(topic);
    if (!ask_myself("getBusInfo", question(), links)) return false;
    for (int k = 0; k < links.size(); k++)
        if (std::string(links[k][2]) == "i" && links[k][4] == topic)
            publishers[publishers.size()] = links[k][1];
    update[2] = publishers;
    return ask_myself("publisherUpdate", update, ignored);
}

/** Registers a topic, which the node publishes or hears, as its list says: [name, type]. */
bool register_topic(XmlRpcValue &topic, bool hears)
{
    XmlRpcValue request = question(topic[0]), answer;
    request[2] = topic[1];
    if (!register_one(hears ? "registerSubscriber" : "registerPublisher", request, answer))
        return false;
    return !hears || tell_publishers(topic[0], answer);
}

bool register_topics(bool hears, const std::function<bool()> &wanted)
{
    XmlRpcValue topics;
    if (!ask_myself(hears ? "getSubscriptions" : "getPublications", question(), topics))
        return false;
    for (int k = 0; k < topics.size(); k++)
        if (!wanted() || !register_topic(topics[k], hears)) return false;
    return true;
}

bool register_service(const std::string &name)
{
    XmlRpcValue request = question(name), answer;
    request[2] = "rosrpc://" + ros::network::getHost() + ":" +
                 std::to_string(ros::ConnectionManager::instance()->getTCPPort());
    return register_one("registerService", request, answer);
}
} // namespace

std::string first_service() { return ros::names::resolve("~set_logger_level"); }

bool register_again(const std::vector<std::string> &services, const std::function<bool()> &wanted)
{
    if (!register_topics(false, wanted) || !register_topics(true, wanted)) return false;
    /* the first one last, because it tells that all is done */
    for (size_t k = services.size(); k-- > 0;)
        if (!wanted() || !register_service(services[k])) return false;
    return true;
}
