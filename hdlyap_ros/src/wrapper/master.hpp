/** Whether the master still knows this node; private to the wrapper. */
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

/** Asks it every second, by a thread of its own: roscpp waits without an end for a master that
 * hangs. */
class hdr_master_watch
{
  public:
    /** Throws std::system_error if there is no thread for it. */
    hdr_master_watch();
    ~hdr_master_watch();
    hdr_master_watch(const hdr_master_watch &) = delete;
    hdr_master_watch &operator=(const hdr_master_watch &) = delete;
    /** hdr_node_lost. */
    double lost();

  private:
    /** Outlives the watch if the master hangs. */
    struct asked {
        std::atomic<double> known;    /**< when it last was, by the steady clock [s] */
        std::atomic<double> answered; /**< when there last was any answer [s] */
        std::mutex mutex;
        std::condition_variable changed;
        bool wanted = true, ended = false;
        void ask();
        void go_on();
    };
    std::shared_ptr<asked> shared;
    bool said = false;
};

double master_seconds();

/** How long roscpp tries to register something [s]. */
extern const double master_patience;

/** Body registers something; roscpp does not say that it has given up. */
template <class Body> auto master_registered(const Body &body)
{
    const double begin = master_seconds();
    auto made = body();
    if (master_seconds() - begin >= master_patience)
        throw std::runtime_error("the ROS master did not answer within " +
                                 std::to_string(static_cast<int>(master_patience)) + " s");
    return made;
}
