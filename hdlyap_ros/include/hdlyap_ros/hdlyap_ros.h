/** A C API over roscpp, with which a C program is a node that publishes and receives hdlyap's
 * messages.
 */
#ifndef HDLYAP_ROS_HDLYAP_ROS_H
#define HDLYAP_ROS_HDLYAP_ROS_H

#include "hdlyap_ros/markers.h"
#include "hdlyap_ros/node.h"
#include "hdlyap_ros/params.h"
#include "hdlyap_ros/publisher.h"
#include "hdlyap_ros/service.h"
#include "hdlyap_ros/subscriber.h"

#endif
