/** What can move: a row of facts and functions. Disks, spheres and dumbbells are such; a program
 * hands another one over in hd_scene_def.dynamics, and its run has exponents with their errors,
 * Gram-Schmidt and covariant vectors, checkpoints, ranks.
 *
 * Each particle has `coordinates` q, scaled so that its kinetic energy is the sum of p^2 / 2.
 * Whoever moves them writes a record of what happens, hdlyap/record.h; tangent vectors are carried
 * through that record and know nothing else. A row and its parameters last as long as its runs.
 * Functions of a row are called by one thread of a run at a time, `carry` by several. */
#ifndef HDLYAP_DYNAMICS_H
#define HDLYAP_DYNAMICS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hdlyap/archive.h"
#include "hdlyap/parameters.h"

HD_API_BEGIN

/** What happens, see hdlyap/record.h. */
typedef struct hd_record hd_record;

/** What has happened so far. */
typedef struct hd_told {
    uint64_t collisions, wall_events; /**< of pairs; with walls */
    /** Virial of the pair events, by direction: sum of |p.n| n_d^2 [sigma momentum] [T19]. */
    double virial[HD_DIMENSION_MAX];
    double expected; /**< pair events in a time unit, by Enskog's theory [T2] */
} hd_told;

/** Integrals over time so far, of what has a potential [T19]. */
typedef struct hd_summed {
    double time; /**< that they go over: of what moves in steps the whole ones */
    double kinetic[HD_DIMENSION_MAX]; /**< of the sum of p_d^2, by direction */
    double virial[HD_DIMENSION_MAX];  /**< of the sum of r_d F_d over pairs, by direction */
    double potential;                 /**< of the potential energy of all together */
} hd_summed;

/** How exact the present state is. */
typedef struct hd_examined {
    double energy_error; /**< relative, of the energy; the row's function of that name has it */
    /** More than rounding makes of the relative error of the energy: each event so far rounds the
     * energy of its disks by some eps, and the roundings add up as a random walk. Seen: 0.01 of
     * this. */
    double energy_rounding;
    double momentum[HD_DIMENSION_MAX]; /**< of all disks together */
    double angular_momentum; /**< about the middle of the box, about z; a circle conserves it */
    double overlap; /**< deepest of any pair now: max(0, 1 - distance) over all pairs and images */
    /** More than rounding makes of an overlap: of some roundings in positions, of the order of the
     * box, and in times, as long as they are counted from one moment. */
    double overlap_rounding;
    /** Deeper than this [sigma] is a fault, HD_OVERLAP: 1e-9, or overlap_rounding where that is
     * more: in boxes longer than some 3e5 sigma, 4e-6 in the longest of 1e9. */
    double overlap_max;
} hd_examined;

/** What kinetic theory says of particles in a box, to some percent; the core's own rows have it. */
typedef struct hd_fluid hd_fluid;

/** A part of a record: where a row has no maps of its own, this is what vectors are carried by. */
typedef struct hd_passage {
    const void *entry; /**< [count], of the row's size */
    size_t count;
    double begin, end; /**< since the start of the record [time units] */
    int particles;
} hd_passage;

enum {
    HD_PARTICLES = 32,        /**< room for a name */
    HD_COORDINATES_MAX = 1000 /**< of a particle: those of all are counted by an int */
};

/** What may be left out says so: it is 0, false or NULL then. */
struct hd_dynamics {
    const char *particles; /**< in the plural: its name, of 31 characters at most and none of the
                                core's */
    int dimension;         /**< of the box that their positions lie in, 2 or 3; 0: there is none */
    int coordinates;       /**< of a particle: of its dq, and of its dp, HD_COORDINATES_MAX at most.
                                The first `dimension` of them are its position in the box */
    size_t entry; /**< bytes of an entry of the record, a multiple of 8; it begins with a double */
    /** Maps are symplectic: exponents come in pairs, and half of all vectors say all [T18]. Without
     * it exponents = all carries each of them. */
    bool symplectic;
    /** No map ever takes an unstable vector to a dq of zero, as of hard bodies, which only
     * disperse: then the frame may be orthonormalised in dq alone, which is faster [T6]. May be
     * left out. */
    bool dispersing;
    /** Momenta only set the pace, as of hard bodies: (p, 0) and (0, p) are null vectors, and the
     * null space is orthogonal to all others [T9]. May be left out. */
    bool paces;

    const hd_parameter *parameter; /**< [parameters], of its own: see HD_OWN */
    int parameters;                /**< HD_OWN_MAX at most */
    const hd_fluid *fluid;         /**< may be left out */

