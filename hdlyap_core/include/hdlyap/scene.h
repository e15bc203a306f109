/** The scene: everything that defines a run: particles, box, stages, accuracy, observables. Units
 * are reduced. A particle has mass 1; disks, spheres and the two disks of a dumbbell have the
 * diameter sigma = 1 (those of a second kind are said by hd_scene_kinds), and the unit of energy is
 * the mean kinetic energy of a particle; for soft particles sigma and the unit of energy, epsilon,
 * are those of the potential. The time unit is sigma sqrt(mass / unit of energy). N is the number
 * of particles, n that of vectors. Tags as [T18] are those of equations in THEORY.md. */
#ifndef HDLYAP_SCENE_H
#define HDLYAP_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hdlyap/status.h"

HD_API_BEGIN

/** What can move: EACH(NAME, name, what it is) for the particles that the core has. A scene holds
 * HD_NAME, a user writes the name, and the row of the dynamics is hd_name_row. There are 4 N
 * exponents for particles with 2 coordinates (disks, soft disks) and 6 N for those with 3. */
#define HD_PARTICLES_ALL(EACH)                                                                     \
    EACH(DISKS, disks, "hard disks in the plane")                                                  \
    EACH(SPHERES, spheres, "hard spheres in space")                                                \
    EACH(DUMBBELLS, dumbbells, "rigid pairs of hard disks in the plane, of mass 1 together")       \
    EACH(SOFT_DISKS, soft_disks, "in the plane, moved by a smooth potential in time steps")        \
    EACH(SOFT_SPHERES, soft_spheres, "as soft_disks, but in space")

#define HD_PARTICLES_VALUE(NAME, name, what) HD_##NAME,
typedef enum hd_particles { HD_PARTICLES_ALL(HD_PARTICLES_VALUE) HD_PARTICLES_END } hd_particles;
#undef HD_PARTICLES_VALUE

/** Largest dimension of space, which is the length of arrays with an element for each direction. */
enum { HD_DIMENSION_MAX = 3 };

/** The containers that can hold particles: EACH(NAME, name, what it is) for each. A scene holds
 * HD_NAME, a user writes the name. */
#define HD_CONTAINERS(EACH)                                                                        \
    EACH(RECTANGLE, rectangle, "edges along the axes, in space a box")                             \
    EACH(CIRCLE, circle, "for disks, whose rims touch its wall; no aspect, no boundaries")

#define HD_CONTAINER_VALUE(NAME, name, what) HD_##NAME,
typedef enum hd_container { HD_CONTAINERS(HD_CONTAINER_VALUE) HD_CONTAINERS_END } hd_container;
#undef HD_CONTAINER_VALUE

/** What the two ends of a direction can be: EACH(NAME, name, what it is) for each. A scene holds
 * HD_NAME, a user writes the name. */
#define HD_BOUNDARIES(EACH)                                                                        \
    EACH(PERIODIC, periodic, "the box repeats")                                                    \
    EACH(REFLECTING, reflecting, "walls, which particles touch with their rims")                   \
    EACH(SHEARING, shearing,                                                                       \
         "walls that also turn the velocity of a disk, at the upper end towards the other axis, "  \
         "at the lower one against it; the other direction must be periodic")

/** HD_CURVED is the wall of a circle, which follows from the container; a scene must not ask for
 * it. */
#define HD_BOUNDARY_VALUE(NAME, name, what) HD_##NAME,
typedef enum hd_boundary {
    HD_BOUNDARIES(HD_BOUNDARY_VALUE) HD_BOUNDARIES_END,
    HD_CURVED = HD_BOUNDARIES_END
} hd_boundary;
#undef HD_BOUNDARY_VALUE

/** The stages of a run in their order: only particles move; the frame is carried, too; averages are
 * taken; the run has ended. */
typedef enum hd_stage { HD_EQUILIBRATING, HD_WARMING_UP, HD_AVERAGING, HD_FINISHED } hd_stage;

/** Values of hd_scene_def.exponents that are not a number of exponents: none; the positive ones;
 * all. */
enum {
    HD_EXPONENTS_NONE = 0,
    HD_EXPONENTS_POSITIVE = -1,
    HD_EXPONENTS_ALL = -2,            /**< all, from half of the vectors [T18] */
    HD_EXPONENTS_ALL_INDEPENDENT = -3 /**< all, from all vectors */
};

/** The value of hd_scene_def.warmup that is not a time. */
enum { HD_WARMUP_AUTO = -1 };

