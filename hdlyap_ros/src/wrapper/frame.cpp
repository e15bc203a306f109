/** Publishes the static frame of a node on /tf_static. */
#include <tf2_msgs/TFMessage.h>

#include "guard.hpp"
#include "hdlyap_ros/markers.h"
#include "node.hpp"

hdr_status hdr_frame_publish(hdr_node *node, const char *parent, const char *child)
{
    return hdr_guard([&] {
        const ros::WallTime now = ros::WallTime::now();
        tf2_msgs::TFMessage message;
        message.transforms.resize(1);
        geometry_msgs::TransformStamped &same = message.transforms[0];
        same.header.stamp = ros::Time(now.sec, now.nsec);
        same.header.frame_id = parent;
        same.child_frame_id = child;
        same.transform.rotation.w = 1.0;
        node->frame = node->handle.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
        node->frame.publish(message);
    });
}
