/** The particles that this node can move: those of the core, and the rows of its program. */
#ifndef HDLYAP_NODE_PARTICLES_H
#define HDLYAP_NODE_PARTICLES_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/dynamics.h"

/** Returns false, with a line, if a program's row cannot be right. */
bool particles_check(const hd_dynamics *const *rows, int count, char *message, size_t size);
/** Adds a program's rows; called once, before the functions below. */
void particles_register(const hd_dynamics *const *rows, int count);
const hd_dynamics *const *particles_brought(int *count);

/** Row number k = 0, 1, ..; NULL after the last one. */
const hd_dynamics *particles_at(int k);

/** The scene of the usual particles, with the defaults of its parameters. */
hd_scene_def particles_usual(void);
/** Makes *def a scene of the particles of this name. The parameters that only they have get
 * defaults, unless it was such a scene before. Returns false if there are no particles of this
 * name. */
bool particles_choose(hd_scene_def *def, const char *name);

/** Says which particles the scene has: their own parameters become parameters of the node. */
void particles_are(const hd_dynamics *of);
const hd_dynamics *particles_now(void);

/** Writes all names, as "disks or spheres or chain". */
void particles_names(char *text, size_t size);

#endif