/** Bits of hd_scene_def.observe: the observables, computed beyond the exponents, as rows of
 * observables.inc. An observable brings others along: modes and steps bring each other, and phases,
 * fields, hydro and structure bring both. gas and averages need no exponents. */
enum {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) HD_OBSERVE_##NAME = (bit),
#include "hdlyap/observables.inc"
    /** All that there are. */
    HD_OBSERVE_ANY = 0
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) | (bit)
#include "hdlyap/observables.inc"
    ,
    /** All that disks have, and all but hydro of other particles of the core: what rows of a
     * program's own can have is said by hd_observe_of. */
    HD_OBSERVE_ALL = HD_OBSERVE_ANY & ~HD_OBSERVE_AVERAGES,
    /** All observables that need waves. */
    HD_OBSERVE_WAVES = 0
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) | (of_waves) * (bit)
#include "hdlyap/observables.inc"
};

/** A text that a user gives, one line, "" for none. The bytes behind its end are 0. */
enum { HD_TEXT = 256 };
typedef struct hd_text {
    char line[HD_TEXT];
} hd_text;

/** A dynamics: the row of facts and functions of particles, see hdlyap/dynamics.h. */
typedef struct hd_dynamics hd_dynamics;

/** Value of a parameter that only one dynamics has: `whole` for an int or a word, `real` for a
 * double, as hd_parameter.kind says. */
enum { HD_OWN_MAX = 16 };
typedef union hd_own {
    double real;
    int whole;
} hd_own;
/** The hd_parameter.offset of the own parameter number k = 0 .. HD_OWN_MAX - 1 of a dynamics. */
#define HD_OWN(k) (offsetof(hd_scene_def, own) + (k) * sizeof(hd_own))

/** The definition of a scene. parameters.inc has default, range, unit and meaning of each member,
 * and declares the members that are plain numbers. Begin with hd_scene_def_default or
 * hd_scene_def_of, then set members. */
typedef struct hd_scene_def {
    hd_particles particles;
    hd_container container;
    hd_boundary boundary[3]; /**< what the ends of x, y and z are, of a rectangle or a box */
    uint64_t seed;
    int exponents;   /**< number of the largest exponents, or one of HD_EXPONENTS_* */
    double warmup;   /**< HD_WARMUP_AUTO or a time, see hd_scene_warmup [time units] */
    double interval; /**< longest time between two orthonormalisations; 0 means auto [time units] */
    double phase_interval;   /**< longest time between two samples of phases; 0 means auto [time
                                units] */
    double fluctuation_time; /**< shortest time over which growth is summed; 0 means auto [time
                                units] */
    unsigned observe; /**< the observables that are asked for, a set of HD_OBSERVE_*; 0: none */
    hd_text target;   /**< quantities and their errors at which the run ends, see hd_target_check */
    /** A dynamics of the program's own; NULL means that of `particles`. */
    const hd_dynamics *dynamics;
    hd_own own[HD_OWN_MAX]; /**< values of the parameters that only this dynamics has; own[k] is at
                               the offset HD_OWN(k) */
#define HD_INT(name, ...) int name;
#define HD_REAL(name, ...) double name;
#define HD_OTHER(...)
#include "hdlyap/parameters.inc"
} hd_scene_def;

/** Returns the scene with all defaults: 780 disks in a periodic box, density 0.8, aspect 0.867. */
hd_scene_def hd_scene_def_default(void);
/** Returns the default scene for a dynamics, of the core or of the program's own, with the defaults
 * of its parameters; exponents = hd_scene_exponents_usual. What is wrong with a row is said
 * by hd_scene_check, and by whatever makes a run or a trajectory; see hd_dynamics_check. */
hd_scene_def hd_scene_def_of(const hd_dynamics *dynamics);

/** Returns HD_OK if the scene can be run; otherwise HD_REFUSED with one line in message[size],
 * unless that is NULL: the parameter, its value and what is allowed; or HD_NO_MEMORY. It does not
 * check the target: see hd_target_check. The functions below, and others that take "a checked
 * scene", may only be called after it has returned HD_OK. */
HD_MUST_CHECK hd_status hd_scene_check(const hd_scene_def *def, char *message, size_t size);

/** Dimension of space, 2 or 3; 0 if particles have no positions in a box. */
int hd_scene_dimension(const hd_scene_def *def);
/** Number of coordinates of a particle, which is that of the components of its dq, and of its dp.
 */
int hd_scene_coordinates(const hd_scene_def *def);
/** Moment of inertia of a particle that turns [sigma^2]; 0 if particles do not turn. */
double hd_scene_inertia(const hd_scene_def *def);
/** Most disks of a particle. */
enum { HD_SITES_MAX = 8 };
/** Writes the places of the disks of a particle along its arm to site[HD_SITES_MAX]
 * (hd_dynamics.sites) [sigma], and returns their number. */
