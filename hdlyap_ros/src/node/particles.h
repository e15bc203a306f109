/** The particles that this node can move: those of the core, and the rows of its program. */
#ifndef HDLYAP_NODE_PARTICLES_H
#define HDLYAP_NODE_PARTICLES_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/dynamics.h"

/** Adds a program's rows; called once, before any other function. */
void particles_bring(const hd_dynamics *const *rows, int count);
const hd_dynamics *const *particles_brought(int *count);

/** The row of number k, from 0; NULL after the last one. */
const hd_dynamics *particles_at(int k);

/** The scene of the usual particles, with the defaults of its parameters. */
hd_scene_def particles_usual(void);
/** Makes it a scene of the particles of this name; their own parameters get defaults, unless it was
 * such a scene before. False if there are none of this name. */
bool particles_choose(hd_scene_def *def, const char *name);

/** Says which particles the scene has: their own parameters become parameters of the node. */
void particles_are(const hd_dynamics *of);
const hd_dynamics *particles_now(void);

/** Writes all names, as "disks, spheres or chain". */
void particles_names(char *text, size_t size);

#endif
