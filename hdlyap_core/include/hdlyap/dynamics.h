/** A dynamics: a row of facts and functions that says how particles move. The core has rows for
 * disks, spheres, dumbbells and soft particles. A program gives a row of its own in
 * hd_scene_def.dynamics; its runs have exponents with errors, Gram-Schmidt and covariant vectors,
 * checkpoints and ranks.
 *
 * Each particle has `coordinates` q, scaled so that its kinetic energy is the sum of p^2 / 2. The
 * functions that move particles write a record (hdlyap/record.h), and tangent vectors are carried
 * by that record alone. A row and its parameters must last as long as its runs. One thread of a run
 * at a time calls the functions of a row; several call `carry` at once. */
#ifndef HDLYAP_DYNAMICS_H
#define HDLYAP_DYNAMICS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hdlyap/archive.h"
#include "hdlyap/parameters.h"

HD_API_BEGIN

/** The record of what happens, see hdlyap/record.h. */
typedef struct hd_record hd_record;

/** Numbers of collisions so far, and what follows from them. */
typedef struct hd_told {
    uint64_t collisions, wall_events; /**< collisions of pairs; with walls */
    /** Virial of the pair collisions in each direction: sum of |p.n| n_d^2 [sigma momentum] [T19].
     */
    double virial[HD_DIMENSION_MAX];
    double expected; /**< pair collisions per time unit by Enskog's theory [T2] */
} hd_told;

/** Integrals over time so far for particles with a potential [T19]. */
typedef struct hd_summed {
    double time; /**< time that they cover: that of whole time steps [time units] */
    double kinetic[HD_DIMENSION_MAX]; /**< integral of the sum of p_d^2 in each direction */
    double virial[HD_DIMENSION_MAX];  /**< integral of the sum of r_d F_d over pairs, in each
                                         direction */
    double potential;                 /**< integral of the potential energy of all particles */
} hd_summed;

/** How accurate the present state is. */
typedef struct hd_examined {
    double energy_error; /**< relative error of the energy, from the row's energy_error */
    /** Bound on the relative error of the energy from rounding: each event so far changes the
     * energy of its particles by some eps, and these changes add up as a random walk. Observed
     * errors are about 0.01 of it. */
    double energy_rounding;
    double momentum[HD_DIMENSION_MAX]; /**< total momentum */
    double angular_momentum; /**< total, about the middle of the box; a circle conserves it */
    double overlap; /**< deepest overlap of a pair now: max(0, 1 - distance), with images [sigma] */
    /** Bound on an overlap from rounding: of positions, which are as large as the box, and of times
     * that are counted from one moment [sigma]. */
    double overlap_rounding;
    /** Deepest overlap that is not a fault, HD_OVERLAP: 1e-9, or overlap_rounding if that is
     * larger, as in boxes above about 3e5 sigma: 4e-6 in a box of 1e9 [sigma]. */
    double overlap_max;
} hd_examined;

/** What kinetic theory says of a dynamics, to some percent; only rows of the core have it. */
typedef struct hd_fluid hd_fluid;

/** A part of a record, which `carry` gets if the row has no maps of its own. */
typedef struct hd_passage {
    const void *entry; /**< entries, [count], each of the row's size */
    size_t count;
    double begin, end; /**< times since the start of the record [time units] */
    int particles;
} hd_passage;

enum {
    HD_PARTICLES = 32,        /**< size of a name */
    HD_COORDINATES_MAX = 1000 /**< of a particle, so that an int can count those of all */
};

/** A row. Members that may be left out say so; they are then 0, false or NULL. */
struct hd_dynamics {
    const char *particles; /**< its name, a plural of at most 31 characters, not of the core's */
    int dimension;         /**< dimension of the box, 2 or 3; 0: there is no box */
    int coordinates; /**< coordinates of a particle: components of its dq, and of its dp; at most
                          HD_COORDINATES_MAX. The first `dimension` of them are its position */
    size_t entry; /**< bytes of an entry of the record, a multiple of 8; the first 8 are a double */
    /** Tangent maps are symplectic: exponents come in pairs, and half of the vectors give all
     * [T18]. If false, exponents = all carries all vectors. */
    bool symplectic;
    /** No map takes an unstable vector to dq = 0, as with hard bodies, which only disperse. The
     * frame may then be orthonormalised in dq alone, which is faster [T6]. May be left out. */
    bool dispersing;
    /** Scaling all momenta only changes the pace, as with hard bodies: (p, 0) and (0, p) are null
     * vectors, and the null space is orthogonal to all other vectors [T9]. May be left out. */
    bool paces;

    const hd_parameter *parameter; /**< its own parameters, [parameters]: see HD_OWN */
    int parameters;                /**< their number, at most HD_OWN_MAX */
    const hd_fluid *fluid;         /**< may be left out */

