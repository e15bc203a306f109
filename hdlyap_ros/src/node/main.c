/** The node of disks and spheres. */
#include "hdlyap_ros/main.h"

#include <stddef.h>

int main(int argc, char **argv) { return hdlyap_node_main(argc, argv, NULL, 0); }
