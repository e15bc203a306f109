/** A node of one's own: hdlyap's program with a dynamics of one's own. */
#ifndef HDLYAP_ROS_MAIN_H
#define HDLYAP_ROS_MAIN_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

struct hd_dynamics; /* hdlyap/dynamics.h */

/** Does all of main. The parameter particles names a dynamics of the core or one of rows[count];
 * its default is rows[0], or disks without rows. The parameters of a row are read from the
 * parameter server, checked and recorded like all others. Rows must last as long as the process.
 * Returns the exit status (--help). */
int hdlyap_node_main(int argc, char **argv, const struct hd_dynamics *const *rows, int count);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
