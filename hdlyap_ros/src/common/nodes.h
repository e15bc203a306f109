/** Mode numbers of waves: two in the plane, three in space. */
#ifndef HDLYAP_NODES_H
#define HDLYAP_NODES_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/** True if two messages have the same nx, ny and nz. */
#define SAME_NODES(a, b) ((a)->nx == (b)->nx && (a)->ny == (b)->ny && (a)->nz == (b)->nz)

/** Copies the numbers of a wave of the core into a message. */
#define NODES(wave)                                                                                \
    .nx = (uint32_t)(wave).n[0], .ny = (uint32_t)(wave).n[1], .nz = (uint32_t)(wave).n[2]

/** Copies the numbers of one message into another. */
#define PUT_NODES(message, wave)                                                                   \
    ((message)->nx = (uint32_t)(wave).n[0], (message)->ny = (uint32_t)(wave).n[1],                 \
     (message)->nz = (uint32_t)(wave).n[2])

enum { NODES_SIZE = 40 };

/** Writes (1,0), or (1,0,0) in space and whenever nz is not 0. */
static inline const char *nodes_write(char text[NODES_SIZE], bool spheres, uint32_t nx, uint32_t ny,
                                      uint32_t nz)
{
    if (spheres || nz > 0)
        snprintf(text, NODES_SIZE, "(%u,%u,%u)", (unsigned)nx, (unsigned)ny, (unsigned)nz);
    else
        snprintf(text, NODES_SIZE, "(%u,%u)", (unsigned)nx, (unsigned)ny);
    return text;
}

#endif
