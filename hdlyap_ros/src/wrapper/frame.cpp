/** The static frames of a node, on /tf_static. */
#include "guard.hpp"
#include "hdlyap_ros/markers.h"
#include "node.hpp"

hdr_status hdr_frame_publish(hdr_node *node, const char *parent, const char *child)
{
    return hdr_guard([&] {
        const ros::WallTime now = ros::WallTime::now();
        geometry_msgs::TransformStamped same;
        same.header.stamp = ros::Time(now.sec, now.nsec);
        same.header.frame_id = parent;
        same.child_frame_id = child;
        same.transform.rotation.w = 1.0;
        if (!node->frames) node->frames.reset(new tf2_ros::StaticTransformBroadcaster);
        node->frames->sendTransform(same);
    });
}
