/** Asks the master again and again whether it knows this node. Connected nodes need no master, but
 * nobody else finds the node if the master is gone, or is a new one that does not know it. */
#include "master.hpp"

#include <chrono>
#include <thread>

#include <ros/ros.h>

#include "node.hpp"

const double master_patience = 10.0;

namespace
{
const double lost_seconds = 5.0; /**< after which a warning says so */
const double silent_seconds = 3.0;
const std::chrono::seconds between_questions{1};
/** How long the thread may take to end if it is not waiting for an answer. */
const std::chrono::milliseconds master_end{100};

bool master_knows()
{
    XmlRpc::XmlRpcValue request, response, address;
    request[0] = request[1] = ros::this_node::getName();
    return ros::master::execute("lookupNode", request, response, address, false);
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
    if (knows || ros::master::check()) answered = master_seconds();
}

void hdr_master_watch::asked::go_on()
{
    std::unique_lock<std::mutex> lock(mutex);
    while (wanted) {
        lock.unlock();
        ask();
        lock.lock();
        changed.wait_for(lock, between_questions, [this] { return !wanted; });
    }
    ended = true;
    changed.notify_all();
}

hdr_master_watch::hdr_master_watch() : shared(std::make_shared<asked>())
{
    shared->known = shared->answered = master_seconds();
    std::thread([own = shared] { own->go_on(); }).detach();
}

hdr_master_watch::~hdr_master_watch()
{
    std::unique_lock<std::mutex> lock(shared->mutex);
    shared->wanted = false;
    shared->changed.notify_all();
    shared->changed.wait_for(lock, master_end, [this] { return shared->ended; });
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
    if (!is_lost && said) hdr_log(HDR_INFO, "the ROS master at %s is there again", address);
    said = is_lost;
    return is_lost ? seconds : 0.0;
}

double hdr_node_lost(hdr_node *node) { return node->watch ? node->watch->lost() : 0.0; }
