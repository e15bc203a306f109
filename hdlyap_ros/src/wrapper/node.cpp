/** Starts and ends roscpp, without its signal handlers and its clock; the node's log. */
#include "node.hpp"

#include <algorithm>
#include <clocale>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <unistd.h>

#include <ros/network.h>
#include <ros/xmlrpc_manager.h>

#include "guard.hpp"
#include "registration.hpp"

namespace
{
const double poll_seconds = 0.01;
/** How long last messages may still be handed over once a stop was requested. */
const double linger_after_stop = 0.25;
/** Subscribers get this time to read: one that is told that a node leaves drops what it has not
 * read from its socket yet. */
const double reading_seconds = 0.1;

/** Waits until there is a master. Returns false if a stop was requested first. */
bool master_wait()
{
    bool said = false;
    while (!ros::master::check() && !hdr_stop_requested()) {
        if (!said) ROS_WARN("no ROS master at %s: waiting for it", ros::master::getURI().c_str());
        said = true;
        ros::WallDuration(10 * poll_seconds).sleep();
    }
    return !hdr_stop_requested();
}

/** Requests a stop. roscpp's handler would leave the graph at once, with messages still queued. */
void on_rosnode_kill(XmlRpc::XmlRpcValue &params, XmlRpc::XmlRpcValue &result)
{
    const bool says_why = params.size() > 1 &&
                          params[1].getType() == XmlRpc::XmlRpcValue::TypeString;
    const std::string why = says_why ? std::string(params[1]) : "";
    hdr_log(HDR_WARN, "asked to shut down: %s", why.c_str());
    hdr_stop_request();
    result = ros::xmlrpc::responseInt(1, "", 0);
}

hdr_node *node_start()
{
    if (!master_wait()) return nullptr;
    ros::master::setRetryTimeout(ros::WallDuration(master_patience));
    ros::start();
    ros::XMLRPCManager::instance()->unbind("shutdown");
    ros::XMLRPCManager::instance()->bind("shutdown", on_rosnode_kill);
    std::unique_ptr<hdr_node> node(new hdr_node);
    node->name = ros::this_node::getName();
    loggers_advertise(node.get());
    node->watch.reset(new hdr_master_watch({first_service(), ros::names::resolve("~get_loggers")}));
    node->address.reset(new hdr_own_address);
    node->spinner.start();
    return node.release();
}

/** Ends all subscriptions, and waits for a callback that is running. The caller has to keep the
 * subscribers until no callback runs any more, because a callback may free them. */
std::vector<std::unique_ptr<hdr_subscriber>> unsubscribe(hdr_node &node)
{
    std::vector<std::unique_ptr<hdr_subscriber>> all;
    {
        const std::lock_guard<std::mutex> lock(node.mutex);
        all.swap(node.subscribers);
    }
    for (const auto &subscriber : all) {
        subscriber->wanted->store(false);
        subscriber->subscriber.shutdown();
    }
    return all;
}

bool drained(hdr_node &node)
{
    return std::all_of(node.publishers.begin(), node.publishers.end(),
                       [](const auto &each) { return each->backlog->look().waiting == 0; }) &&
           node.readers.have_read_all();
}

bool has_subscribers(const hdr_node &node)
{
    return std::any_of(node.publishers.begin(), node.publishers.end(), [](const auto &publisher) {
        return publisher->publisher.getNumSubscribers() > 0;
    });
}

/** Ends the process without destructors: those of a roscpp that has only half started crash. */
void leave(int status, void *)
{
    std::fflush(nullptr);
    _exit(status);
}

/** Replaces control characters: what a parameter holds must neither look like another line nor
 * control a terminal. */
void one_line(char *text)
{
    const auto byte = [](char c) { return static_cast<unsigned char>(c); };
    for (; *text; text++) {
        if (byte(*text) < 0x20 || byte(*text) == 0x7f) *text = '?';
        const bool is_c1 = byte(text[0]) == 0xc2 && byte(text[1]) >= 0x80 && byte(text[1]) < 0xa0;
        if (is_c1) text[0] = text[1] = '?'; /* a control character in UTF-8 */
    }
}

void drain(hdr_node &node, double linger)
{
    double after_stop = linger_after_stop;
    for (; linger > 0 && after_stop > 0 && !drained(node); linger -= poll_seconds) {
        ros::WallDuration(poll_seconds).sleep();
        if (hdr_stop_requested()) after_stop -= poll_seconds;
    }
    if (has_subscribers(node)) ros::WallDuration(reading_seconds).sleep();
}
} // namespace

