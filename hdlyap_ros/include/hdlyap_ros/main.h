/** A program's own node: hdlyap's node with dynamics that the program adds. */
#ifndef HDLYAP_ROS_MAIN_H
#define HDLYAP_ROS_MAIN_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

struct hd_dynamics; /* hdlyap/dynamics.h */

/** Does all of main for the node. The ROS parameter particles names a dynamics of the core or one
 * of rows[count]; if it is not given, rows[0] is taken, or disks if count is 0. Parameters of a row
 * are read from the parameter server, checked and recorded like all others. Rows must last as long
 * as the process. Returns the exit status that main has to return; the node's --help lists them. */
int hdlyap_node_main(int argc, char **argv, const struct hd_dynamics *const *rows, int count);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
