/** The structs of a node, a publisher and a subscriber, and functions that files of the wrapper
 * share. Private to the wrapper. */
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/ros.h>

#include "address.hpp"
#include "backlog.hpp"
#include "hdlyap_ros/node.h"
#include "master.hpp"
#include "readers.hpp"

struct hdr_publisher {
    ros::Publisher publisher;
    std::string topic;
    std::string datatype;
    int queue;
    std::shared_ptr<hdr_backlog> backlog;
    hdr_node *node;
    bool watched = false; /**< what its subscribers lose is counted */
    bool patient = false; /**< waits if a message would be lost otherwise */
    double waited = 0.0;  /**< how long it has waited for subscribers [s] */
};

struct hdr_subscriber {
    ros::Subscriber subscriber;
    std::string topic;
    std::string datatype;
    hdr_node *node;
    int looks = 0; /**< consecutive looks at which its topic was published, but not connected */
    /** False once the subscriber is freed. The callback shares this, because it may be the one that
     * frees the subscriber. */
    std::shared_ptr<std::atomic<bool>> wanted = std::make_shared<std::atomic<bool>>(true);
};

struct hdr_node {
    ros::NodeHandle handle;
    ros::AsyncSpinner spinner{1};
    std::string name;
    std::vector<std::string> arguments; /**< those of the program that are NAME:=VALUE */
    hdr_readers readers;
    std::unique_ptr<hdr_master_watch> watch; /**< NULL until the node is registered */
    std::unique_ptr<hdr_own_address> address;
    std::vector<std::unique_ptr<hdr_publisher>> publishers;
    std::vector<ros::ServiceServer> services;
    ros::Publisher frame; /**< publishes on /tf_static */
    std::vector<std::unique_ptr<hdr_subscriber>> subscribers;
    ros::WallTimer lookout; /**< looks for subscribers that cannot be connected */
    std::mutex mutex;       /**< protects subscribers, which callbacks may free, and lookout */
};

/** Checks the length of a queue for roscpp, to which 0 would mean no limit. Throws
 * std::invalid_argument if it is below 1. */
uint32_t queue_length(const std::string &topic, int queue);

/** Throws std::invalid_argument if roscpp has refused a topic because this node has it with another
 * type, which roscpp does not tell its caller. */
[[noreturn]] void throw_of_another_type(const std::string &topic, const std::string &datatype);

/** Makes the callback thread say from now on which subscribers cannot be connected: an ERROR line
 * if a topic is published with another type, a WARN line if its publisher cannot be reached. The
 * master is only asked while a subscriber is not connected. */
void connection_warnings_start(hdr_node *node);

/** Offers ~get_loggers, which roscpp's own kills the process with. Throws if the master does not
 * answer. */
void loggers_advertise(hdr_node *node);

/** Makes SIGINT and SIGTERM, and SIGHUP unless it is ignored, call hdr_stop_request. stop_seconds
 * after a request the process is ended with status 0. Throws std::system_error. */
void stop_handlers_install(double stop_seconds);

/** If a thread of roscpp finds no memory, the process will end with this status instead of
 * crashing. */
void stop_without_memory(int status) noexcept;
