/** What is asked for: the box, the disks and how accurately the exponents are wanted.
 * Reduced units throughout: disk mass 1, diameter sigma = 1, kinetic energy per disk 1. */
#ifndef HDLYAP_SCENE_H
#define HDLYAP_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/status.h"

HD_API_BEGIN

/** What moves: hard disks in the plane, or hard spheres in space, which are called disks as well;
 * or rigid pairs of disks, two of diameter 1 and mass 1 together; or what pulls and pushes each
 * other smoothly, in the plane and in space, and moves in steps. Where comments say 4N and 2N,
 * there are 6N and 3N of spheres. */
typedef enum hd_particles {
    HD_DISKS,
    HD_SPHERES,
    HD_DUMBBELLS,
    HD_SOFT_DISKS,
    HD_SOFT_SPHERES
} hd_particles;

/** Of the spaces that particles move in; arrays with one entry for each direction have room for so
 * many. */
enum { HD_DIMENSION_MAX = 3 };

/** What can hold the disks, EACH(NAME, name, what it is): a scene says its name, and hd_name_row is
 * its row in src/scene (container.h). */
#define HD_CONTAINERS(EACH)                                                                        \
    EACH(RECTANGLE, rectangle, "edges along the axes, in space a box")                           \
    EACH(CIRCLE, circle, "disks whose rims touch its wall; it has no aspect and no boundaries")

#define HD_CONTAINER_VALUE(NAME, name, what) HD_##NAME,
typedef enum hd_container { HD_CONTAINERS(HD_CONTAINER_VALUE) HD_CONTAINERS_END } hd_container;
#undef HD_CONTAINER_VALUE

/** Of a direction; HD_CURVED behind a curved wall, where no scene can ask for another one. */
typedef enum hd_boundary { HD_PERIODIC, HD_REFLECTING, HD_CURVED } hd_boundary;

/** Stages of a run, one after the other: disks alone; with the frame; averages are taken; done. */
typedef enum hd_stage { HD_EQUILIBRATING, HD_WARMING_UP, HD_AVERAGING, HD_FINISHED } hd_stage;

/** Values of hd_scene_def.exponents that are not a plain number. */
enum {
    HD_EXPONENTS_NONE = 0,
    HD_EXPONENTS_POSITIVE = -1,
    HD_EXPONENTS_ALL = -2,            /**< half of them carried, the other one follows [T18] */
    HD_EXPONENTS_ALL_INDEPENDENT = -3 /**< each carried by itself */
};

/** The value of hd_scene_def.warmup that is not a plain number. */
enum { HD_WARMUP_AUTO = -1 };

/** hd_scene_def.observe: what is computed beyond the exponents, by the rows of observables.inc.
 * What one is made from comes with it: phases, fields, hydro and structure need steps, and steps
 * the modes. Covariant vectors need neither, the gas no exponents. */
enum {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) HD_OBSERVE_##NAME = (bit),
#include "hdlyap/observables.inc"
    HD_OBSERVE_ALL = 0
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) | (bit)
#include "hdlyap/observables.inc"
    ,
    /** Those that look at wave vectors */
    HD_OBSERVE_WAVES = 0
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) | (of_waves) * (bit)
#include "hdlyap/observables.inc"
};

/** Where the triangles that covariant vectors need wait for the way back. */
typedef enum hd_storage {
    HD_STORAGE_MEMORY,
    HD_STORAGE_RECOMPUTE /**< they are computed again, from some frames and the events */
} hd_storage;

/** What a user says in words, in one line, "" for nothing; zeros behind it. */
enum { HD_TEXT = 256 };
typedef struct hd_text {
    char line[HD_TEXT];
} hd_text;

/** What moves otherwise than hd_particles: see hdlyap/dynamics.h. */
typedef struct hd_dynamics hd_dynamics;

/** Values of the parameters of such a dynamics, each as its row says: an int or a word `whole`, a
 * double `real`. */
enum { HD_OWN_MAX = 16 };
typedef union hd_own {
    double real;
    int whole;
} hd_own;
/** hd_parameter.offset of number k of them. */
#define HD_OWN(k) (offsetof(hd_scene_def, own) + (k) * sizeof(hd_own))

