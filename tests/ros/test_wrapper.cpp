/** The C API in a node that hears itself: what comes, what is dropped, what may still come, what is
 * refused. */
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <std_srvs/Trigger.h>

#include "hdlyap_ros/hdlyap_ros.h"
#include "wrapper/node.hpp"
#include "message_fields.hpp"
#include "wrapper/received.hpp"

namespace
{
hdr_node *node;
const double patience = 60.0;

bool wait_until(const std::function<bool()> &condition)
{
    for (double left = patience; left > 0.0 && !condition(); left -= 1e-3) hdr_node_wait(1e-3);
    return condition();
}

/** What a callback saw, in its order. */
struct seen {
    std::vector<double> numbers;
    std::atomic<size_t> count{0};
    std::atomic<bool> inside{false}, held{false}, gone{false};
    std::atomic<int> after{0}; /**< calls when it was gone */
    hdr_subscriber *itself = nullptr;
};

void on_number(void *context, const hdr_float64 *message)
{
    auto *s = static_cast<seen *>(context);
    s->after += s->gone;
    s->inside = true;
    s->numbers.push_back(message->data);
    s->count++;
    while (s->held) std::this_thread::yield();
    s->inside = false;
}

hdr_publisher *advertise(const char *topic, int queue = 1000)
{
    hdr_publisher *publisher;
    EXPECT_EQ(HDR_OK, hdr_float64_advertise(&publisher, node, topic, queue)) << hdr_error_text();
    return publisher;
}

void publish(hdr_publisher *publisher, double number)
{
    const hdr_float64 message = {number};
    EXPECT_EQ(HDR_OK, hdr_float64_publish(publisher, &message)) << hdr_error_text();
}

hdr_subscriber *subscribe(const char *topic, seen *s, int queue = 1000)
{
    hdr_subscriber *subscriber;
    EXPECT_EQ(HDR_OK, hdr_float64_subscribe(&subscriber, node, topic, queue, on_number, s))
        << hdr_error_text();
    return subscriber;
}

/** Publishes 0, 1, 2 .. until it is told to end. */
struct flood {
    explicit flood(const char *topic) : publisher(advertise(topic)) {}
    ~flood()
    {
        end = true;
        thread.join();
    }
    hdr_publisher *publisher;
    std::atomic<bool> end{false};
    std::thread thread{[this] {
        for (double k = 0.0; !end; k++, hdr_node_wait(1e-5)) publish(publisher, k);
    }};
};
} // namespace

/* ---- a message goes out and comes in through the functions of its type --------------------- */

template <class Message> struct functions;
#define FUNCTIONS(type)                                                                            \
    template <> struct functions<type> {                                                           \
        static constexpr auto publish = type##_publish;                                            \
        static constexpr auto subscribe = type##_subscribe;                                        \
        static constexpr auto advertise = type##_advertise;                                        \
        static constexpr auto advertise_latched = type##_advertise_latched;                        \
    };
HDR_MESSAGES(FUNCTIONS)
HDR_STANDARD_MESSAGES(FUNCTIONS)

static void prepare(diagnostic_msgs::DiagnosticArray &message) { message.status.resize(1); }
static void prepare(std_msgs::String &message) { message.data = "a few words"; }
template <class Message> void prepare(Message &) {}

/** Next to nothing in it, but no string NULL. */
template <class Message> hdlyap_ros::received<Message> blank()
{
    typename hdlyap_ros::message_of<Message>::type message;
    hdlyap_ros::received<Message> in;
    prepare(message);
    ros::serialization::deserializeMessage(ros::serialization::serializeMessage(message), in);
    return in;
}

/** But for header.seq, which roscpp counts. */
template <class Message> std::string bytes_of(const Message &message)
{
    const hdlyap_ros::sent<Message> out = {message};
    const ros::SerializedMessage bytes = ros::serialization::serializeMessage(out);
    return std::string(reinterpret_cast<const char *>(bytes.message_start) + 4,
                       bytes.num_bytes - 8);
}

struct arrival {
    std::string bytes;
    std::atomic<bool> came{false};
};

template <class Message> void on_message(void *context, const Message *message)
{
    auto *a = static_cast<arrival *>(context);
    a->bytes = bytes_of(*message);
    a->came = true;
}

