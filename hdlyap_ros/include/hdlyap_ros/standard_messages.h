/** Messages of other ROS packages as C structs: diagnostics, a number, a text. Their functions are
 * as those of hdlyap's own messages (hdlyap_ros/publisher.h, hdlyap_ros/subscriber.h). */
#ifndef HDLYAP_ROS_STANDARD_MESSAGES_H
#define HDLYAP_ROS_STANDARD_MESSAGES_H

#include "hdlyap_ros/fields.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Values of hdr_diagnostic.level. */
enum { HDR_DIAGNOSTIC_OK, HDR_DIAGNOSTIC_WARN, HDR_DIAGNOSTIC_ERROR };

/** diagnostic_msgs/KeyValue */
typedef struct hdr_key_value {
    const char *key, *value;
} hdr_key_value;

/** diagnostic_msgs/KeyValue[] */
typedef struct hdr_key_value_list {
    const hdr_key_value *data;
    uint32_t count;
} hdr_key_value_list;

/** diagnostic_msgs/DiagnosticArray with one status. If a node sends an array of several, the
 * callback is called once for each. */
typedef struct hdr_diagnostic {
    hdr_header header;
    uint8_t level;
    const char *name, *message, *hardware_id;
    hdr_key_value_list values;
} hdr_diagnostic;

/** std_msgs/Float64 */
typedef struct hdr_float64 {
    double data;
} hdr_float64;

/** std_msgs/String */
typedef struct hdr_string {
    const char *data;
} hdr_string;

/** DO(type) for each type of message above. */
#define HDR_STANDARD_MESSAGES(DO) DO(hdr_diagnostic) DO(hdr_float64) DO(hdr_string)

#ifdef __cplusplus
}
#endif
#endif