/** Each parameter's default, range, unit and text stands in parameters.inc, which declares those
 * that are plain numbers. */
typedef struct hd_scene_def {
    hd_particles particles;
    hd_container container;
    hd_boundary boundary[3]; /**< boundary_x, _y, _z, the last of spheres; of a box alone */
    uint64_t seed;
    int exponents;         /**< number of leading ones, 1 .. all, or one of HD_EXPONENTS_* */
    double warmup;         /**< HD_WARMUP_AUTO, see hd_scene_warmup [time units] */
    double interval;       /**< 0 = auto [time units] */
    double phase_interval; /**< the same */
    unsigned observe;      /**< a set of HD_OBSERVE_*, 0 = none */
    hd_storage covariant_storage;
    hd_text target;              /**< what ends the run, see hd_target_check */
    const hd_dynamics *dynamics; /**< NULL: that of the particles */
    hd_own own[HD_OWN_MAX];
#define HD_INT(name, ...) int name;
#define HD_REAL(name, ...) double name;
#define HD_OTHER(...)
#include "hdlyap/parameters.inc"
} hd_scene_def;

/** The paper's periodic scene: 780 disks, density 0.8, aspect 0.867. */
hd_scene_def hd_scene_def_default(void);
/** The same of another dynamics, or of a row of the core, with the defaults of its own parameters.
 * A row that lacks what it must have is a bug of the caller. */
hd_scene_def hd_scene_def_of(const hd_dynamics *dynamics);

/** HD_OK, or HD_REFUSED with one line in `message`: the parameter, its value, what is allowed; of a
 * target hd_target_check says it. */
HD_MUST_CHECK hd_status hd_scene_check(const hd_scene_def *def, char *message, size_t size);

/** Of the space that the particles move in: directions. */
int hd_scene_dimension(const hd_scene_def *def);
/** Of one particle: components of its dq, and of its dp. */
int hd_scene_coordinates(const hd_scene_def *def);
/** Moment of inertia of a particle that turns; 0 of what does not [sigma^2]. */
double hd_scene_inertia(const hd_scene_def *def);
/** Part of the box that the particles cover; NaN where they do not say. */
double hd_scene_packing(const hd_scene_def *def);

/** Box edges, one for each direction [sigma]: Lx = sqrt(N / (rho A)), Ly = A Lx, with A = aspect;
 * of spheres Lx = cbrt(N / (rho A B)), Lz = B Lx, with B = aspect_z; of the square around a circle
 * 2 R, with R = sqrt(N / (pi rho)). */
void hd_scene_box(const hd_scene_def *def, double *box);

/** The container and its size in words: "20 x 30", "a circle of radius 12.5". */
void hd_scene_describe(const hd_scene_def *def, char *text, size_t size);

/** What the ends of direction d are, as in a scene: periodic or reflecting, or curved; "" of z of
 * disks. */
const char *hd_scene_boundary_word(const hd_scene_def *def, int d);

/** Writes HD_OUTLINE corners of a curved container's outline, in their order, and returns their
 * number; 0 of a box, whose edges it is [sigma]. */
enum { HD_OUTLINE = 128 };
int hd_scene_outline(const hd_scene_def *def, double *x, double *y);

/** Directions of the null space [T9]: uniform along x, along y, of spheres along z (where
 * periodic), and behind them, as number hd_scene_dimension(def), the momenta. In a circle HD_NULL_X
 * is a rotation about the centre. */
enum { HD_NULL_X, HD_NULL_Y, HD_NULL_Z };

/** Time with the frame before the averaging, as asked for or chosen [T12]. */
double hd_scene_warmup(const hd_scene_def *def);

/** Numbers of exponents. */
typedef struct hd_counts {
    int zero;     /**< that vanish: 2, and 2 for each periodic direction; 4 in a circle */
    int positive; /**< half of all but these */
    int vectors;  /**< that come out, with their tangent vectors: 0 .. all, 2 for each coordinate */
    int carried;  /**< tangent vectors that are carried for them: half for all of them [T18] */
} hd_counts;
hd_counts hd_scene_counts(const hd_scene_def *def);

HD_API_END
#endif
