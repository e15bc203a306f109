/** Invariants of the pipeline, checked at every step of a build with HDLYAP_VERIFY, and by tests in
 * every build. A broken one is a bug of the core: HD_ASSERT, after one line on stderr with the
 * numbers. */
#ifndef HD_VERIFY_H
#define HD_VERIFY_H

#include "dynamics/trajectory.h"
#include "tangent/frame.h"
#include "tangent/ortho.h"

/** 1 where the build verifies; where it does not, the calls vanish. */
#ifdef HD_VERIFY
enum { HD_VERIFIES = 1 };
#else
enum { HD_VERIFIES = 0 };
#endif

/** No disks overlap; kinetic energy N, no momentum along periodic directions: up to a random walk
 * of roundings. */
void hd_verify_disks(const hd_trajectory *trajectory, const hd_scene_def *scene);

/** Order, disks, normals, approach: see hd_dynamics. */
void hd_verify_record(const hd_record *record, const hd_scene_def *scene);

enum { HD_VERIFY_PAIRS = 4 };

/** Symplectic products v_a^T J v_b and norms |v_a| |v_b| of some pairs of a frame's vectors. */
typedef struct hd_symplectic {
    double product[HD_VERIFY_PAIRS];
    double scale[HD_VERIFY_PAIRS];
} hd_symplectic;
hd_symplectic hd_verify_sample(const hd_frame *frame);

/** A replay of so many events has left the products as they were [T3]. */
void hd_verify_symplectic(const hd_frame *frame, const hd_symplectic *before, double events);

/** The vectors are as orthonormal as the step says, in its norm; all 4N of them keep the volume:
 * sum ln R_ll = 0. */
void hd_verify_ortho(hd_ortho *ortho, hd_frame *frame);

/** A frame that half of the vectors is carried of is isotropic. */
void hd_verify_isotropy(const hd_frame *frame);

#endif
