/** A node of one's own: hdlyap's program for what else can move. */
#ifndef HDLYAP_ROS_MAIN_H
#define HDLYAP_ROS_MAIN_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

struct hd_dynamics; /* hdlyap/dynamics.h */

/** The whole of main. The parameter of particles names disks, spheres or one of rows[count], which
 * is what moves if nobody says: rows[0], without rows disks. A row's own parameters are read from
 * the parameter server, checked and recorded as all others. Rows last as long as the process.
 * Returns the exit status (--help). */
int hdlyap_node_main(int argc, char **argv, const struct hd_dynamics *const *rows, int count);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
