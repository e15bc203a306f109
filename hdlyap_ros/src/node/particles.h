/** What this node can move: what the core brings, and the rows of its program. */
#ifndef HDLYAP_NODE_PARTICLES_H
#define HDLYAP_NODE_PARTICLES_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/dynamics.h"

/** Once, before anything else. */
void particles_bring(const hd_dynamics *const *rows, int count);
const hd_dynamics *const *particles_brought(int *count);

/** Each of them, by its number from 0; NULL behind the last. */
const hd_dynamics *particles_at(int k);

/** A scene of what moves if nobody says, with the defaults of its parameters. */
hd_scene_def particles_usual(void);
/** The scene is of the particles of this name, whose own parameters have their defaults unless it
 * was before. False: there are none. */
bool particles_choose(hd_scene_def *def, const char *name);

/** Those of the scene that is read: its row's own parameters are parameters of the node. */
void particles_are(const hd_dynamics *of);
const hd_dynamics *particles_now(void);

/** "disks, spheres or chain". */
void particles_names(char *text, size_t size);

#endif
