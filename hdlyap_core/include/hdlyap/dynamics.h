/** A dynamics: a row of facts and functions that says how particles move. The core has rows for
 * disks, spheres, dumbbells, soft disks and soft spheres. A program can give a row of its own in
 * hd_scene_def.dynamics; its runs then have exponents with errors, Gram-Schmidt and covariant
 * vectors, checkpoints and ranks.
 *
 * Each particle has `coordinates` q and as many momenta p, scaled so that its kinetic energy is
 * half of the sum of p^2. The functions that move particles write a record (hdlyap/record.h), and
 * tangent vectors are carried by that record alone. A tangent vector has a part dq and a part dp
 * for each particle. A row, and what it points to, must last as long as its runs. A run calls the
 * functions of a row on one thread at a time, except for `carry`, which several threads call at
 * once. Tags as [T19] are those of equations in THEORY.md. */
#ifndef HDLYAP_DYNAMICS_H
#define HDLYAP_DYNAMICS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hdlyap/archive.h"
#include "hdlyap/parameters.h"

HD_API_BEGIN

/** What happened to the particles, entry by entry: see hdlyap/record.h. */
typedef struct hd_record hd_record;

/** What has added up since the start of the trajectory [T19]. Particles that collide have
 * collisions, those with a potential have integrals over time; all that they do not have is 0. */
typedef struct hd_totals {
    /** Number of collisions of two particles; number of collisions of a particle with a wall. */
    uint64_t collisions, wall_events;
    /** Those of `collisions` in which both particles are of the first kind, in which their kinds
     * differ, and in which both are of the second kind (hd_scene_kinds). */
    uint64_t collisions_of[3];
    /** Pair collisions of all particles expected per time unit: what the row's `collision_rate`
     * says, by Enskog's theory [T2] for hard particles of the core. */
    double expected;
    double time; /**< time that the numbers below cover: up to now, or to the last whole time step
                    [time units] */
    /** For each direction d, with r the vector from one particle of a pair to the other: the sum
     * over the collisions of |r_d Delta p_d|, Delta p the momentum that they exchange [sigma
     * momentum], and of what a wall gives to a particle by being further away from, or nearer to,
     * its centre than the mean radius, if radii differ; or the integral of the sum of r_d F_d over
     * the pairs, F the force on the other one. Repulsion makes it positive. */
    double virial[HD_DIMENSION_MAX];
    /** For each direction d: integral of the sum of p_d^2 over the particles. */
    double kinetic[HD_DIMENSION_MAX];
    double potential; /**< integral of the potential energy of all particles together */
    /** Of walls that drag, at the low end and at the high one [T27]; kinetic is then known, too. */
    struct {
        double impulse[2];  /**< momentum along them that they have given to the particles */
        double near[2];     /**< integral of the number of particles near them: whose centres are
                               within 1 sigma of the places nearest to the wall that they reach
                               [time units] */
        double momentum[2]; /**< integral of the momentum of these along the walls [sigma mass] */
    } walls;
} hd_totals;

/** What is conserved, as it is now. If the row has no function `examine`, the kinetic energy is the
 * sum of p^2 / 2, and all other members are 0. */
typedef struct hd_invariants {
    double kinetic_energy; /**< of all particles; always N for hard particles */
    /** Relative error of the energy now, which would be 0 in exact arithmetic. */
    double energy_error;
    /** Bound on the relative error of the energy by rounding. Each collision changes the energy of
     * its particles by about DBL_EPSILON, and these changes add up as a random walk. Observed
     * errors are about 0.01 of the bound. */
    double energy_rounding;
    double momentum[HD_DIMENSION_MAX]; /**< total momentum along each direction, 0 along periodic
                                          ones but for rounding, unless walls drag */
    /** Total angular momentum about the middle of the box; it is conserved in a circle only. */
    double angular_momentum;
    /** Deepest overlap of two particles now, nearest images included: max(0, 1 - distance) for
     * disks and spheres [sigma]. */
    double overlap;
    /** Bound on the overlap of two particles by rounding: of positions, which are as large as the
     * box, and of the times of collisions [sigma]. */
    double overlap_rounding;
    /** Overlap beyond which a run fails with HD_OVERLAP: 1e-9, or overlap_rounding if that is
     * larger, as in boxes longer than about 3e5 sigma; in a box of 1e9 sigma it is 4e-6 [sigma]. */
    double overlap_max;
} hd_invariants;

/** What kinetic theory says of the particles, to some percent. Only rows of the core have it. */
typedef struct hd_fluid hd_fluid;

/** Particles with H = sum p^2 / 2 + V(q): see hdlyap/hamiltonian.h, which makes rows of them. */
typedef struct hd_hamiltonian hd_hamiltonian;