    /* ---- scene */
    /** Checks whether parameters, each of which is in its range, fit together. HD_REFUSED with one
     * line in `message`, unless that is NULL: the parameter, its value, what is allowed. May be
     * left out. */
    hd_status (*check)(const hd_scene_def *scene, char *message, size_t size);
    /** Number of exponents that vanish; if left out, none. */
    int (*zeros)(const hd_scene_def *scene);
    /** Rough number of record entries per time unit, by which records get their memory. */
    double (*entries)(const hd_scene_def *scene);
    /** Expected number of pair collisions per time unit; without collisions N / 2 divided by the
     * time in which tangent vectors grow by about e. In units of N / 2 divided by this rate, the
     * first interval is 2 long, the longest 60, and blocks for errors at least 8. */
    double (*rate)(const hd_scene_def *scene);
    /** Length of a time step, if particles move in steps [time units]. May be left out. */
    double (*step)(const hd_scene_def *scene);
    /** Approximate power of the time step with which zero exponents that no null vector keeps at 0
     * split. If left out, they do not. */
    double (*split)(const hd_scene_def *scene);
    /** Time that a disturbance takes through the whole system; blocks of averages are not shorter
     * [time units]. May be left out. */
    double (*crossing)(const hd_scene_def *scene);
    /** Writes the null vectors that are known exactly at this state, those that the flow keeps or
     * turns into each other: column[..][particle][2 coordinates], not normalised. Returns their
     * number, at most `zeros`. If left out, none is known. */
    int (*null)(const hd_scene_def *scene, const double *q, const double *p, double *column);

    /** Moment of inertia of a particle that turns in the plane [sigma^2]: behind its position it
     * has one more coordinate, sqrt(inertia) times an angle. If left out, particles do not turn. */
    double (*inertia)(const hd_scene_def *scene);
    /** Area or volume of a particle [sigma^d]. If left out, it is not known. */
    double (*size)(const hd_scene_def *scene);

    /* ---- particles */
    /** Makes the state of a checked scene at time 0. HD_NO_MEMORY, and *state is NULL. */
    hd_status (*create)(void **state, const hd_scene_def *scene);
    /** Makes a given state, for tests: q and p are [particle][coordinates]. May be left out. */
    hd_status (*create_from)(void **state, const hd_scene_def *scene, const double *q,
                             const double *p);
    void (*free)(void *state);
    /** Moves the particles to simulated time t_end, not before the present time, and writes the
     * record unless it is NULL: hd_record_put for each entry, then hd_record_end. Time steps begin
     * and end at fixed times whatever t_end is; all that end by t_end are done. After
     * HD_NOT_FINITE, HD_NO_MEMORY or another status the run has failed. */
    hd_status (*advance)(void *state, hd_record *record, double t_end);
    double (*time)(const void *state); /**< present simulated time: t_end of the last advance */
    /** Writes q and p, both [particle][coordinates], with positions inside the box if there is one.
     * Either may be NULL. */
    void (*state)(const void *state, double *q, double *p);
    double (*kinetic_energy)(const void *state); /**< may be left out */
    /** Writes all members but `expected`, for particles whose kinetic energy is N: the gas
     * observable follows from them. May be left out. */
    void (*tell)(const void *state, hd_told *told);
    /** Writes the integrals from which the gas observable of particles without collisions follows.
     * Only called if the scene asks for HD_OBSERVE_GAS. May be left out. */
    void (*sum)(const void *state, hd_summed *summed);
    /** For the same particles as tell; may be left out. */
    void (*examine)(const void *state, hd_examined *examined);
    /** Relative error of the energy now; may be left out if all energy is kinetic, and N. */
    double (*energy_error)(const void *state);
    /** Calls hd_archive_doubles for each array of the state, in the same order for writing and
     * reading. After reading it computes again what follows from these arrays. */
    void (*archive)(void *state, hd_archive *archive);
    uint32_t (*fingerprint)(const void *state); /**< hash of all bits of q and p; may be left out */
    double (*bytes)(const hd_scene_def *scene); /**< bytes of the state; may be left out */

    /* ---- record; all three may be left out if entries consist of doubles */
    /** What is wrong with a record that was read, or NULL. */
    const char *(*fault)(const hd_record *record, const hd_scene_def *scene);
    void (*archive_record)(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
    double (*record_bytes)(double entries); /**< bytes of so many entries and their maps */

    /* ---- tangent maps */
    /** Make, free and fill the maps of a part of a record, for `carry`. If all three are left out,
     * `carry` gets an hd_passage. The maps from a to b and from b to c must combine to those from a
     * to c, so entries of time steps are taken as a whole, by hd_record_within. HD_NO_MEMORY. */
    hd_status (*maps_create)(void **maps, int particles);
    void (*maps_free)(void *maps);
    hd_status (*maps_fill)(void *maps, const hd_record *record, double t_begin, double t_end);
    /** Carries a block of columns through maps: block[particle][2 coordinates][width], dq before
     * dp. The width is 1, 2, 4, 8, 16, 32 or 64. */
    void (*carry)(const void *maps, double *block, int width);
};

/** The dynamics of a scene. */
const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene);

HD_API_END
#endif
