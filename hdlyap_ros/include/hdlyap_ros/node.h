/** The process as a ROS node: start, stop by signal, clock, log. One node per process. */
#ifndef HDLYAP_ROS_NODE_H
#define HDLYAP_ROS_NODE_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap_ros/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hdr_node hdr_node;

/** Wall time since the epoch, even if /clock has simulated time. */
typedef struct hdr_time {
    uint32_t sec, nsec;
} hdr_time;

typedef enum hdr_level { HDR_DEBUG, HDR_INFO, HDR_WARN, HDR_ERROR, HDR_FATAL } hdr_level;

/** Makes the process a ROS node. It takes the remappings out of argc and argv, lets SIGINT, SIGTERM
 * and SIGHUP (unless ignored) call hdr_stop_request, waits for a master, with one line in the log,
 * and runs callbacks on a thread of its own. It sets LC_CTYPE from the environment, for the log. A
 * process that has not ended stop_seconds after a stop was requested is ended with status 0. If a
 * thread of roscpp finds no memory, the process is ended with memory_status, after a line that says
 * so. *out is NULL if a stop was requested before there was a master. Fails with HDR_NO_MEMORY, or
 * with HDR_FAULT if ROS refuses the name or there is no timer; the process may then return from
 * main, which runs no destructors. */
HDR_MUST_CHECK hdr_status hdr_node_create(hdr_node **out, int *argc, char **argv, const char *name,
                                          double stop_seconds, int memory_status);

/** Changes stop_seconds, and the status of a process that has not ended by then. To be called
 * before a stop is requested. */
void hdr_node_stop_within(double stop_seconds, int status);

/** Frees the node's own subscribers, waits until other nodes have received the last messages of its
 * topics, at most `linger` seconds (a fraction of a second if a stop was requested), and leaves the
 * graph. node may be NULL. */
void hdr_node_free(hdr_node *node, double linger);

/** Seconds since the master last confirmed, as it is asked every second, that it knows this node; 0
 * below five. Meanwhile nobody can subscribe, and never again if another master has replaced it: a
 * WARN line says so, and an INFO line when it is over. One thread should call it now and then. */
double hdr_node_lost(hdr_node *node);

const char *hdr_node_name(const hdr_node *node); /**< resolved name, e.g. /hdlyap */

/** True after SIGINT, SIGTERM, SIGHUP, `rosnode kill` or hdr_stop_request. */
bool hdr_stop_requested(void);
/** Asks the process to stop; may be called from a signal handler. */
void hdr_stop_request(void);

/** Waits so many seconds of the monotonic clock; INFINITY is allowed. Returns false as soon as a
 * stop has been requested: while (hdr_node_wait(0.1)) ... */
bool hdr_node_wait(double seconds);

hdr_time hdr_time_now(void);

/** Writes one line to the console and /rosout, with ? for control characters. format is that of
 * printf. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hdr_log(hdr_level level, const char *format, ...);

#ifdef __cplusplus
}
#endif
#endif
