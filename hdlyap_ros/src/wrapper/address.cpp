/** Asks whether a node answers at its address: a node whose ROS_IP or ROS_HOSTNAME is wrong is
 * known to the master, and reached by nobody. */
#include "address.hpp"

#include <thread>

#include <ros/network.h>
#include <ros/xmlrpc_manager.h>

#include "node.hpp"

const char *const address_must_be =
    "ROS_IP or ROS_HOSTNAME must be an address by which others reach it";

namespace
{
const double own_seconds = 3.0; /**< in which this node has to answer itself */
const double look_seconds = 0.02;
} // namespace

bool address_answers(const std::string &address, double seconds)
{
    using dispatcher = XmlRpc::XmlRpcDispatch;
    std::string host;
    std::uint32_t port = 0;
    if (!ros::network::splitURI(address, host, port)) return false;
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
    dispatcher dispatch;
    XmlRpc::XmlRpcValue request, answer;
    request[0] = ros::this_node::getName();
    if (!client.executeNonBlock("getPid", request)) return false;
    dispatch.addSource(&client, dispatcher::WritableEvent | dispatcher::Exception);
    bool answered = false;
    for (const double end = master_seconds() + seconds;
         !answered && client.getfd() >= 0 && master_seconds() < end;) {
        dispatch.work(look_seconds);
        answered = client.executeCheckDone(answer);
    }
    dispatch.removeSource(&client);
    client.close();
    return answered && answer.getType() == XmlRpc::XmlRpcValue::TypeArray;
}

void hdr_own_address::asked::ask(const std::string &address)
{
    const bool answers = address_answers(address, own_seconds);
    const std::lock_guard<std::mutex> lock(mutex);
    if (!answers && wanted)
        hdr_log(HDR_WARN, "this node does not answer at its own address %s: %s", address.c_str(),
                address_must_be);
}

hdr_own_address::hdr_own_address() : shared(std::make_shared<asked>())
{
    const std::string address = ros::XMLRPCManager::instance()->getServerURI();
    std::thread([own = shared, address] { own->ask(address); }).detach();
}

hdr_own_address::~hdr_own_address()
{
    const std::lock_guard<std::mutex> lock(shared->mutex);
    shared->wanted = false;
}
