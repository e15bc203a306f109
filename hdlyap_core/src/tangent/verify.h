/** Invariants of the pipeline, which a build with HDLYAP_VERIFY checks at every step, and tests
 * check in every build. A broken one is a bug of the core: HD_ASSERT, after one line on stderr with
 * the numbers. */
#ifndef HD_VERIFY_H
#define HD_VERIFY_H

#include "dynamics/trajectory.h"
#include "tangent/frame.h"
#include "tangent/ortho.h"

/** 1 if the build verifies; otherwise the calls compile to nothing. */
#ifdef HD_VERIFY
enum { HD_VERIFIES = 1 };
#else
enum { HD_VERIFIES = 0 };
#endif

/** Asserts, up to a random walk of roundings, that no particles overlap, that the kinetic energy is
 * N, and that there is no momentum along periodic directions. */
void hd_verify_trajectory(const hd_trajectory *trajectory, const hd_scene_def *scene);

/** Asserts that the record's entries are in order and possible; see hd_dynamics. */
void hd_verify_record(const hd_record *record, const hd_scene_def *scene);

enum { HD_VERIFY_PAIRS = 4 };

/** Symplectic products v_a^T J v_b and norms |v_a| |v_b| of some pairs of a frame's vectors. */
typedef struct hd_symplectic {
    double product[HD_VERIFY_PAIRS];
    double scale[HD_VERIFY_PAIRS];
} hd_symplectic;
hd_symplectic hd_verify_sample(const hd_frame *frame);

/** Asserts that a replay of this many events has left the products as they were [T3]. */
void hd_verify_symplectic(const hd_frame *frame, const hd_symplectic *before, double events);

/** Asserts that the vectors are as orthonormal, in the step's norm, as the step says; and that all
 * 4N of them keep the volume, sum ln R_ll = 0. */
void hd_verify_ortho(hd_ortho *ortho, hd_frame *frame);

/** Asserts that a frame of which only half of the vectors is carried is isotropic. */
void hd_verify_isotropy(const hd_frame *frame);

#endif
