/** Types of message fields that are not plain numbers or strings. */
#ifndef HDLYAP_ROS_FIELDS_H
#define HDLYAP_ROS_FIELDS_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** float64[], whose element k is data[k * stride]. */
typedef struct hdr_doubles {
    const double *data;
    uint32_t count;
    uint32_t stride; /**< distance of two elements in doubles, >= 1 */
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

/** std_msgs/Header */
typedef struct hdr_header {
    hdr_time stamp;
    const char *frame_id;
    uint32_t seq; /**< number of the message of its publisher, filled while publishing: a gap is a
                     lost message */
} hdr_header;

#ifdef __cplusplus
}
#endif
#endif
