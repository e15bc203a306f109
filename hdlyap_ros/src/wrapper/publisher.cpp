/** Topics out: each C view is serialised once and handed to roscpp's queues. */
#include "hdlyap_ros/publisher.h"

#include <chrono>
#include <stdexcept>

#include <ros/topic_manager.h>

#include "guard.hpp"
#include "node.hpp"
#include "views.hpp"

namespace
{
template <class View>
hdr_status advertise(hdr_publisher **out, hdr_node *node, const char *topic, int queue, bool latch)
{
    using message = typename hdlyap_ros::message_of<View>::type;
    *out = nullptr;
    return hdr_guard([&] {
        std::unique_ptr<hdr_publisher> made(new hdr_publisher);
        made->topic = ros::names::resolve(topic);
        made->datatype = ros::message_traits::datatype<message>();
        made->queue = queue;
        made->publisher = node->handle.advertise<message>(made->topic,
                                                          queue_length(made->topic, queue), latch);
        if (!made->publisher) throw_of_another_type(made->topic, made->datatype);
        node->publishers.push_back(std::move(made));
        *out = node->publishers.back().get();
    });
}

/** roscpp does not compare the types and would send the wrong bytes. */
template <class View> void type_check(const hdr_publisher &publisher)
{
    const char *datatype = ros::message_traits::datatype<View>();
    if (publisher.datatype != datatype)
        throw std::invalid_argument(publisher.topic + " carries " + publisher.datatype + ", not " +
                                    datatype);
}

double seconds_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/** Past ros::Publisher, which keeps what it has serialised to itself, but for latched topics, whose
 * last message only it can keep. */
template <class View> void send(hdr_publisher &publisher, const View &view)
{
    if (publisher.publisher.isLatched()) {
        publisher.publisher.publish(view);
        return;
    }
    ros::SerializedMessage message;
    const auto serialise = [&view] { return ros::serialization::serializeMessage(view); };
    ros::TopicManager::instance()->publish(publisher.topic, serialise, message);
    publisher.backlog.add(message.buf, seconds_now());
}

template <class View> hdr_status publish(hdr_publisher *publisher, const View *view)
{
    return hdr_guard([&] {
        type_check<View>(*publisher);
        send(*publisher, *view);
    });
}
} // namespace

hdr_status hdr_run_info_advertise(hdr_publisher **out, hdr_node *node, const char *topic)
{
    return advertise<hdr_run_info>(out, node, topic, 1, true);
}

hdr_status hdr_slow_vectors_advertise(hdr_publisher **out, hdr_node *node, const char *topic)
{
    return advertise<hdr_slow_vectors>(out, node, topic, 1, true);
}

hdr_status hdr_markers_advertise(hdr_publisher **out, hdr_node *node, const char *topic)
{
    return advertise<hdr_markers>(out, node, topic, 1, true);
}

/* One function per message, so that C checks the type of the view. */
#define HDR_PUBLISH(view)                                                                          \
    hdr_status view##_publish(hdr_publisher *publisher, const view *message)                       \
    {                                                                                              \
        return publish(publisher, message);                                                        \
    }
#define HDR_TOPIC(view)                                                                            \
    hdr_status view##_advertise(hdr_publisher **out, hdr_node *node, const char *topic, int queue) \
    {                                                                                              \
        return advertise<view>(out, node, topic, queue, false);                                    \
    }                                                                                              \
    HDR_PUBLISH(view)
HDR_PUBLISH(hdr_run_info)
HDR_PUBLISH(hdr_markers)
HDR_PUBLISH(hdr_slow_vectors)
HDR_TOPIC(hdr_spectrum)
HDR_TOPIC(hdr_modes)
HDR_TOPIC(hdr_steps)
HDR_TOPIC(hdr_lp_phases)
HDR_TOPIC(hdr_mode_field)
HDR_TOPIC(hdr_hydro)
HDR_TOPIC(hdr_covariant)
HDR_TOPIC(hdr_state)
HDR_TOPIC(hdr_cost)
HDR_TOPIC(hdr_diagnostic)
HDR_TOPIC(hdr_float64)
HDR_TOPIC(hdr_string)
#undef HDR_TOPIC
#undef HDR_PUBLISH

int hdr_publisher_subscribers(const hdr_publisher *publisher)
{
    int subscribers = 0;
    const hdr_status status = hdr_guard(
        [&] { subscribers = static_cast<int>(publisher->publisher.getNumSubscribers()); });
    return status == HDR_OK ? subscribers : 0;
}

hdr_lag hdr_publisher_lag(hdr_publisher *publisher)
{
    hdr_lag lag = publisher->backlog.lag(seconds_now());
    lag.topic = publisher->topic.c_str();
    /* a queue of one is meant to lose what is old */
    lag.losing = publisher->queue > 1 && lag.messages >= publisher->queue;
    return lag;
}
