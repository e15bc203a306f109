/** Pictures for rviz: visualization_msgs/MarkerArray as C structs, and the static frame of a
 * picture.
 */
#ifndef HDLYAP_ROS_MARKERS_H
#define HDLYAP_ROS_MARKERS_H

#include "hdlyap_ros/publisher.h"

#ifdef __cplusplus
extern "C" {
#endif

/** geometry_msgs/Point */
typedef struct hdr_point {
    double x, y, z;
} hdr_point;

/** std_msgs/ColorRGBA; each component is 0 .. 1 */
typedef struct hdr_colour {
    float r, g, b, a;
} hdr_colour;

/** Values of hdr_marker.type: the types of visualization_msgs/Marker that are lists or text. */
enum {
    HDR_MARKER_LINE_STRIP = 4,
    HDR_MARKER_LINE_LIST = 5,
    HDR_MARKER_SPHERE_LIST = 7,
    HDR_MARKER_POINTS = 8,
    HDR_MARKER_TEXT = 9,
    HDR_MARKER_TRIANGLE_LIST = 11
};

/** Values of hdr_marker.action. */
enum { HDR_MARKER_ADD = 0, HDR_MARKER_DELETE = 2, HDR_MARKER_DELETE_ALL = 3 };

/** visualization_msgs/Marker that is not rotated and lasts until it is deleted. */
typedef struct hdr_marker {
    const char *ns; /**< namespace, which has a check box in rviz */
    int32_t id;     /**< number of the marker in ns */
    int32_t type, action;
    hdr_point position, scale;
    hdr_colour colour;         /**< colour of all points if colours is NULL */
    const hdr_point *points;   /**< points of a list, [count] */
    const hdr_colour *colours; /**< colour of each point, [count], or NULL */
    uint32_t count;
    const char *text; /**< text of HDR_MARKER_TEXT, otherwise "" */
} hdr_marker;

/** visualization_msgs/MarkerArray. Its stamp is 0, so that rviz draws it even if it arrives late or
 * comes from a bag. */
typedef struct hdr_markers {
    const char *frame_id;
    const hdr_marker *markers;
    uint32_t count;
} hdr_markers;

/** Advertises a latched topic with a queue of one: a slow subscriber gets only the newest picture.
 */
HDR_MUST_CHECK hdr_status hdr_markers_advertise(hdr_publisher **out, hdr_node *node,
                                                const char *topic);
HDR_MUST_CHECK hdr_status hdr_markers_publish(hdr_publisher *publisher, const hdr_markers *message);

/** Publishes on /tf_static, while the node lives, that two frames are identical. To be called once.
 */
HDR_MUST_CHECK hdr_status hdr_frame_publish(hdr_node *node, const char *parent, const char *child);

#ifdef __cplusplus
}
#endif
#endif
