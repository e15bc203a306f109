/** What a node and a publisher are made of; private to the wrapper. */
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "backlog.hpp"
#include "hdlyap_ros/node.h"

struct hdr_publisher {
    ros::Publisher publisher;
    std::string topic;
    std::string datatype;
    int queue;
    hdr_backlog backlog; /**< not of latched topics */
};

struct hdr_node {
    ros::NodeHandle handle;
    ros::AsyncSpinner spinner{1};
    std::string name;
    std::vector<std::unique_ptr<hdr_publisher>> publishers;
    std::vector<ros::ServiceServer> services;
    std::unique_ptr<tf2_ros::StaticTransformBroadcaster> frames;
};