/** A part of a record, which `carry` gets if the row makes no maps of its own. */
typedef struct hd_record_slice {
    /** The entries, [count], each of hd_dynamics.entry bytes; NULL if count is 0. */
    const void *entry;
    size_t count;
    double begin, end; /**< the part of the record through which tangent vectors are carried: times
                          from the start of the record [time units] */
    int particles;
    const hd_scene_def *scene; /**< its parameters that the row reads are those of the run */
} hd_record_slice;

/** A number of a state, whose mean over time the observable averages has. */
typedef struct hd_average {
    /** Name, by which a target can ask for it: a letter, then letters, digits and _, at most 31
     * together; not that of a parameter, nor of a quantity of targets. */
    const char *name;
    const char *unit; /**< unit, as time units; "" if it has none */
} hd_average;

enum {
    HD_PARTICLES = 32,    /**< bytes of a dynamics' name with its final zero */
    HD_AVERAGE_NAME = 32, /**< bytes of the name of an average with its final zero */
    HD_AVERAGES_MAX = 8,  /**< most numbers of a state whose means a row asks for */
    /** Most coordinates of a particle, so that an int can count those of all particles. */
    HD_COORDINATES_MAX = 1000
};

/** A row. A member that may be left out says so; it is then 0, false or NULL. In the functions
 * `scene` is a checked scene whose dynamics is this row, unless a comment says otherwise. */
struct hd_dynamics {
    const char *particles; /**< name of the particles, a plural of at most 31 characters that no row
                              of the core has */
    int dimension;   /**< dimension of the box, 2 or 3; 0 if particles have no positions in a box */
    int coordinates; /**< number of coordinates of a particle, which is that of the components of
                        its dq, and of its dp; at most HD_COORDINATES_MAX. The first `dimension` of
                        them are its position */
    size_t entry; /**< bytes of an entry of the record, which consists of doubles; the first one is
                     the time of the entry */
    /** True if tangent maps are symplectic: exponents then come in pairs of opposite sign, and half
     * of the vectors give all of them [T18], unless walls break that (hd_scene_symplectic). If
     * false, exponents = all, which is then the default, carries all vectors, and positive
     * exponents are counted by value. */
    bool symplectic;
    /** True if no growing tangent vector ever comes to dq = 0, as with hard particles, whose
     * collisions only disperse. The frame may then be orthonormalised by its dq parts alone, which
     * is faster [T6]. May be left out. */
    bool dispersing;
    /** True if scaling all momenta only changes the pace of the motion, as with hard particles:
     * (dq, dp) = (p, 0) and (0, p) are then null vectors, and the null space is orthogonal to all
     * other vectors [T9]. May be left out. */
    bool scale_invariant;
    /** True for particles that collide and whose total kinetic energy is always N: `totals` counts
     * collisions. If false, it integrates over time. May be left out. */
    bool collides;
    /** What the ends of a direction may be beside periodic and reflecting: a set of 1 <<
     * HD_SHEARING. May be left out. */
    unsigned ends;

    /** Parameters that only this dynamics has, [parameters]; the offset of number k is HD_OWN(k).
     * Their kind is HD_PARAMETER_INT, HD_PARAMETER_REAL, HD_PARAMETER_WORD or
     * HD_PARAMETER_INTERVAL, and they are not live. May be left out. */
    const hd_parameter *parameter;
    int parameters;                    /**< number of these parameters, 0 .. HD_OWN_MAX */
    const hd_fluid *fluid;             /**< may be left out */
    const hd_hamiltonian *hamiltonian; /**< of rows that HD_HAMILTONIAN makes; else left out */