template <class Message> struct message : testing::Test {
    hdlyap_ros::received<Message> out = blank<Message>();
    std::string topic = std::string("~") + ros::message_traits::datatype(out);
    hdr_publisher *publisher = nullptr;
    hdr_subscriber *subscriber = nullptr;
    arrival got;

    void SetUp() override { std::replace(topic.begin(), topic.end(), '/', '_'); }

    void subscribe()
    {
        ASSERT_EQ(HDR_OK, functions<Message>::subscribe(&subscriber, node, topic.c_str(), 1,
                                                        on_message<Message>, &got));
    }

    void publish()
    {
        ASSERT_EQ(HDR_OK, functions<Message>::publish(publisher, &out.messages.at(0)))
            << hdr_error_text();
    }

    void expect_it_came()
    {
        EXPECT_TRUE(wait_until([this] { return got.came.load(); }));
        hdr_subscriber_free(subscriber);
        EXPECT_EQ(bytes_of(out.messages[0]), got.bytes);
        EXPECT_EQ(0, hdr_publisher_subscribers(publisher));
    }
};
#define AND(type) , type
using messages = testing::Types<hdr_float64, hdr_string, hdr_diagnostic HDR_MESSAGES(AND)>;
TYPED_TEST_SUITE(message, messages, );

TYPED_TEST(message, comes_back)
{
    ASSERT_EQ(HDR_OK,
              functions<TypeParam>::advertise(&this->publisher, node, this->topic.c_str(), 10));
    this->subscribe();
    EXPECT_EQ(1, hdr_subscriber_publishers(this->subscriber));
    EXPECT_EQ(1, hdr_publisher_subscribers(this->publisher));
    this->publish();
    this->expect_it_came();
}

TYPED_TEST(message, waits_where_it_is_latched)
{
    this->topic += "_latched";
    ASSERT_EQ(HDR_OK, functions<TypeParam>::advertise_latched(&this->publisher, node,
                                                              this->topic.c_str(), 10));
    this->publish();
    this->subscribe();
    this->expect_it_came();
}

/* ---- queues -------------------------------------------------------------------------------- */

TEST(queue, drops_the_oldest)
{
    seen slow;
    std::atomic<int> arrived{0};
    ros::CallbackQueue apart; /* sees that a message is there while the wrapper's callbacks wait */
    ros::NodeHandle handle;
    handle.setCallbackQueue(&apart);
    hdr_publisher *publisher = advertise("~dropped");
    hdr_subscriber *subscriber = subscribe("~dropped", &slow, 3);
    const ros::Subscriber counter = handle.subscribe<std_msgs::Float64>(
        ros::names::resolve("~dropped"), 100,
        [&](const std_msgs::Float64ConstPtr &) { arrived++; });
    slow.held = true;
    publish(publisher, 0);
    EXPECT_TRUE(wait_until([&] { return slow.inside.load(); }));
    for (int k = 1; k < 10; k++) publish(publisher, k);
    EXPECT_TRUE(wait_until([&] { return apart.callAvailable(), arrived == 10; }));
    slow.held = false;
    EXPECT_TRUE(wait_until([&] { return slow.count == 4; }));
    hdr_subscriber_free(subscriber);
    EXPECT_EQ((std::vector<double>{0, 7, 8, 9}), slow.numbers);
}

TEST(queue, long_enough_loses_nothing)
{
    seen all;
    hdr_publisher *publisher = advertise("~whole");
    hdr_subscriber *subscriber = subscribe("~whole", &all);
    for (int k = 0; k < 1000; k++) publish(publisher, k);
    EXPECT_TRUE(wait_until([&] { return all.count == 1000; }));
    hdr_subscriber_free(subscriber);
    for (size_t k = 0; k < 1000; k++) EXPECT_EQ(static_cast<double>(k), all.numbers.at(k));
}

/* ---- who has subscribed -------------------------------------------------------------------- */

/** A subscriber or publisher that the master alone knows. */
static void at_master(const char *call, const std::string &topic, const char *type = nullptr)
{
    XmlRpc::XmlRpcValue request, response, payload;
    request[0] = "/elsewhere";
    request[1] = topic;
    if (type) request[2] = type;
    request[request.size()] = "http://localhost:1/";
    EXPECT_TRUE(ros::master::execute(call, request, response, payload, false));
}

TEST(publishers, registered)
{
    seen s;
    hdr_publisher *const publishers[] = {advertise("~lonely"), nullptr, advertise("~crowded")};
    hdr_subscriber *subscriber = subscribe("~crowded", &s);
    const std::string topic = std::string(hdr_node_name(node)) + "/crowded";
    const auto registered = [&publishers] {
        std::vector<int> counts{-1, -1, -1};
        EXPECT_EQ(HDR_OK, hdr_publishers_registered(counts.data(), publishers, 3, patience))
            << hdr_error_text();
        return counts;
    };
    EXPECT_EQ((std::vector<int>{0, 0, 1}), registered());
    at_master("registerSubscriber", topic, "std_msgs/Float64");
    EXPECT_EQ((std::vector<int>{0, 0, 2}), registered());
    EXPECT_EQ(1, hdr_publisher_subscribers(publishers[2]));
    hdr_subscriber_free(subscriber);
    EXPECT_EQ((std::vector<int>{0, 0, 1}), registered());
    at_master("unregisterSubscriber", topic);
    EXPECT_EQ((std::vector<int>{0, 0, 0}), registered());
}

