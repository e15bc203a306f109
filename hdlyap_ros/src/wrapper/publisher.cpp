/** Publishes topics: each message is serialised once and handed to roscpp's queues. */
#include "hdlyap_ros/publisher.h"

#include <chrono>
#include <stdexcept>

#include <ros/topic_manager.h>

#include "guard.hpp"
#include "message_fields.hpp"
#include "node.hpp"
#include "standard_messages.hpp"

namespace hdlyap_ros
{
/** A message that is serialised already. */
struct serialised {
    const ros::SerializedMessage &bytes;
};
} // namespace hdlyap_ros

namespace ros
{
namespace message_traits
{
template <> struct MD5Sum<hdlyap_ros::serialised> {
    static const char *value(const hdlyap_ros::serialised &) { return "*"; }
};
template <> struct DataType<hdlyap_ros::serialised> {
    static const char *value(const hdlyap_ros::serialised &) { return "*"; }
};
} // namespace message_traits

namespace serialization
{
template <> SerializedMessage serializeMessage(const hdlyap_ros::serialised &message)
{
    return message.bytes;
}
} // namespace serialization
} // namespace ros

namespace
{
template <class Message>
hdr_status advertise(hdr_publisher **out, hdr_node *node, const char *topic, int queue, bool latch)
{
    using type = typename hdlyap_ros::message_of<Message>::type;
    *out = nullptr;
    return hdr_guard([&] {
        const auto on_connect = [node](const ros::SingleSubscriberPublisher &one) {
            const std::string name = one.getSubscriberName();
            hdr_guard([&] { node->readers.add(name); }); /* without memory nobody asks it */
        };
        std::unique_ptr<hdr_publisher> made(new hdr_publisher);
        made->topic = ros::names::resolve(topic);
        made->datatype = ros::message_traits::datatype<type>();
        made->queue = queue;
        made->node = node;
        const uint32_t length = queue_length(made->topic, queue);
        made->backlog = std::make_shared<hdr_backlog>(length, latch);
        made->publisher = master_registered([&] {
            return node->handle.advertise<type>(
                made->topic, length, queue > 1 ? on_connect : ros::SubscriberStatusCallback(), {},
                {}, latch);
        });
        if (!made->publisher) throw_of_another_type(made->topic, made->datatype);
        node->publishers.push_back(std::move(made));
        *out = node->publishers.back().get();
    });
}

/** Refuses a message of another type than the topic's: roscpp would send it without a check. */
template <class Message> void type_check(const hdr_publisher &publisher)
{
    const char *datatype = ros::message_traits::datatype<hdlyap_ros::sent<Message>>();
    if (publisher.datatype != datatype)
        throw std::invalid_argument(publisher.topic + " carries " + publisher.datatype + ", not " +
                                    datatype);
}

double seconds_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/** Publishes without ros::Publisher, which does not hand out the bytes that it has serialised; with
 * it for latched topics, because only ros::Publisher can keep their last message. */
template <class Message> void send(hdr_publisher &publisher, const Message &message)
{
    const hdlyap_ros::sent<Message> out = {message};
    if (publisher.watched) publisher.node->readers.wait(publisher);
    publisher.backlog->count();
    const auto serialise = [&out] { return ros::serialization::serializeMessage(out); };
    ros::SerializedMessage bytes;
    if (publisher.publisher.isLatched()) {
        bytes = serialise();
        publisher.publisher.publish(hdlyap_ros::serialised{bytes});
    } else {
        ros::TopicManager::instance()->publish(publisher.topic, serialise, bytes);
    }
    publisher.backlog->add(bytes.buf, seconds_now());
}

template <class Message> hdr_status publish(hdr_publisher *publisher, const Message *message)
{
    return hdr_guard([&] {
        type_check<Message>(*publisher);
        send(*publisher, *message);
    });
}

template <class Message> hdr_status publish_finite(hdr_publisher *publisher, const Message *message)
{
    if (hdlyap_ros::is_finite(*message)) return publish(publisher, message);
    hdr_error_keep("a number of the message is not finite");
    return HDR_NOT_FINITE;
}
} // namespace

hdr_status hdr_markers_advertise(hdr_publisher **out, hdr_node *node, const char *topic)
{
    return advertise<hdr_markers>(out, node, topic, 1, true);
}

/* One function each, so that C checks the type of the message. */
#define HDR_PUBLISH_BY(function, type)                                                             \
    hdr_status type##_publish(hdr_publisher *publisher, const type *message)                       \
    {                                                                                              \
        return function(publisher, message);                                                       \
    }
#define HDR_ADVERTISE(type)                                                                        \
    hdr_status type##_advertise(hdr_publisher **out, hdr_node *node, const char *topic, int queue) \
    {                                                                                              \
        return advertise<type>(out, node, topic, queue, false);                                    \
    }                                                                                              \
    hdr_status type##_advertise_latched(hdr_publisher **out, hdr_node *node, const char *topic,    \
                                        int queue)                                                 \
    {                                                                                              \
        return advertise<type>(out, node, topic, queue, true);                                     \
    }
#define HDR_PUBLISHER(type) HDR_ADVERTISE(type) HDR_PUBLISH_BY(publish_finite, type)
#define HDR_STANDARD(type) HDR_ADVERTISE(type) HDR_PUBLISH_BY(publish, type)
HDR_MESSAGES(HDR_PUBLISHER)
HDR_STANDARD_MESSAGES(HDR_STANDARD)
HDR_PUBLISH_BY(publish, hdr_markers)
#undef HDR_STANDARD
#undef HDR_PUBLISHER
#undef HDR_PUBLISH_BY
#undef HDR_ADVERTISE

int hdr_publisher_subscribers(const hdr_publisher *publisher)
{
    int subscribers = 0;
    const hdr_status status = hdr_guard(
        [&] { subscribers = static_cast<int>(publisher->publisher.getNumSubscribers()); });
    return status == HDR_OK ? subscribers : 0;
}

hdr_status hdr_publisher_watch(hdr_publisher *publisher)
{
    return hdr_guard([publisher] {
        publisher->node->readers.watch(*publisher);
        publisher->watched = true;
    });
}

hdr_status hdr_publisher_wait(hdr_publisher *publisher)
{
    publisher->patient = true;
    return hdr_publisher_watch(publisher);
}

double hdr_publisher_waited(const hdr_publisher *publisher) { return publisher->waited; }

hdr_lag hdr_publisher_lag(hdr_publisher *publisher)
{
    const hdr_backlog::numbers now = publisher->backlog->look(seconds_now());
    hdr_lag lag = {publisher->topic.c_str(), now.seconds, now.waiting, 0};
    /* a queue of one is meant to lose what is old */
    if (publisher->queue > 1) lag.lost = now.lost + publisher->node->readers.lost(publisher->topic);
    return lag;
}
