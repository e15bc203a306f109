/** The process as a ROS node: its start, its stop by a signal, waiting, time and log. A process has
 * one node. */
#ifndef HDLYAP_ROS_NODE_H
#define HDLYAP_ROS_NODE_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap_ros/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The node of the process. */
typedef struct hdr_node hdr_node;

/** Wall time since the epoch, in seconds and nanoseconds, even if /clock has simulated time. */
typedef struct hdr_time {
    uint32_t sec, nsec;
} hdr_time;

/** Importance of a line of the log. */
typedef enum hdr_level { HDR_DEBUG, HDR_INFO, HDR_WARN, HDR_ERROR, HDR_FATAL } hdr_level;

/** Makes the process a ROS node with the name `name`. It takes ROS remappings out of argc and argv;
 * sets LC_CTYPE from the environment, for the log; lets SIGINT, SIGTERM and SIGHUP (unless that is
 * ignored) call hdr_stop_request; waits for a ROS master, with one line in the log; warns if the
 * node does not answer at its own address; and runs callbacks on a thread of its own.
 *
 * A process that has not ended stop_seconds after a stop was requested is ended with status 0. If a
 * thread of roscpp gets no memory, the process is ended with memory_status, after a line that says
 * so.
 *
 * Returns HDR_OK, with *out the node, or NULL if a stop was requested before there was a master;
 * HDR_NO_MEMORY; or HDR_FAULT if ROS refuses the name or there is no timer. After a failure the
 * process may return from main, and no destructors are run. */
HDR_MUST_CHECK hdr_status hdr_node_create(hdr_node **out, int *argc, char **argv, const char *name,
                                          double stop_seconds, int memory_status);

/** Changes stop_seconds of hdr_node_create, and the status with which a process that has not ended
 * by then is ended. Call it before a stop is requested. */
void hdr_node_stop_within(double stop_seconds, int status);

/** Frees the subscribers that the program has not freed; waits until other nodes have received the
 * last messages of the node's topics, at most `linger` seconds, or a fraction of a second if a stop
 * was requested; then the node leaves the ROS graph. No callback may call this. node may be NULL.
 */
void hdr_node_free(hdr_node *node, double linger);

/** Seconds for which the master has not confirmed that it knows this node; 0 while these are below
 * five. The master is asked every second, and if it does not know the node, as after its restart,
 * the node registers its topics and services again. Until then nobody can subscribe. A WARN line in
 * the log says so, and an INFO line when it is over. One thread should call this now and then. */
double hdr_node_lost(hdr_node *node);

/** Resolved name of the node, e.g. /hdlyap; valid as long as the node lives. */
const char *hdr_node_name(const hdr_node *node);

/** True after SIGINT, SIGTERM, SIGHUP, `rosnode kill` or hdr_stop_request. */
bool hdr_stop_requested(void);
/** Asks the process to stop, and ends it if it has not stopped after the time that hdr_node_create
 * was given. It may be called from a signal handler. */
void hdr_stop_request(void);

/** Waits `seconds` of the monotonic clock and returns true, or returns false as soon as a stop has
 * been requested: while (hdr_node_wait(0.1)) ... With INFINITY it waits for a stop. */
bool hdr_node_wait(double seconds);

/** Returns the wall time. */
hdr_time hdr_time_now(void);

/** Writes one line to the console and to /rosout, with ? in place of control characters. `format`
 * and what follows are those of printf. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hdr_log(hdr_level level, const char *format, ...);

#ifdef __cplusplus
}
#endif
#endif