    /* ---- scene */
    /** Checks whether the parameters of a scene, each of which is in its own range, fit together.
     * Returns HD_OK, or HD_REFUSED with one line in message[size] unless `message` is NULL: the
     * parameter, its value, what is allowed. May be left out. */
    hd_status (*check)(const hd_scene_def *scene, char *message, size_t size);
    /** Number of exponents that vanish, even if maps are symplectic. If left out, none does; or, if
     * maps are not symplectic, covariant vectors count them by their errors. Which
     * exponents are positive follows from it: `exponents = positive` would ask for wrong ones,
     * targets and covariant vectors would mistake their spaces. */
    int (*zero_exponents)(const hd_scene_def *scene);
    /** Rough number of record entries per time unit of all particles, at least 1e-9 and at most 1e9
     * for each particle. First advances and the expected memory follow from it; the run then counts
     * by itself. */
    double (*record_rate)(const hd_scene_def *scene);
    /** Expected number of pair collisions of all N particles per time unit. For particles without
     * collisions: N / 2 divided by the time in which tangent vectors grow by a factor of about e.
     * At least 1e-9 and at most 1e9 for each particle. The time (N / 2) / collision_rate sets
     * the pace of a run: its first interval between orthonormalisations has the length of 2 of
     * these times, its longest one of 60; a sample is some 80 long, blocks for standard errors at
     * least 8, the warm-up at least 100. A rate that is a thousand times too large makes a hundred
     * times as many orthonormalisations; one that is too small makes warm-up and samples long, so
     * that errors are known late. Exponents stay what they are. */
    double (*collision_rate)(const hd_scene_def *scene);
    /** Length of a time step, if particles move in time steps [time units]; for messages, and so
     * that the energy is looked at. May be left out. */
    double (*step)(const hd_scene_def *scene);
    /** Relative error of the energy up to which the numbers of a run are what the scene asks for; a
     * run says so when its energy is off by more. It needs `examine`. May be left out; a run then
     * says nothing until its energy is off by 2 %, with which it ends. */
    double (*energy_asked)(const hd_scene_def *scene);
    /** Usual speed of a particle, by which exponents scale: 1 for hard particles, which is also
     * meant if it is left out. Only the warm-up of scenes in a box follows from it. */
    double (*speed)(const hd_scene_def *scene);
    /** Exponents that vanish in theory, but that no exact null vector keeps at 0, differ from 0 by
     * about the time step to the power that this returns. Only a warning of the node follows from
     * it. If left out, they do not differ. */
    double (*zero_splitting_order)(const hd_scene_def *scene);
    /** Time that a disturbance, as a sound wave, takes through the whole system; blocks for
     * standard errors are not shorter [time units]. May be left out. */
    double (*sound_crossing_time)(const hd_scene_def *scene);
    /** Writes the tangent vectors that are known exactly as null vectors at the state q, p: those
     * whose length stays bounded or grows linearly with time. Vector k is column[k][particle][2
     * coordinates], dq before dp, of any length. Returns their number, at most `zero_exponents`,
     * more of which end the run with HD_DYNAMICS_FAULT; or -1 if it lacks memory. Tangent maps must
     * carry their span into that of the later ones. Only weights of modes and the null space of
     * covariant vectors are held against them; a wrong one shows there, and exponents stay what
     * they are. If left out, none is known.
     */
    int (*null_vectors)(const hd_scene_def *scene, const double *q, const double *p,
                        double *column);

    /** Moment of inertia of a particle that turns in the plane [sigma^2]. Such a particle has one
     * more coordinate behind its position: sqrt(inertia) times its angle. If left out, particles do
     * not turn. */
    double (*inertia)(const hd_scene_def *scene);
    /** Writes the places of the disks of a particle along its arm, whose direction is its angle,
     * from its centre, to site[HD_SITES_MAX] in ascending order [sigma], and returns their number.
     * If left out, it has one, at its centre. */
    int (*sites)(const hd_scene_def *scene, double *site);
    /** Area of a particle in the plane, its volume in space; the mean over all particles [sigma^d].
     * If left out, it is not known. */
    double (*size)(const hd_scene_def *scene);
    /** See hd_scene_kinds; the scene may not have been checked. If left out, all particles are
     * alike. q and p of a particle are then, in all that the row does with tangent vectors, q times
     * the root of its mass, and the momentum over it; `state` writes p so, and q as it is. */
    int (*kinds)(const hd_scene_def *scene, hd_kind *kind);
    /** The row, of the same name, that serves scenes in which not all particles have diameter 1 and
     * mass 1, so that those with one kind have no part of what kinds cost. May be left out. */
    const hd_dynamics *mixture;

