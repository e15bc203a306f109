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

/** Wall time since the epoch; never the simulated time of /clock. */
typedef struct hdr_time {
    uint32_t sec, nsec;
} hdr_time;

typedef enum hdr_level { HDR_DEBUG, HDR_INFO, HDR_WARN, HDR_ERROR, HDR_FATAL } hdr_level;

/** Takes the remappings out of argc and argv, replaces the handlers of SIGINT, SIGTERM and
 * SIGHUP (unless it is ignored) by hdr_stop_request, waits until there is a master (says so once)
 * and serves callbacks from a thread of its own. A process that has not ended stop_seconds after a
 * stop was requested is ended with status 0, whatever it is doing; one in which a thread of
 * roscpp's finds no memory with memory_status, after a line that says so. LC_CTYPE is then that of
 * the environment, for the log. *out is NULL if a stop was requested before there was a master.
 * Fails with HDR_NO_MEMORY or HDR_FAULT (a name that ROS refuses, no timer): the process may then
 * return from main, which runs no destructors. */
HDR_MUST_CHECK hdr_status hdr_node_create(hdr_node **out, int *argc, char **argv, const char *name,
                                          double stop_seconds, int memory_status);

/** Changes stop_seconds and the status of a process that has not ended by then, before a stop is
 * requested. */
void hdr_node_stop_within(double stop_seconds, int status);

/** Ends this node's own subscribers, waits until all subscribers of its topics have been handed
 * their last message, at most linger seconds (a fraction of a second once a stop was requested),
 * then leaves the graph. NULL is allowed. */
void hdr_node_free(hdr_node *node, double linger);

/** Seconds for which the master has not said that it knows this node, as it is asked to every
 * second; 0 up to five. Nobody can subscribe meanwhile, nor for ever if the master is another one:
 * a WARN line says so, an INFO line when it is over. By one thread, now and then. */
double hdr_node_lost(hdr_node *node);

const char *hdr_node_name(const hdr_node *node); /**< resolved, e.g. /hdlyap */

/** True after SIGINT, SIGTERM, SIGHUP, `rosnode kill` or hdr_stop_request. */
bool hdr_stop_requested(void);
/** Asks the process to stop; may be called from a signal handler. */
void hdr_stop_request(void);

/** Waits so many seconds (INFINITY: for ever), by a clock that nobody sets. False as soon as a stop
 * has been requested: while (hdr_node_wait(0.1)) ... */
bool hdr_node_wait(double seconds);

hdr_time hdr_time_now(void);

/** One line to the console and /rosout, control characters as question marks; format as for printf.
 */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void hdr_log(hdr_level level, const char *format, ...);

#ifdef __cplusplus
}
#endif
#endif
