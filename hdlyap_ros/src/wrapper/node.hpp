/** What a node, a publisher and a subscriber are made of, and what files of the wrapper have for
 * each other; private to it. */
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/ros.h>

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
    bool patient = false;   /**< waits rather than that a message is lost */
    bool exhausted = false; /**< its patience for who leaves the queue full */
    double waited = 0.0;    /**< for them [s] */
};

struct hdr_subscriber {
    ros::Subscriber subscriber;
    std::string topic;
    std::string datatype;
    hdr_node *node;
    int looks = 0; /**< at it since it was last connected, or not published at all */
    /** False once it is freed, which its callback outlives when it is the one to do so. */
    std::shared_ptr<std::atomic<bool>> wanted = std::make_shared<std::atomic<bool>>(true);
};

struct hdr_node {
    ros::NodeHandle handle;
    ros::AsyncSpinner spinner{1};
    std::string name;
    hdr_readers readers;
    std::unique_ptr<hdr_master_watch> watch; /**< once it is known by name */
    std::vector<std::unique_ptr<hdr_publisher>> publishers;
    std::vector<ros::ServiceServer> services;
    ros::Publisher frame; /**< of /tf_static */
    std::vector<std::unique_ptr<hdr_subscriber>> subscribers;
    ros::WallTimer lookout; /**< for subscribers that cannot be connected */
    std::mutex mutex;       /**< of subscribers, which callbacks may free, and of lookout */
};

/** roscpp's: 0 would be without an end. Throws std::invalid_argument. */
uint32_t queue_length(const std::string &topic, int queue);

/** For what roscpp refuses without saying why to its caller. */
[[noreturn]] void throw_of_another_type(const std::string &topic, const std::string &datatype);

/** From now on, on the callback thread, it is said which subscribers cannot be connected. An ERROR
 * line for each publisher of another type, a WARN line where somebody of the right type cannot be
 * reached; while everybody is connected nobody is asked. */
void connection_warnings_start(hdr_node *node);

/** SIGINT and SIGTERM, and SIGHUP unless it is ignored, become hdr_stop_request; stop_seconds after
 * it the process is ended with status 0. Throws std::system_error. */
void stop_handlers_install(double stop_seconds);

/** Where a thread of roscpp finds no memory, the process ends with this status instead of a crash.
 */
void stop_without_memory(int status) noexcept;