    /* ---- particles */
    /** Makes the state of the particles at time 0 in *state. Returns HD_OK; or HD_NO_MEMORY, and
     * *state is NULL. */
    hd_status (*create)(void **state, const hd_scene_def *scene);
    /** As create, but without a start, which can take long to find: `archive` reads all that the
     * state has before anything else is asked of it. If left out, `create` serves. */
    hd_status (*create_empty)(void **state, const hd_scene_def *scene);
    /** Frees a state. */
    void (*free)(void *state);
    /** Moves the particles to the simulated time t_end, which is not before the present one. Unless
     * `record` is NULL, it adds what happened: hd_record_put for each entry, then hd_record_end.
     * Time steps begin and end at fixed times, whatever t_end is. The call does all steps that end
     * by t_end; the state is then that of the last step, but the record ends at t_end. If it
     * returns another status than HD_OK, as HD_NOT_FINITE or HD_NO_MEMORY, the run has failed. It
     * also fails, with HD_DYNAMICS_FAULT, if `time` is then not t_end, if the record does not end
     * there, or if entries are not in order; and with HD_NOT_FINITE if q and p, as far as the core
     * reads them, are no numbers. */
    hd_status (*advance)(void *state, hd_record *record, double t_end);
    double (*time)(const void *state); /**< the present simulated time, t_end of the last `advance`
                                          [time units] */
    /** Writes the present q and p, both [particle][coordinates], with positions folded into the box
     * if there is one. Either array may be NULL. */
    void (*state)(const void *state, double *q, double *p);
    /** Writes all members of *totals but `expected`, from which the observable gas follows.
     * Integrals are needed only if the scene asks for HD_OBSERVE_GAS. May be left out. */
    void (*totals)(const void *state, hd_totals *totals);
    /** Returns the integral of the divergence of the flow, the sum of the derivatives of each dq/dt
     * by its q and of each dp/dt by its p, over the time from the start to now, or to the last
     * whole time step. Its mean is the sum of all exponents: hd_run_divergence. It is part of what
     * `archive` keeps. Collisions add the logarithms of what they do to phase space. May be left
     * out, as it is 0 for symplectic maps; in scenes that have such maps it is not asked. */
    double (*divergence)(const void *state);
    /** What a program wants to know the means of, [averages]: the observable averages, see
     * hdlyap/averages.h. May be left out. */
    const hd_average *average;
    int averages; /**< number of these, 0 .. HD_AVERAGES_MAX */
    /** Writes these numbers of the state q, p, which is as `state` writes it, to value[averages].
     * They follow from the state alone. A number that is not from -1e100 to 1e100, or is not
     * written, ends the run with HD_DYNAMICS_FAULT. */
    void (*measure)(const hd_scene_def *scene, const double *q, const double *p, double *value);
    /** Writes all members of *examined; 0 where a member means nothing for these particles, as
     * energy_error where energy is not conserved. A run of particles that do not collide, or whose
     * row has `step` or `energy_asked`, ends with HD_ENERGY_LOST when energy_error is beyond 2 %.
     * May be left out; the error of the energy is then unknown, and a lost energy is not noticed.
     */
    void (*examine)(const void *state, hd_invariants *examined);
    /** Calls hd_archive_doubles for each array of the state, in one order for writing and reading;
     * together these have at least a number for each particle. After reading, it also restores
     * whatever else follows from these arrays. */
    void (*archive)(void *state, hd_archive *archive);
    /** Hash of all bits of q and p, by which ranks compare their states: if it is not that of the
     * state, a run of several ranks ends with HD_RANKS_APART. May be left out. */
    uint32_t (*fingerprint)(const void *state);
    /** Bytes of memory that the state takes, for estimates. May be left out. */
    double (*bytes)(const hd_scene_def *scene);

    /* ---- record, whose entries consist of doubles; checkpoints keep them, and refuse what is not
     * finite or not in the order of time */
    /** Returns what else is wrong with a record that was read from a checkpoint, in words, or NULL
     * if nothing is. May be left out. */
    const char *(*fault)(const hd_record *record, const hd_scene_def *scene);
    /** Bytes of so many record entries together with their maps. May be left out. */
    double (*record_bytes)(double entries);

    /* ---- tangent maps */
    /** Make, free and fill the maps of a part of a record, which `carry` reads. maps_fill takes the
     * entries from t_begin to t_end (hd_record_within), times counted from the start of the record.
     * Maps from a to b and then from b to c must give the same as maps from a to c; so a row gives
     * all entries of a time step the same time, because t_begin and t_end can be any times. Return
     * HD_OK or HD_NO_MEMORY. The scene of maps_create lasts longer than the maps. If all three are
     * left out, `carry` gets an hd_record_slice. */
    hd_status (*maps_create)(void **maps, const hd_scene_def *scene);
    void (*maps_free)(void *maps);
    hd_status (*maps_fill)(void *maps, const hd_record *record, double t_begin, double t_end);
    /** Carries `width` tangent vectors through the maps, in place: block[particle][2
     * coordinates][width], dq before dp. The width is 1, 2, 4, 8, 16, 32 or 64. A run fails with
     * HD_NOT_FINITE if this gives no numbers. That maps are not those of the motion is seen by no
     * run: exponents are then wrong, see hd_dynamics_test. */
    void (*carry)(const void *maps, double *block, int width);
};

/** Returns HD_OK for a row whose members fit together; otherwise HD_REFUSED with one line in
 * message[size], unless that is NULL: the member, its value, what is allowed. Whatever makes a run
 * or a trajectory begins with this check, and with one of the numbers that the row's functions give
 * for the scene. Whether the functions do what they say is asked by hdlyap/dynamics_test.h. */
HD_MUST_CHECK hd_status hd_dynamics_check(const hd_dynamics *row, char *message, size_t size);

/** Returns the dynamics that a scene has: def->dynamics, or the row of def->particles if that is
 * NULL. */
const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene);

HD_API_END
#endif
