/** The scene: what a run is asked for, its particles, box, accuracy and observables. Units are
 * reduced: particles have mass 1; disks, spheres and the disks of a dumbbell have diameter sigma 1;
 * the kinetic energy per hard particle is 1. */
#ifndef HDLYAP_SCENE_H
#define HDLYAP_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/status.h"

HD_API_BEGIN

/** What moves: hard disks in the plane; hard spheres in space; dumbbells in the plane, each a rigid
 * pair of disks with mass 1; or soft particles in the plane or in space, which a smooth potential
 * moves in time steps. Comments that say 4N exponents mean disks; spheres and dumbbells have 6N. */
typedef enum hd_particles {
    HD_DISKS,
    HD_SPHERES,
    HD_DUMBBELLS,
    HD_SOFT_DISKS,
    HD_SOFT_SPHERES
} hd_particles;

/** Largest dimension of space, and length of arrays with an entry for each direction. */
enum { HD_DIMENSION_MAX = 3 };

/** The containers that can hold the particles, EACH(NAME, name, what it is). A scene gives the
 * name; hd_name_row in src/scene is its row (container.h). */
#define HD_CONTAINERS(EACH)                                                                        \
    EACH(RECTANGLE, rectangle, "edges along the axes, in space a box")                             \
    EACH(CIRCLE, circle, "disks whose rims touch its wall; it has no aspect and no boundaries")

#define HD_CONTAINER_VALUE(NAME, name, what) HD_##NAME,
typedef enum hd_container { HD_CONTAINERS(HD_CONTAINER_VALUE) HD_CONTAINERS_END } hd_container;
#undef HD_CONTAINER_VALUE

/** The two ends of a direction. HD_CURVED is the wall of a circle; no scene can ask for it. */
typedef enum hd_boundary { HD_PERIODIC, HD_REFLECTING, HD_CURVED } hd_boundary;

/** The stages of a run, in order: only particles move; the frame is carried, too; averages are
 * taken; the end. */
typedef enum hd_stage { HD_EQUILIBRATING, HD_WARMING_UP, HD_AVERAGING, HD_FINISHED } hd_stage;

/** Values of hd_scene_def.exponents that are not a number of exponents. */
enum {
    HD_EXPONENTS_NONE = 0,
    HD_EXPONENTS_POSITIVE = -1,
    HD_EXPONENTS_ALL = -2,            /**< half are carried, the other half follows [T18] */
    HD_EXPONENTS_ALL_INDEPENDENT = -3 /**< all are carried */
};

/** The value of hd_scene_def.warmup that is not a time. */
enum { HD_WARMUP_AUTO = -1 };

/** Bits of hd_scene_def.observe: observables that are computed beyond the exponents, from the rows
 * of observables.inc. An observable brings those it needs: phases, fields, hydro and structure need
 * steps, and steps need modes. gas needs no exponents. */
enum {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) HD_OBSERVE_##NAME = (bit),
#include "hdlyap/observables.inc"
    HD_OBSERVE_ALL = 0
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) | (bit)
#include "hdlyap/observables.inc"
    ,
    /** All observables that need waves. */
    HD_OBSERVE_WAVES = 0
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) | (of_waves) * (bit)
#include "hdlyap/observables.inc"
};

/** How the data that covariant vectors need for the way back are kept. */
typedef enum hd_storage {
    HD_STORAGE_MEMORY,   /**< all of them in memory */
    HD_STORAGE_RECOMPUTE /**< most of them are computed again from some frames and the record */
} hd_storage;

/** A text of the user in one line, "" for none; the rest of the array is 0. */
enum { HD_TEXT = 256 };
typedef struct hd_text {
    char line[HD_TEXT];
} hd_text;

/** A dynamics of one's own, beside hd_particles: see hdlyap/dynamics.h. */
typedef struct hd_dynamics hd_dynamics;

/** Value of a parameter that only one dynamics has: `whole` for an int or a word, `real` for a
 * double, as the row of the parameter says. */
enum { HD_OWN_MAX = 16 };
typedef union hd_own {
    double real;
    int whole;
} hd_own;
/** hd_parameter.offset of parameter k of a dynamics. */
#define HD_OWN(k) (offsetof(hd_scene_def, own) + (k) * sizeof(hd_own))

/** The definition of a scene. parameters.inc has default, range, unit and meaning of each member,
 * and declares those that are plain numbers. */