int hd_scene_sites(const hd_scene_def *def, double *site);
/** Fraction of the container that particles fill; NaN if they have no size. */
double hd_scene_packing(const hd_scene_def *def);

/** Most kinds of particles of a scene. */
enum { HD_KINDS_MAX = 2 };
/** A kind of particles: those that have one size and one mass. */
typedef struct hd_kind {
    int number;      /**< particles of this kind */
    double diameter; /**< [sigma] */
    double mass;     /**< [mass of a particle of the first kind]; that of the second is second_mass
                          to 1e-13 */
} hd_kind;
/** Writes the kinds of particles to kind[HD_KINDS_MAX], and returns their number. The particles of
 * the first kind come first. Kinds without particles are left out. Usually all particles are alike,
 * of mass 1 and diameter 1; all may be of the second kind, with its mass and diameter. It may be
 * called with any scene. */
int hd_scene_kinds(const hd_scene_def *def, hd_kind *kind);
/** The root of the mass of a particle, 0 .. N - 1, which is 1 unless there is a second kind. A
 * momentum of hd_trajectory_state is the true momentum over it; dq of a tangent vector is the
 * displacement times it, dp the change of the true momentum over it [T26]. */
double hd_scene_root_mass(const hd_scene_def *def, int particle);

/** Writes the edges of the box, one for each direction [sigma]. In the plane Lx = sqrt(N / (rho A))
 * and Ly = A Lx, with density rho and A = aspect; in space Lx = cbrt(N / (rho A B)), Ly = A Lx and
 * Lz = B Lx, with B = aspect_z. For a circle both edges are 2 R, with R = sqrt(N / (pi rho)). */
void hd_scene_box(const hd_scene_def *def, double *box);

/** Writes the container in words to text[size], as "20 x 30" or "a circle of radius 12.5" [sigma].
 */
void hd_scene_describe(const hd_scene_def *def, char *text, size_t size);

/** The word for the ends of direction d = 0, 1, 2 (x, y, z): a name of HD_BOUNDARIES, or curved; ""
 * for z in the plane. */
const char *hd_scene_boundary_word(const hd_scene_def *def, int d);

/** Number of corners of the polygon that hd_scene_outline writes. */
enum { HD_OUTLINE = 128 };
/** Writes the corners of a polygon along a curved wall to x[HD_OUTLINE] and y[HD_OUTLINE], in order
 * [sigma], and returns HD_OUTLINE. For a box, which its edges describe, it writes nothing and
 * returns 0. */
int hd_scene_outline(const hd_scene_def *def, double *x, double *y);

/** Parts of the null space [T9]: tangent vectors that are uniform along x, y and in space z, one
 * part for each periodic direction. In a circle HD_NULL_X is the rotation about the centre. The
 * part behind them, number hd_scene_dimension, contains (dq, dp) = (p, 0) and (0, p); for soft
 * particles it is the flow (p, F), with the forces F. */
enum { HD_NULL_X, HD_NULL_Y, HD_NULL_Z };

/** Duration of the warm-up, as the scene gives it, or as chosen for HD_WARMUP_AUTO [T12] [time
 * units]. */
double hd_scene_warmup(const hd_scene_def *def);

/** True if the tangent maps of a scene are symplectic: those of its particles
 * (hd_dynamics.symplectic) and those of its walls. */
bool hd_scene_symplectic(const hd_scene_def *def);
/** The exponents that a scene asks for unless its user says otherwise: HD_EXPONENTS_POSITIVE, or
 * HD_EXPONENTS_ALL if maps are not symplectic. */
int hd_scene_exponents_usual(const hd_scene_def *def);

/** Numbers of exponents of a scene. */
typedef struct hd_counts {
    int zero; /**< exponents that vanish (hd_dynamics.zero_exponents): for particles of the core 2,
                 and 2 for each periodic direction, 1 if walls drag along it; 4 in a circle */
    int positive; /**< positive exponents, half of those that do not vanish; fewer may be positive
                     if maps are not symplectic */
    int vectors;  /**< exponents that are computed, each with a vector */
    int carried;  /**< vectors that are carried for them: half of these with HD_EXPONENTS_ALL and
                     symplectic maps [T18], otherwise all */
} hd_counts;
/** Returns the numbers of exponents of a scene. */
hd_counts hd_scene_counts(const hd_scene_def *def);

HD_API_END
#endif
