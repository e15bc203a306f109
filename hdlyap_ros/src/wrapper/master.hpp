/** Whether the master still knows this node, and what makes a new one know it; private to the
 * wrapper. */
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <XmlRpcValue.h>

/** Asks the master every second, from a separate thread, because roscpp waits forever for a master
 * that hangs. */
class hdr_master_watch
{
  public:
    /** Throws std::system_error if no thread can be created. */
    explicit hdr_master_watch(const std::vector<std::string> &services);
    ~hdr_master_watch();
    hdr_master_watch(const hdr_master_watch &) = delete;
    hdr_master_watch &operator=(const hdr_master_watch &) = delete;
    /** Tells the name of a service of this node, to be registered with a new master. */
    void service_is(const std::string &name);
    /** Has a parameter written to the server as soon as the master answers. */
    void write(const std::string &parameter, const XmlRpc::XmlRpcValue &value);
    /** See hdr_node_lost. */
    double lost();

  private:
    /** Belongs to the thread too, which outlives the watch if the master hangs. */
    struct asked {
        std::atomic<double> known;    /**< when the node was last known; steady clock [s] */
        std::atomic<double> answered; /**< when the master last answered at all [s] */
        std::mutex mutex;
        std::condition_variable changed;
        bool wanted = true, ended = false;
        std::vector<std::string> services;
        std::atomic<bool> again{false}; /**< it has registered with a new master */
        std::map<std::string, XmlRpc::XmlRpcValue> unwritten; /**< parameters, by full name */
        bool has_more = false; /**< there are others than at the last question */
        bool is_wanted();
        void write_all();
        std::vector<std::string> services_now();
        void ask();
        void go_on();
    };
    std::shared_ptr<asked> shared;
    bool said = false;
};

double master_seconds();

/** How long roscpp tries to register something with the master [s]. */
extern const double master_patience;

/** Runs a body that registers something. Throws if it took so long that roscpp has given up, which
 * roscpp itself does not say. */
template <class Body> auto master_registered(const Body &body)
{
    const double begin = master_seconds();
    auto made = body();
    if (master_seconds() - begin >= master_patience)
        throw std::runtime_error("the ROS master did not answer within " +
                                 std::to_string(static_cast<int>(master_patience)) + " s");
    return made;
}
