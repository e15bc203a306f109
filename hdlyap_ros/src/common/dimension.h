/** What the nodes of disks and of spheres are called, and their scenes. */
#ifndef HDLYAP_DIMENSION_H
#define HDLYAP_DIMENSION_H

#include "hdlyap/scene.h"

#if HD_DIM == 3
#define NODE_NAME "hdlyap_node_3d"
#define DISKS "spheres"
#define USUAL_SCENE "unnamed"
#define QUICK_SCENE "spheres"
#else
#define NODE_NAME "hdlyap_node"
#define DISKS "disks"
#define USUAL_SCENE "paper_periodic" /* with all defaults */
#define QUICK_SCENE "quick"
#endif

#endif
