/** The node with the particles that the core knows. */
#include "hdlyap_ros/main.h"

#include <stddef.h>

int main(int argc, char **argv) { return hdlyap_node_main(argc, argv, NULL, 0); }
