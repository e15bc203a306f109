/** What disks and spheres are called, and what spheres alone have. */
#ifndef HDLYAP_DIMENSION_H
#define HDLYAP_DIMENSION_H

#include "common/nodes.h"
#include "hdlyap/wave.h"

#if HD_DIM == 2
#define NODE_NAME "hdlyap_node"
#define DISKS "disks"
#define USUAL_SCENE "paper_periodic" /* with all defaults */
#define QUICK_SCENE "quick"
#define OF_SPHERES(...)
#else
#define NODE_NAME "hdlyap_node_3d"
#define DISKS "spheres"
#define USUAL_SCENE "unnamed"
#define QUICK_SCENE "spheres"
#define OF_SPHERES(...) __VA_ARGS__
#endif

/** The numbers of nodes of a wave in a message. */
#define NODES(wave)                                                                                \
    OF_SPHERES(.nz = (uint32_t)(wave).n[2], ).nx = (uint32_t)(wave).n[0],                          \
                                            .ny = (uint32_t)(wave).n[1]

/** The same, of one that is there. */
#define PUT_NODES(message, wave)                                                                   \
    do {                                                                                           \
        (message)->nx = (uint32_t)(wave).n[0];                                                     \
        (message)->ny = (uint32_t)(wave).n[1];                                                     \
        OF_SPHERES((message)->nz = (uint32_t)(wave).n[2];)                                         \
    } while (0)

/** As (1,0), of spheres (1,0,0). */
static inline const char *nodes_text(char text[NODES_SIZE], const hd_wave *wave)
{
    return nodes_write(text, HD_DIM == 3, (uint32_t)wave->n[0], (uint32_t)wave->n[1],
                       HD_DIM == 3 ? (uint32_t)wave->n[HD_DIM - 1] : 0);
}

#endif