uint32_t queue_length(const std::string &topic, int queue)
{
    if (queue < 1)
        throw std::invalid_argument("queue of " + topic + " = " + std::to_string(queue) +
                                    ": must be at least 1");
    return static_cast<uint32_t>(queue);
}

void throw_of_another_type(const std::string &topic, const std::string &datatype)
{
    throw std::invalid_argument(topic + " cannot be " + datatype +
                                ": this node publishes or hears it as another type");
}

/** Refuses an address of the master that roscpp cannot parse, because roscpp would crash. */
static void master_address_check(int argc, const char *const *argv)
{
    const std::string option = "__master:=";
    setenv("ROS_MASTER_URI", "http://localhost:11311", 0); // rospy's; not all roscpp have a default
    std::string address = std::getenv("ROS_MASTER_URI"), host;
    for (int k = 1; k < argc; k++) {
        const std::string argument = argv[k];
        if (argument.compare(0, option.size(), option) == 0)
            address = argument.substr(option.size());
    }
    std::uint32_t port = 0;
    if (!ros::network::splitURI(address, host, port))
        throw std::invalid_argument("ROS_MASTER_URI = '" + address + "': must be http://HOST:PORT");
}

/** The arguments NAME:=VALUE, which roscpp takes out of the list. */
static std::vector<std::string> assignments(int argc, const char *const *argv)
{
    std::vector<std::string> all(argv + std::min(1, argc), argv + argc);
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const auto &one) { return one.find(":=") == std::string::npos; }),
              all.end());
    return all;
}

/** Initialises roscpp. If it refuses a name it does not say which argument had it. */
static void init(int &argc, char **argv, const char *name)
{
    try {
        ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
    } catch (const ros::InvalidNameException &error) {
        throw std::invalid_argument(std::string(error.what()) +
                                    " An argument NAME:=VALUE renames a topic; _NAME:=VALUE sets a "
                                    "parameter.");
    }
}

hdr_status hdr_node_create(hdr_node **out, int *argc, char **argv, const char *name,
                           double stop_seconds, int memory_status)
{
    *out = nullptr;
    stop_without_memory(memory_status);
    const hdr_status status = hdr_guard([&] {
        stop_handlers_install(stop_seconds);
        setlocale(LC_CTYPE, ""); /* otherwise log4cxx writes ? for each byte beyond ASCII */
        master_address_check(*argc, argv);
        const auto arguments = assignments(*argc, argv);
        init(*argc, argv, name);
        *out = node_start();
        if (*out) (*out)->arguments = arguments;
    });
    if (status != HDR_OK) on_exit(leave, nullptr);
    return status;
}

void hdr_node_free(hdr_node *node, double linger)
{
    if (!node) return;
    const hdr_status status = hdr_guard([&] {
        const std::unique_ptr<hdr_node> owned(node);
        const auto ended = unsubscribe(*node); /* callbacks publish, too */
        drain(*node, linger);
        node->readers.say_lost();
        node->readers.end();
        node->watch.reset();
        node->address.reset();
        node->spinner.stop();
        ros::shutdown();
    });
    if (status != HDR_OK)
        hdr_log(HDR_ERROR, "not unregistered from the ROS master: %s", hdr_error_text());
}

const char *hdr_node_name(const hdr_node *node) { return node->name.c_str(); }

hdr_time hdr_time_now(void)
{
    const ros::WallTime now = ros::WallTime::now();
    return {now.sec, now.nsec};
}

void hdr_log(hdr_level level, const char *format, ...)
{
    char line[1024];
    va_list list;
    va_start(list, format);
    std::vsnprintf(line, sizeof line, format, list);
    va_end(list);
    one_line(line);
    hdr_guard([&] {
        switch (level) {
        case HDR_DEBUG: ROS_DEBUG("%s", line); break;
        case HDR_INFO: ROS_INFO("%s", line); break;
        case HDR_WARN: ROS_WARN("%s", line); break;
        case HDR_ERROR: ROS_ERROR("%s", line); break;
        case HDR_FATAL: ROS_FATAL("%s", line); break;
        }
        std::fflush(stdout); /* otherwise a pipe would get the line later */
    });
}
