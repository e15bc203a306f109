/** Asks the master again and again whether it knows this node, and registers the node with a new
 * one. Connected nodes need no master, but nobody else finds the node without one that knows it. */
#include "master.hpp"

#include <chrono>
#include <thread>

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include "node.hpp"
#include "registration.hpp"

const double master_patience = 10.0;

namespace
{
const double lost_seconds = 5.0; /**< after which a warning says so */
const double silent_seconds = 3.0;
const std::chrono::seconds between_questions{1};
/** How long the thread may take to end: if it has nothing to do, and if parameters are unwritten.
 */
const std::chrono::milliseconds master_end{100}, write_end{3000};

/** Asks the master about something of this name. Returns an empty text if it knows of none. */
std::string looked_up(const char *question, const std::string &name)
{
    XmlRpc::XmlRpcValue request, response, address;
    request[0] = ros::this_node::getName();
    request[1] = name;
    return ros::master::execute(question, request, response, address, false) ? address : "";
}

/** Whether the master knows the first that roscpp registers: a new master, to which this node has
 * registered something since, does not. */
bool master_knows() { return !looked_up("lookupService", first_service()).empty(); }

/** Whether another node has the name of this one: the master would end it. */
bool name_is_anothers()
{
    const std::string address = looked_up("lookupNode", ros::this_node::getName());
    return !address.empty() && address != ros::XMLRPCManager::instance()->getServerURI();
}
} // namespace

double master_seconds()
{
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

void hdr_master_watch::asked::ask()
{
    const bool knows = master_knows();
    if (knows) known = master_seconds();
    if (!knows && !ros::master::check()) return;
    answered = master_seconds();
    write_all();
    if (knows || hdr_stop_requested() || name_is_anothers()) return;
    if (register_again(services_now(), [this] { return is_wanted(); })) again = true;
}

void hdr_master_watch::asked::write_all()
{
    std::unique_lock<std::mutex> lock(mutex);
    while (!unwritten.empty()) {
        const auto first = unwritten.begin();
        XmlRpc::XmlRpcValue request, response, ignored;
        request[0] = ros::this_node::getName();
        request[1] = first->first;
        request[2] = first->second;
        lock.unlock();
        const bool written = ros::master::execute("setParam", request, response, ignored, false);
        lock.lock();
        if (!written) return;
        const auto now = unwritten.find(request[1]);
        if (now != unwritten.end() && now->second == request[2])
            unwritten.erase(now); /* no later value */
    }
}

bool hdr_master_watch::asked::is_wanted()
{
    const std::lock_guard<std::mutex> lock(mutex);
    return wanted;
}

std::vector<std::string> hdr_master_watch::asked::services_now()
{
    const std::lock_guard<std::mutex> lock(mutex);
    return services;
}

void hdr_master_watch::asked::go_on()
{
    std::unique_lock<std::mutex> lock(mutex);
    while (wanted) {
        lock.unlock();
        ask();
        lock.lock();
        changed.wait_for(lock, between_questions, [this] { return !wanted || has_more; });
        has_more = false;
    }
    lock.unlock();
    write_all();
    lock.lock();
    ended = true;
    changed.notify_all();
}

hdr_master_watch::hdr_master_watch(const std::vector<std::string> &services)
    : shared(std::make_shared<asked>())
{
    shared->services = services;
    shared->known = shared->answered = master_seconds();
    std::thread([own = shared] { own->go_on(); }).detach();
}

hdr_master_watch::~hdr_master_watch()
{
    std::unique_lock<std::mutex> lock(shared->mutex);
    shared->wanted = false;
    shared->changed.notify_all();
    const auto longest = shared->unwritten.empty() ? master_end : write_end;
    shared->changed.wait_for(lock, longest, [this] { return shared->ended; });
    if (!shared->unwritten.empty())
        hdr_log(HDR_WARN, "%zu parameters are not written to the parameter server: no answer of it",
                shared->unwritten.size());
    shared->unwritten.clear(); /* a thread that is left writes no more while the process ends */
}

void hdr_master_watch::service_is(const std::string &name)
{
    const std::lock_guard<std::mutex> lock(shared->mutex);
    shared->services.push_back(name);
}

void hdr_master_watch::write(const std::string &parameter, const XmlRpc::XmlRpcValue &value)
{
    const std::lock_guard<std::mutex> lock(shared->mutex);
    shared->unwritten[parameter] = value;
    shared->has_more = true;
    shared->changed.notify_all();
}

double hdr_master_watch::lost()
{
    const double now = master_seconds(), seconds = now - shared->known;
    const bool is_lost = seconds >= lost_seconds;
    const char *address = ros::master::getURI().c_str();
    if (is_lost && !said)
        hdr_log(HDR_WARN,
                "the ROS master at %s %s: subscribers that are connected stay so, but nobody finds "
                "this node any more",
                address,
                now - shared->answered < silent_seconds ? "does not know this node"
                                                        : "does not answer");
    if (shared->again.exchange(false))
        hdr_log(HDR_INFO, "the ROS master at %s did not know this node, which has registered again",
                address);
    else if (!is_lost && said)
        hdr_log(HDR_INFO, "the ROS master at %s is there again", address);
    said = is_lost;
    return is_lost ? seconds : 0.0;
}

double hdr_node_lost(hdr_node *node) { return node->watch ? node->watch->lost() : 0.0; }