/* ---- nothing comes any more ---------------------------------------------------------------- */

TEST(freeing, again_and_again_under_load)
{
    const flood source("~flood");
    for (int k = 0; k < 20; k++) {
        seen s;
        hdr_subscriber *subscriber = subscribe("~flood", &s, 10);
        EXPECT_TRUE(wait_until([&] { return s.count >= 3; }));
        hdr_subscriber_free(subscriber);
        s.gone = true;
        EXPECT_FALSE(s.inside);
        const size_t count = s.count;
        std::this_thread::yield();
        EXPECT_EQ(count, s.count);
        EXPECT_EQ(0, s.after);
    }
}

TEST(freeing, waits_for_the_callback_that_runs)
{
    seen s;
    std::atomic<bool> begun{false}, freed{false};
    hdr_publisher *publisher = advertise("~waits");
    hdr_subscriber *subscriber = subscribe("~waits", &s);
    s.held = true;
    publish(publisher, 0);
    publish(publisher, 1);
    EXPECT_TRUE(wait_until([&] { return s.inside.load(); }));
    std::thread other([&] {
        begun = true;
        hdr_subscriber_free(subscriber);
        s.gone = true;
        freed = true;
    });
    EXPECT_TRUE(wait_until([&] { return begun.load(); }));
    hdr_node_wait(0.05);
    EXPECT_FALSE(freed);
    s.held = false;
    other.join();
    EXPECT_FALSE(s.inside);
    EXPECT_EQ(0, s.after);
    EXPECT_EQ(1u, s.count);
}

static void on_status(void *context, const hdr_diagnostic *)
{
    auto *s = static_cast<seen *>(context);
    hdr_subscriber_free(s->itself);
    s->count++;
}

/** At the first status of an array. */
TEST(freeing, by_the_callback_itself)
{
    seen s;
    ros::NodeHandle handle;
    diagnostic_msgs::DiagnosticArray three;
    three.status.resize(3);
    const std::string topic = ros::names::resolve("~statuses");
    ros::Publisher publisher = handle.advertise<diagnostic_msgs::DiagnosticArray>(topic, 10);
    ASSERT_EQ(HDR_OK, hdr_diagnostic_subscribe(&s.itself, node, "~statuses", 10, on_status, &s));
    publisher.publish(three);
    publisher.publish(three);
    EXPECT_TRUE(wait_until([&] { return s.count > 0 && publisher.getNumSubscribers() == 0; }));
    EXPECT_EQ(1u, s.count);
    hdr_subscriber_free(nullptr);
}

/* ---- what is refused ----------------------------------------------------------------------- */

static void on_string(void *, const hdr_string *) {}

static std::string of_another_type(const char *topic)
{
    return std::string(hdr_node_name(node)) + "/" + topic +
           " cannot be std_msgs/String: this node publishes or hears it as another type";
}

TEST(refused, another_type_of_this_node)
{
    hdr_subscriber *subscriber = nullptr;
    hdr_publisher *publisher = nullptr;
    seen s;
    advertise("~numbers");
    EXPECT_EQ(HDR_FAULT,
              hdr_string_subscribe(&subscriber, node, "~numbers", 1, on_string, nullptr));
    EXPECT_EQ(nullptr, subscriber);
    EXPECT_EQ(of_another_type("numbers"), hdr_error_text());
    EXPECT_EQ(HDR_FAULT, hdr_string_advertise(&publisher, node, "~numbers", 1));
    EXPECT_EQ(of_another_type("numbers"), hdr_error_text());
    EXPECT_EQ(nullptr, publisher);
    hdr_subscriber *first = subscribe("~heard", &s);
    EXPECT_EQ(HDR_FAULT, hdr_string_subscribe(&subscriber, node, "~heard", 1, on_string, nullptr));
    EXPECT_EQ(of_another_type("heard"), hdr_error_text());
    hdr_subscriber_free(first);
}

