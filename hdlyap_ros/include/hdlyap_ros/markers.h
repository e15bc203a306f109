/** Pictures for rviz: visualization_msgs/MarkerArray as C sees it, and the static frame that it is
 * in. */
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

/** std_msgs/ColorRGBA, 0 .. 1 */
typedef struct hdr_colour {
    float r, g, b, a;
} hdr_colour;

/** hdr_marker.type, of those of visualization_msgs/Marker that are lists or text */
enum {
    HDR_MARKER_LINE_STRIP = 4,
    HDR_MARKER_LINE_LIST = 5,
    HDR_MARKER_SPHERE_LIST = 7,
    HDR_MARKER_POINTS = 8,
    HDR_MARKER_TEXT = 9,
    HDR_MARKER_TRIANGLE_LIST = 11
};

/** hdr_marker.action */
enum { HDR_MARKER_ADD = 0, HDR_MARKER_DELETE = 2, HDR_MARKER_DELETE_ALL = 3 };

/** visualization_msgs/Marker without rotation, for ever. */
typedef struct hdr_marker {
    const char *ns; /**< a check box of rviz */
    int32_t id;     /**< of one marker of ns */
    int32_t type, action;
    hdr_point position, scale;
    hdr_colour colour;         /**< where there is none per point */
    const hdr_point *points;   /**< of lists; [count] */
    const hdr_colour *colours; /**< [count], or NULL */
    uint32_t count;
    const char *text; /**< "" but for HDR_MARKER_TEXT */
} hdr_marker;

/** visualization_msgs/MarkerArray. Stamped 0: drawn whenever it arrives, also late and from a bag.
 */
typedef struct hdr_markers {
    const char *frame_id;
    const hdr_marker *markers;
    uint32_t count;
} hdr_markers;

/** Latched, with a queue of one: who is behind gets the newest picture only. */
HDR_MUST_CHECK hdr_status hdr_markers_advertise(hdr_publisher **out, hdr_node *node,
                                                const char *topic);
HDR_MUST_CHECK hdr_status hdr_markers_publish(hdr_publisher *publisher, const hdr_markers *message);

/** Says on /tf_static that the frames are one and the same, as long as the node lives. Once. */
HDR_MUST_CHECK hdr_status hdr_frame_publish(hdr_node *node, const char *parent, const char *child);

#ifdef __cplusplus
}
#endif
#endif
