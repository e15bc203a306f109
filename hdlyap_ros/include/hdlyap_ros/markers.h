/** Pictures for rviz: visualization_msgs/MarkerArray as C structs, and the coordinate frame of a
 * picture. */
#ifndef HDLYAP_ROS_MARKERS_H
#define HDLYAP_ROS_MARKERS_H

#include "hdlyap_ros/publisher.h"

#ifdef __cplusplus
extern "C" {
#endif

/** geometry_msgs/Point. */
typedef struct hdr_point {
    double x, y, z;
} hdr_point;

/** std_msgs/ColorRGBA: red, green, blue and opacity, each 0 .. 1. */
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

/** Values of hdr_marker.action: draw or replace a marker, delete one, delete all. */
enum { HDR_MARKER_ADD = 0, HDR_MARKER_DELETE = 2, HDR_MARKER_DELETE_ALL = 3 };

/** visualization_msgs/Marker without rotation, which lasts until it is deleted. */
typedef struct hdr_marker {
    const char *ns; /**< namespace: rviz has a check box for each */
    int32_t id;     /**< number of the marker within its namespace */
    /** One of HDR_MARKER_LINE_STRIP .. HDR_MARKER_TRIANGLE_LIST; one of HDR_MARKER_ADD, .. */
    int32_t type, action;
    /** Origin of its points [units of the frame]; size of its spheres, points, lines or letters. */
    hdr_point position, scale;
    hdr_colour colour;         /**< colour of all points, if `colours` is NULL */
    const hdr_point *points;   /**< points of the list, [count]; NULL for text */
    const hdr_colour *colours; /**< colour of each point, [count], or NULL */
    uint32_t count;
    const char *text; /**< text of a HDR_MARKER_TEXT, otherwise "" */
} hdr_marker;

/** visualization_msgs/MarkerArray. It is sent with the time stamp 0, so that rviz also draws a
 * picture that arrives late or comes from a bag. */
typedef struct hdr_markers {
    const char *frame_id;
    const hdr_marker *markers;
    uint32_t count;
} hdr_markers;

/** Advertises a topic of pictures: it is latched, so a new subscriber gets the last picture, and
 * has a queue of one, so a slow subscriber gets only the newest. Fails as the functions of
 * hdlyap_ros/publisher.h. */
HDR_MUST_CHECK hdr_status hdr_markers_advertise(hdr_publisher **out, hdr_node *node,
                                                const char *topic);
/** Publishes a picture; see hdlyap_ros/publisher.h. */
HDR_MUST_CHECK hdr_status hdr_markers_publish(hdr_publisher *publisher, const hdr_markers *message);

/** Publishes on /tf_static, as long as the node lives, that the coordinate frames `parent` and
 * `child` are identical. A node publishes one pair: a second call replaces the first one. Returns
 * HDR_OK, HDR_FAULT or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_frame_publish(hdr_node *node, const char *parent, const char *child);

#ifdef __cplusplus
}
#endif
#endif