typedef struct hd_scene_def {
    hd_particles particles;
    hd_container container;
    hd_boundary boundary[3]; /**< boundary_x, _y, _z of a box */
    uint64_t seed;
    int exponents;           /**< number of the largest exponents, or one of HD_EXPONENTS_* */
    double warmup;           /**< HD_WARMUP_AUTO or a time, see hd_scene_warmup [time units] */
    double interval;         /**< 0: auto [time units] */
    double phase_interval;   /**< 0: auto [time units] */
    double fluctuation_time; /**< 0: auto [time units] */
    unsigned observe;        /**< a set of HD_OBSERVE_*; 0: none */
    hd_storage covariant_storage;
    hd_text target;              /**< errors at which the run ends, see hd_target_check */
    const hd_dynamics *dynamics; /**< a dynamics of one's own; NULL: that of `particles` */
    hd_own own[HD_OWN_MAX];      /**< parameters that only the dynamics has */
#define HD_INT(name, ...) int name;
#define HD_REAL(name, ...) double name;
#define HD_OTHER(...)
#include "hdlyap/parameters.inc"
} hd_scene_def;

/** The default scene: 780 disks in a periodic box, density 0.8, aspect 0.867. */
hd_scene_def hd_scene_def_default(void);
/** The default scene with another dynamics, one's own or one of the core, and the defaults of its
 * parameters. It is a bug of the caller if the row lacks something that it must have. */
hd_scene_def hd_scene_def_of(const hd_dynamics *dynamics);

/** HD_OK, or HD_REFUSED with one line in `message`: the parameter, its value and what is allowed.
 * It does not check the target (hd_target_check). */
HD_MUST_CHECK hd_status hd_scene_check(const hd_scene_def *def, char *message, size_t size);

/** Dimension of space: number of its directions. */
int hd_scene_dimension(const hd_scene_def *def);
/** Number of coordinates of a particle: components of its dq, and of its dp. */
int hd_scene_coordinates(const hd_scene_def *def);
/** Moment of inertia of a particle; 0 if particles do not turn [sigma^2]. */
double hd_scene_inertia(const hd_scene_def *def);
/** Fraction of the box that particles cover; NaN if they have no size. */
double hd_scene_packing(const hd_scene_def *def);

/** Writes the edges of the box, one for each direction [sigma]. In the plane Lx = sqrt(N / (rho A))
 * and Ly = A Lx with A = aspect; in space Lx = cbrt(N / (rho A B)), Ly = A Lx and Lz = B Lx with B
 * = aspect_z; for a circle the edges 2 R of the square around it, R = sqrt(N / (pi rho)). */
void hd_scene_box(const hd_scene_def *def, double *box);

/** Writes the size of the container in words: "20 x 30", "a circle of radius 12.5". */
void hd_scene_describe(const hd_scene_def *def, char *text, size_t size);

/** The word for the ends of direction d: periodic, reflecting or curved; "" for z in the plane. */
const char *hd_scene_boundary_word(const hd_scene_def *def, int d);

/** Writes the HD_OUTLINE corners of a curved wall in order [sigma], and returns their number; 0 for
 * a box, which is described by its edges. */
enum { HD_OUTLINE = 128 };
int hd_scene_outline(const hd_scene_def *def, double *x, double *y);

/** Parts of the null space [T9]: vectors that are uniform along x, y, and in space z. They belong
 * to periodic directions; in a circle HD_NULL_X is the rotation about the centre. The part behind
 * them, of number hd_scene_dimension(def), contains (p, 0) and (0, p), or the flow (p, F) of soft
 * particles. */
enum { HD_NULL_X, HD_NULL_Y, HD_NULL_Z };

/** Duration of the warm-up, as given or chosen [T12] [time units]. */
double hd_scene_warmup(const hd_scene_def *def);

/** Numbers of exponents of a scene. */
typedef struct hd_counts {
    int zero;     /**< exponents that vanish: 2, and 2 for each periodic direction; 4 in a circle */
    int positive; /**< positive exponents: half of the others */
    int vectors;  /**< exponents that are computed, each with a vector: 0 .. all */
    int carried;  /**< vectors that are carried for them: half if all are computed by pairs [T18] */
} hd_counts;
hd_counts hd_scene_counts(const hd_scene_def *def);

HD_API_END
#endif
