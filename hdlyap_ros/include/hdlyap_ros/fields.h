/** Types of message fields that are not plain numbers or strings. Arrays belong to the caller when
 * a message is published, and to the receiving code, until its callback returns, when one is
 * received. An array without elements may be NULL. */
#ifndef HDLYAP_ROS_FIELDS_H
#define HDLYAP_ROS_FIELDS_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** float64[]: element k, 0 .. count - 1, is data[k * stride]. */
typedef struct hdr_doubles {
    const double *data;
    uint32_t count;
    uint32_t stride; /**< distance of two neighbouring elements in doubles, at least 1 */
} hdr_doubles;

/** uint32[] */
typedef struct hdr_uints {
    const uint32_t *data;
    uint32_t count;
} hdr_uints;

/** uint64[] */
typedef struct hdr_counts {
    const uint64_t *data;
    uint32_t count;
} hdr_counts;

/** uint8[] */
typedef struct hdr_bytes {
    const uint8_t *data;
    uint32_t count;
} hdr_bytes;

/** string[] */
typedef struct hdr_strings {
    const char *const *data;
    uint32_t count;
} hdr_strings;

/** std_msgs/Header of a message. */
typedef struct hdr_header {
    /** Time of the message. */
    hdr_time stamp;
    /** Name of the coordinate frame, or "". */
    const char *frame_id;
    /** Number of the message among those of its publisher, which sets it while publishing. A
     * subscriber that sees a gap has lost messages. */
    uint32_t seq;
} hdr_header;

#ifdef __cplusplus
}
#endif
#endif
