/** Topics in: roscpp's queues -> C callbacks. */
#include "hdlyap_ros/subscriber.h"

#include <algorithm>

#include "guard.hpp"
#include "node.hpp"
#include "received.hpp"
#include "unheard.hpp"

namespace
{
template <class View> using callback_of = void (*)(void *context, const View *view);

/** Of a message with several views the callback may free its subscriber at the first. */
template <class View>
boost::function<void(const boost::shared_ptr<const hdlyap_ros::received<View>> &)>
caller(const hdr_subscriber &subscriber, callback_of<View> callback, void *context)
{
    return [wanted = subscriber.wanted, callback,
            context](const boost::shared_ptr<const hdlyap_ros::received<View>> &message) {
        for (const View &view : message->views)
            if (wanted->load()) callback(context, &view);
    };
}

/** Unlike roscpp's its faults name the topic. */
template <class View>
void connect(hdr_subscriber &subscriber, int queue, callback_of<View> callback, void *context)
{
    try {
        subscriber.subscriber = subscriber.node->handle.subscribe<hdlyap_ros::received<View>>(
            subscriber.topic, queue_length(subscriber.topic, queue),
            caller(subscriber, callback, context));
    } catch (const ros::ConflictingSubscriptionException &) {
    }
    if (!subscriber.subscriber) throw_of_another_type(subscriber.topic, subscriber.datatype);
}

template <class View> hdr_status subscribe(hdr_subscriber **out, hdr_node *node, const char *topic,
                                           int queue, callback_of<View> callback, void *context)
{
    *out = nullptr;
    return hdr_guard([&] {
        std::unique_ptr<hdr_subscriber> made(new hdr_subscriber);
        made->node = node;
        made->topic = ros::names::resolve(topic);
        made->datatype = ros::message_traits::datatype<hdlyap_ros::received<View>>();
        connect(*made, queue, callback, context);
        unheard_look_out(node);
        const std::lock_guard<std::mutex> lock(node->mutex);
        node->subscribers.push_back(std::move(made));
        *out = node->subscribers.back().get();
    });
}

/** NULL if the node is ending, and has it no longer. */
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

/* One function per message, so that C checks the type of the callback. */
#define HDR_SUBSCRIBE(view)                                                                        \
    hdr_status view##_subscribe(hdr_subscriber **out, hdr_node *node, const char *topic,           \
                                int queue, view##_callback callback, void *context)                \
    {                                                                                              \
        return subscribe<view>(out, node, topic, queue, callback, context);                        \
    }
HDR_SUBSCRIBE(hdr_run_info)
HDR_SUBSCRIBE(hdr_spectrum)
HDR_SUBSCRIBE(hdr_modes)
HDR_SUBSCRIBE(hdr_steps)
HDR_SUBSCRIBE(hdr_lp_phases)
HDR_SUBSCRIBE(hdr_mode_field)
HDR_SUBSCRIBE(hdr_hydro)
HDR_SUBSCRIBE(hdr_covariant)
HDR_SUBSCRIBE(hdr_state)
HDR_SUBSCRIBE(hdr_slow_vectors)
HDR_SUBSCRIBE(hdr_cost)
HDR_SUBSCRIBE(hdr_diagnostic)
HDR_SUBSCRIBE(hdr_float64)
HDR_SUBSCRIBE(hdr_string)
#undef HDR_SUBSCRIBE

/** roscpp waits for a callback that another thread is in; the node's lock must not be held then,
 * since the callback may want it. */
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