    /* ---- scene */
    /** The parameters have passed their ranges; do they fit together? HD_REFUSED with one line in
     * `message` (NULL: it is not wanted): the parameter, its value, what is allowed. May be left
     * out. */
    hd_status (*check)(const hd_scene_def *scene, char *message, size_t size);
    /** Number of exponents that vanish; may be left out: none. */
    int (*zeros)(const hd_scene_def *scene);
    /** Entries of the record expected in a time unit, roughly: what a record has room for. */
    double (*entries)(const hd_scene_def *scene);
    /** Collisions of pairs expected in a time unit; of what does not collide N / 2 over the time in
     * which tangent vectors grow by about e. First intervals are 2 such times of one particle long,
     * none is longer than 60, errors take blocks of 8 at least. */
    double (*rate)(const hd_scene_def *scene);
    /** Of what moves in steps their length [time units]. May be left out. */
    double (*step)(const hd_scene_def *scene);
    /** Power of the step by which the zero exponents split that no null vector holds, about. May be
     * left out: they do not. */
    double (*split)(const hd_scene_def *scene);
    /** Time that a disturbance takes through all of them: blocks of averages are no shorter. May
     * be left out. */
    double (*crossing)(const hd_scene_def *scene);
    /** Vectors that stay as they are, or turn into each other, as far as they are known exactly:
     * column[..][particle][2 coordinates] at this state, not normalised. Their number, `zeros` at
     * most. May be left out: none is known. */
    int (*null)(const hd_scene_def *scene, const double *q, const double *p, double *column);

    /** Moment of inertia of a particle of mass 1 that turns in the plane [sigma^2]: it has one
     * coordinate more than its box has directions, sqrt(inertia) times an angle. May be left out:
     * none turns. */
    double (*inertia)(const hd_scene_def *scene);
    /** Area or volume of a particle. May be left out: it is not known. */
    double (*size)(const hd_scene_def *scene);

    /* ---- particles */
    /** The start: the state of a checked scene at time 0. HD_NO_MEMORY, and *state NULL. */
    hd_status (*create)(void **state, const hd_scene_def *scene);
    /** A prepared one, for tests: q and p [particle][coordinates]. May be left out. */
    hd_status (*create_from)(void **state, const hd_scene_def *scene, const double *q,
                             const double *p);
    void (*free)(void *state);
    /** Moves them to simulated time t_end, at least the present one, and adds what happens on the
     * way to the record, which may be NULL: hd_record_put for each entry, hd_record_end at last.
     * What moves in steps does them where they lie whatever t_end is: those that end by then.
     * HD_NOT_FINITE, HD_NO_MEMORY: the run has failed. */
    hd_status (*advance)(void *state, hd_record *record, double t_end);
    double (*time)(const void *state); /**< t_end of the last advance */
    /** [particle][coordinates] each, positions inside the box if there is one; either may be NULL.
     */
    void (*state)(const void *state, double *q, double *p);
    double (*kinetic_energy)(const void *state); /**< may be left out */
    /** All but `expected`, of particles whose kinetic energy is N: what the gas is made from. May
     * be left out; then there is none. */
    void (*tell)(const void *state, hd_told *told);
    /** What the gas is made from instead, of what does not collide; asked of scenes that observe
     * HD_OBSERVE_GAS alone. May be left out. */
    void (*sum)(const void *state, hd_summed *summed);
    void (*examine)(const void *state, hd_examined *examined); /**< of the same; may be left out */
    /** Relative error of the energy now; may be left out where all is kinetic and N. */
    double (*energy_error)(const void *state);
    /** Each array of the state, one hd_archive_doubles after the other, whether it is written or
     * read. What follows from them is made anew. */
    void (*archive)(void *state, hd_archive *archive);
    uint32_t (*fingerprint)(const void *state); /**< of q and p to the last bit; may be left out */
    double (*bytes)(const hd_scene_def *scene); /**< of the state; may be left out */

    /* ---- record; may all be left out where entries are doubles throughout */
    const char *(*fault)(const hd_record *record, const hd_scene_def *scene); /**< or NULL */
    void (*archive_record)(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
    double (*record_bytes)(double entries); /**< in the record, and as maps */

    /* ---- tangent maps */
    /** A part of a record made ready for `carry`. All three may be left out: it is an hd_passage
     * then. The maps from a to b and from b to c make those from a to c: what moves in steps takes
     * whole steps, hd_record_within. HD_NO_MEMORY. */
    hd_status (*maps_create)(void **maps, int particles);
    void (*maps_free)(void *maps);
    hd_status (*maps_fill)(void *maps, const hd_record *record, double t_begin, double t_end);
    /** Carries a block of columns through them: block[particle][2 coordinates][width], dq before
     * dp; the width is 1, 2, 4, 8, 16, 32 or 64. */
    void (*carry)(const void *maps, double *block, int width);
};

/** The row of a scene. */
const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene);

HD_API_END
#endif
