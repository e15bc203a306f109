/** Subscriber links of roscpp -> what waits in their queues. No function of roscpp tells it, so the
 * members that hold it are named here; with another roscpp this does not compile rather than count
 * wrongly. */
#include "outbox.hpp"

#include <cstdio>

#include <linux/tcp.h> /* that of glibc may lack tcpi_bytes_acked */
#include <netinet/in.h>
#include <sys/socket.h>

#include <ros/publication.h>
#include <ros/topic_manager.h>
#include <ros/transport_subscriber_link.h>

namespace
{
/** An explicit instantiation may name private members; what `is` finds is one of them. */
template <class Tag, typename Tag::type member> struct opened {
    friend typename Tag::type is(Tag) { return member; }
};

struct links {
    using type = std::vector<ros::SubscriberLinkPtr> ros::Publication::*;
    friend type is(links);
};
struct links_mutex {
    using type = boost::mutex ros::Publication::*;
    friend type is(links_mutex);
};
struct outbox {
    using type = std::queue<ros::SerializedMessage> ros::TransportSubscriberLink::*;
    friend type is(outbox);
};
struct outbox_mutex {
    using type = boost::mutex ros::TransportSubscriberLink::*;
    friend type is(outbox_mutex);
};
template struct opened<links, &ros::Publication::subscriber_links_>;
template struct opened<links_mutex, &ros::Publication::subscriber_links_mutex_>;
template struct opened<outbox, &ros::TransportSubscriberLink::outbox_>;
template struct opened<outbox_mutex, &ros::TransportSubscriberLink::outbox_mutex_>;

/** Bytes that the other end of a connection has acknowledged; the socket's number stands at the end
 * of roscpp's description of it. */
uint64_t delivered(ros::TransportSubscriberLink &link)
{
    tcp_info info = {};
    socklen_t size = sizeof info;
    const std::string said = link.getTransportInfo();
    const auto at = said.rfind("on socket ");
    int number = -1;
    if (at == std::string::npos || std::sscanf(said.c_str() + at, "on socket %d", &number) != 1 ||
        getsockopt(number, IPPROTO_TCP, TCP_INFO, &info, &size) != 0)
        return 0;
    return info.tcpi_bytes_acked;
}

hdr_outbox outbox_of(ros::TransportSubscriberLink &link)
{
    const boost::mutex::scoped_lock guard(link.*is(outbox_mutex()));
    return {link.getConnectionID(), link.getDestinationCallerID(),
            static_cast<int64_t>(link.getStats().messages_sent_),
            static_cast<int64_t>((link.*is(outbox())).size()), delivered(link)};
}
} // namespace

std::vector<hdr_outbox> hdr_outboxes(const std::string &topic)
{
    std::vector<hdr_outbox> all;
    const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
    if (!publication) return all;
    const boost::mutex::scoped_lock guard((*publication).*is(links_mutex()));
    for (const ros::SubscriberLinkPtr &each : (*publication).*is(links()))
        if (const auto link = boost::dynamic_pointer_cast<ros::TransportSubscriberLink>(each))
            all.push_back(outbox_of(*link));
    return all;
}
