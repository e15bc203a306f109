/** Subscribes to topics: roscpp's queues -> C callbacks. */
#include "hdlyap_ros/subscriber.h"

#include <algorithm>

#include "guard.hpp"
#include "message_fields.hpp"
#include "node.hpp"
#include "received.hpp"

namespace
{
template <class Message> using callback_of = void (*)(void *context, const Message *message);

/** The function that roscpp calls with a message. If that has several structs, the callback may
 * free the subscriber at the first one. */
template <class Message>
boost::function<void(const boost::shared_ptr<const hdlyap_ros::received<Message>> &)>
caller(const hdr_subscriber &subscriber, callback_of<Message> callback, void *context)
{
    return [wanted = subscriber.wanted, callback,
            context](const boost::shared_ptr<const hdlyap_ros::received<Message>> &all) {
        for (const Message &message : all->messages)
            if (wanted->load()) callback(context, &message);
    };
}

/** Connects a subscriber to its topic. Throws with a text that names the topic, which roscpp's
 * texts do not. */
template <class Message>
void connect(hdr_subscriber &subscriber, int queue, callback_of<Message> callback, void *context)
{
    try {
        subscriber.subscriber = master_registered([&] {
            return subscriber.node->handle.subscribe<hdlyap_ros::received<Message>>(
                subscriber.topic, queue_length(subscriber.topic, queue),
                caller(subscriber, callback, context));
        });
    } catch (const ros::ConflictingSubscriptionException &) {
    }
    if (!subscriber.subscriber) throw_of_another_type(subscriber.topic, subscriber.datatype);
}

template <class Message> hdr_status subscribe(hdr_subscriber **out, hdr_node *node,
                                              const char *topic, int queue,
                                              callback_of<Message> callback, void *context)
{
    *out = nullptr;
    return hdr_guard([&] {
        std::unique_ptr<hdr_subscriber> made(new hdr_subscriber);
        made->node = node;
        made->topic = ros::names::resolve(topic);
        made->datatype = ros::message_traits::datatype<hdlyap_ros::received<Message>>();
        connect(*made, queue, callback, context);
        connection_warnings_start(node);
        const std::lock_guard<std::mutex> lock(node->mutex);
        node->subscribers.push_back(std::move(made));
        *out = node->subscribers.back().get();
    });
}

/** Takes a subscriber from its node. Returns NULL if the node is ending and has given it up. */
std::unique_ptr<hdr_subscriber> taken_from_its_node(const hdr_subscriber *subscriber)
{
    auto &all = subscriber->node->subscribers;
    const std::lock_guard<std::mutex> lock(subscriber->node->mutex);
    const auto found = std::find_if(
        all.begin(), all.end(), [subscriber](const auto &one) { return one.get() == subscriber; });
    if (found == all.end()) return nullptr;
    std::unique_ptr<hdr_subscriber> taken = std::move(*found);
    all.erase(found);
    return taken;
}
} // namespace

/* One function each, so that C checks the type of the callback. */
#define HDR_SUBSCRIBER(type)                                                                       \
    hdr_status type##_subscribe(hdr_subscriber **out, hdr_node *node, const char *topic,           \
                                int queue, type##_callback callback, void *context)                \
    {                                                                                              \
        return subscribe<type>(out, node, topic, queue, callback, context);                        \
    }
HDR_MESSAGES(HDR_SUBSCRIBER)
HDR_STANDARD_MESSAGES(HDR_SUBSCRIBER)
#undef HDR_SUBSCRIBER

/** roscpp waits while another thread is in the callback. The node's lock must not be held during
 * that, because the callback may want it. */
void hdr_subscriber_free(hdr_subscriber *subscriber)
{
    if (!subscriber) return;
    subscriber->wanted->store(false);
    const hdr_status status = hdr_guard([&] {
        const auto taken = taken_from_its_node(subscriber);
        if (taken) taken->subscriber.shutdown();
    });
    if (status != HDR_OK) hdr_log(HDR_ERROR, "unsubscribing: %s", hdr_error_text());
}

int hdr_subscriber_publishers(const hdr_subscriber *subscriber)
{
    int publishers = 0;
    const hdr_status status = hdr_guard(
        [&] { publishers = static_cast<int>(subscriber->subscriber.getNumPublishers()); });
    return status == HDR_OK ? publishers : 0;
}