TEST(refused, queues_and_names)
{
    hdr_subscriber *subscriber = nullptr;
    hdr_publisher *publisher = nullptr;
    const std::string topic = std::string(hdr_node_name(node)) + "/x";
    EXPECT_EQ(HDR_FAULT, hdr_float64_subscribe(&subscriber, node, "~x", 0, on_number, nullptr));
    EXPECT_EQ("queue of " + topic + " = 0: must be at least 1", std::string(hdr_error_text()));
    EXPECT_EQ(HDR_FAULT, hdr_float64_advertise(&publisher, node, "~x", -1));
    EXPECT_EQ("queue of " + topic + " = -1: must be at least 1", std::string(hdr_error_text()));
    EXPECT_EQ(HDR_FAULT,
              hdr_float64_subscribe(&subscriber, node, "no name", 1, on_number, nullptr));
    EXPECT_NE(nullptr, strstr(hdr_error_text(), "no name"));
    EXPECT_EQ(nullptr, subscriber);
    EXPECT_EQ(nullptr, publisher);
}

/* ---- what the log says --------------------------------------------------------------------- */

/** Its lines from now on. */
struct log_lines {
    ros::CallbackQueue apart;
    ros::NodeHandle handle;
    ros::Subscriber subscriber;
    std::vector<std::string> lines;
    log_lines()
    {
        handle.setCallbackQueue(&apart);
        subscriber = handle.subscribe<rosgraph_msgs::Log>(
            "/rosout", 1000,
            [this](const rosgraph_msgs::LogConstPtr &line) { lines.push_back(line->msg); });
    }
    long count(const std::string &line)
    {
        apart.callAvailable();
        return std::count(lines.begin(), lines.end(), line);
    }
};

TEST(log, steers_no_terminal)
{
    log_lines log;
    hdr_log(HDR_WARN, "a\033b\177c\302\233d");
    EXPECT_TRUE(wait_until([&] { return log.count("a?b?c??d") == 1; }));
}

/** Comes, goes and comes: each time it is said. */
TEST(log, topics_of_another_type)
{
    log_lines log;
    seen s;
    hdr_subscriber *subscriber = subscribe("~strange", &s);
    const std::string topic = std::string(hdr_node_name(node)) + "/strange",
                      line = topic +
                             " is published as std_msgs/String and not connected: it must be "
                             "std_msgs/Float64";
    for (int tries = 0; tries < 20 && log.count(line) < 2; tries++) {
        at_master("registerPublisher", topic, "std_msgs/String");
        hdr_node_wait(0.7); /* it looks each half a second */
        at_master("unregisterPublisher", topic);
        hdr_node_wait(0.7);
    }
    EXPECT_GE(log.count(line), 2);
    hdr_subscriber_free(subscriber);
}

TEST(node, waits)
{
    const ros::WallTime began = ros::WallTime::now();
    EXPECT_TRUE(hdr_node_wait(0.05));
    EXPECT_TRUE(hdr_node_wait(-1.0));
    EXPECT_TRUE(hdr_node_wait(0.0 / 0.0));
    EXPECT_GE((ros::WallTime::now() - began).toSec(), 0.045); /* the clock of the wall may be set */
}

/** The last one but one: who waits for a stop is woken, and goes on being. */
TEST(node, stops)
{
    std::thread other([] {
        hdr_node_wait(0.05);
        hdr_stop_request();
    });
    EXPECT_FALSE(hdr_node_wait(INFINITY));
    EXPECT_FALSE(hdr_node_wait(INFINITY));
    other.join();
}

/** A service that frees a subscriber while the node ends, if it is there still. */
static bool on_service(void *context, char *, size_t)
{
    auto *s = static_cast<seen *>(context);
    const std::weak_ptr<std::atomic<bool>> part = s->itself->wanted;
    s->inside = true;
    ros::WallDuration(0.2).sleep(); /* until hdr_node_free has unsubscribed */
    s->gone = part.expired();
    if (!s->gone) hdr_subscriber_free(s->itself);
    return true;
}

/** The end: subscribers stay until no callback runs. */
TEST(node, subscribers_outlive_callbacks)
{
    seen s;
    s.itself = subscribe("~left", &s);
    EXPECT_EQ(HDR_OK, hdr_service_trigger(node, "~frees", on_service, &s)) << hdr_error_text();
    std::thread caller([] {
        std_srvs::Trigger call;
        ros::service::call(ros::names::resolve("~frees"), call);
    });
    while (!s.inside) std::this_thread::yield();
    hdr_node_free(node, 0.0);
    node = nullptr;
    caller.join();
    EXPECT_FALSE(s.gone);
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    if (hdr_node_create(&node, &argc, argv, "test_wrapper", 60.0, 3) != HDR_OK || !node) return 1;
    const int failed = RUN_ALL_TESTS();
    hdr_node_free(node, 0.0);
    return failed;
}
