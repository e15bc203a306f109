/** A node of one's own: the program of hdlyap_node for what else can move. */
#ifndef HDLYAP_ROS_MAIN_H
#define HDLYAP_ROS_MAIN_H

#include "hdlyap/dynamics.h"

HD_API_BEGIN

/** The whole of main. The parameter `particles` names disks, spheres or one of rows[count], which
 * is what moves if nobody says: rows[0], without rows disks. A row's own parameters are read from
 * the parameter server, checked and recorded as all others. Rows last as long as the process.
 * Returns the exit status (--help). */
int hdlyap_node_main(int argc, char **argv, const hd_dynamics *const *rows, int count);

HD_API_END
#endif
