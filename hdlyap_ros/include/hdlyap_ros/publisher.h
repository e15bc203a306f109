/** Topics out: one typed advertise and one typed publish function per message. */
#ifndef HDLYAP_ROS_PUBLISHER_H
#define HDLYAP_ROS_PUBLISHER_H

#include "hdlyap_ros/messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A topic of one type. Used by one thread at a time. */
typedef struct hdr_publisher hdr_publisher;

/* Topic names: "~x" is private to the node. queue >= 1 is the number of messages kept for each
 * subscriber that is behind; the oldest are dropped first. The publishers belong to the node and
 * live as long as it does. Fail with HDR_FAULT or HDR_NO_MEMORY. */

/** Latched: who comes late gets the last message. */
HDR_MUST_CHECK hdr_status hdr_run_info_advertise(hdr_publisher **out, hdr_node *node,
                                                 const char *topic);
/** The same, with a queue of one: who is behind gets the newest only. */
HDR_MUST_CHECK hdr_status hdr_slow_vectors_advertise(hdr_publisher **out, hdr_node *node,
                                                     const char *topic);
HDR_MUST_CHECK hdr_status hdr_spectrum_advertise(hdr_publisher **out, hdr_node *node,
                                                 const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_modes_advertise(hdr_publisher **out, hdr_node *node,
                                              const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_steps_advertise(hdr_publisher **out, hdr_node *node,
                                              const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_lp_phases_advertise(hdr_publisher **out, hdr_node *node,
                                                  const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_mode_field_advertise(hdr_publisher **out, hdr_node *node,
                                                   const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_hydro_advertise(hdr_publisher **out, hdr_node *node,
                                              const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_covariant_advertise(hdr_publisher **out, hdr_node *node,
                                                  const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_state_advertise(hdr_publisher **out, hdr_node *node,
                                              const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_cost_advertise(hdr_publisher **out, hdr_node *node, const char *topic,
                                             int queue);
HDR_MUST_CHECK hdr_status hdr_diagnostic_advertise(hdr_publisher **out, hdr_node *node,
                                                   const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_float64_advertise(hdr_publisher **out, hdr_node *node,
                                                const char *topic, int queue);
HDR_MUST_CHECK hdr_status hdr_string_advertise(hdr_publisher **out, hdr_node *node,
                                               const char *topic, int queue);

/** Number of subscribers connected now. */
int hdr_publisher_subscribers(const hdr_publisher *publisher);

/** Asks the master how many nodes have subscribed to each topic, whether they are connected yet or
 * not: registered[k] of publishers[k], 0 where that is NULL. Waits that long at most, and no longer
 * than until a stop is requested. HDR_FAULT if the master has not answered by then; HDR_NO_MEMORY.
 */
HDR_MUST_CHECK hdr_status hdr_publishers_registered(int registered[],
                                                    hdr_publisher *const publishers[], int count,
                                                    double seconds);

/** How far the slowest subscriber is behind; what waits in buffers of the kernel does not count. */
typedef struct hdr_lag {
    const char *topic; /**< resolved and remapped; as long as the publisher lives */
    double seconds;    /**< that a message waits, or has waited; 0 if none does now */
    int messages;      /**< published meanwhile, with that one */
    bool losing;       /**< as many as the queue holds: the oldest are lost */
} hdr_lag;

/** May be called by any thread, the more often the more exactly; does not wait. 0 for latched
 * topics. */
hdr_lag hdr_publisher_lag(hdr_publisher *publisher);

/* The view is serialised before these return and never waited for. Without a subscriber and without
 * latching they do nothing. HDR_FAULT if the publisher is of another type; HDR_NO_MEMORY. */

HDR_MUST_CHECK hdr_status hdr_run_info_publish(hdr_publisher *publisher, const hdr_run_info *view);
HDR_MUST_CHECK hdr_status hdr_spectrum_publish(hdr_publisher *publisher, const hdr_spectrum *view);
HDR_MUST_CHECK hdr_status hdr_modes_publish(hdr_publisher *publisher, const hdr_modes *view);
HDR_MUST_CHECK hdr_status hdr_steps_publish(hdr_publisher *publisher, const hdr_steps *view);
HDR_MUST_CHECK hdr_status hdr_lp_phases_publish(hdr_publisher *publisher,
                                                const hdr_lp_phases *view);
HDR_MUST_CHECK hdr_status hdr_mode_field_publish(hdr_publisher *publisher,
                                                 const hdr_mode_field *view);
HDR_MUST_CHECK hdr_status hdr_hydro_publish(hdr_publisher *publisher, const hdr_hydro *view);
HDR_MUST_CHECK hdr_status hdr_covariant_publish(hdr_publisher *publisher,
                                                const hdr_covariant *view);
HDR_MUST_CHECK hdr_status hdr_state_publish(hdr_publisher *publisher, const hdr_state *view);
HDR_MUST_CHECK hdr_status hdr_slow_vectors_publish(hdr_publisher *publisher,
                                                   const hdr_slow_vectors *view);
HDR_MUST_CHECK hdr_status hdr_cost_publish(hdr_publisher *publisher, const hdr_cost *view);
HDR_MUST_CHECK hdr_status hdr_diagnostic_publish(hdr_publisher *publisher,
                                                 const hdr_diagnostic *view);
HDR_MUST_CHECK hdr_status hdr_float64_publish(hdr_publisher *publisher, const hdr_float64 *view);
HDR_MUST_CHECK hdr_status hdr_string_publish(hdr_publisher *publisher, const hdr_string *view);

#ifdef __cplusplus
}
#endif
#endif
