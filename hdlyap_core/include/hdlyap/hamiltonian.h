/** A dynamics of one's own in few lines: particles with H = sum p^2 / 2 + V(q). A program gives
 * their start, their forces and the second derivatives of V; all else of a row (hdlyap/dynamics.h)
 * is here: integrators, the choice of the time step, record, tangent maps, energy and its error,
 * checkpoints, null vectors.
 *
 *     HD_HAMILTONIAN(of_rotors, bend, (.kept = 1, .force = force, .growth = growth),
 *                    .particles = "rotors", .coordinates = 1);
 *
 * makes the row of_rotors, to which further members of hd_dynamics can be added, as `parameter` or
 * `average`. A run whose energy is off by more than 2 % of kinetic + |potential| energy fails with
 * HD_ENERGY_LOST. examples/chain.c is a whole program. */
#ifndef HDLYAP_HAMILTONIAN_H
#define HDLYAP_HAMILTONIAN_H

#include "hdlyap/dynamics.h"
#include "hdlyap/record.h"

HD_API_BEGIN

/** What a program tells of its particles. Arrays are [particle][coordinates] of the row. `scene` is
 * a checked scene of the row. The functions give the same numbers each time, and keep nothing. */
struct hd_hamiltonian {
    int kept; /**< numbers that `force` keeps of each particle for the second derivatives, as the
                 stiffness of a spring; may be 0 */
    /** True if V stays as it is when all particles are shifted together along any coordinate. The
     * total momenta are then conserved: 2 exponents for each coordinate vanish beside the 2 of
     * energy and time, and the null vectors of shifts are known. May be left out. */
    bool shifts;
    /** Writes q and p at the start; both are 0 before. If left out, p has hd_hamiltonian_momenta
     * with the value of the own parameter `energy`, or 1 if the row has none. */
    void (*start)(const hd_scene_def *scene, double *q, double *p);
    /** Adds the forces -dV/dq at q to `force`, which is 0 before; writes kept[particle][kept]
     * unless `kept` is 0; returns V. */
    double (*force)(const hd_scene_def *scene, const double *q, double *force, double *kept);
    /** Rough rate at which tangent vectors grow [1/time unit]; it sets the pace of a run (see
     * hd_dynamics.collision_rate), and no time step is longer than 1 over it. */
    double (*growth)(const hd_scene_def *scene);
    /** Number of exponents that vanish. If left out, 2, and those that `shifts` tells of. */
    int (*zero_exponents)(const hd_scene_def *scene);
    int least; /**< least number of particles; may be left out */
    /** As hd_dynamics.check; may be left out. */
    hd_status (*check)(const hd_scene_def *scene, char *message, size_t size);
};

/** Writes random momenta by the seed of the scene, whose sum along each coordinate is 0 if there
 * are several particles; `energy` is the kinetic energy per particle. */
void hd_hamiltonian_momenta(const hd_scene_def *scene, double *p, double energy);

/* ---- own parameters that a row may have, as number k; without them the step is chosen, and the
 * integrator is pefrl */

/** time_step: if 0, it is chosen: the longest one with which the energy stays within the accuracy,
 * which counts as from 1e-6 to 1e-3, from the start to a time of 1 / growth. A tenfold error is
 * what hd_dynamics.energy_asked allows. */
#define HD_OWN_TIME_STEP(k)                                                                        \
    {                                                                                              \
        .name = "time_step", .kind = HD_PARAMETER_REAL, .offset = HD_OWN(k), .max = 10.0,          \
        .resolve = hd_hamiltonian_time_step, .range = "from 0 to 10", .unit = "time units",        \
        .text = "Time step of the integrator. 0: the longest one with which the relative error "   \
                "of the energy stays within the accuracy, which counts as from 1e-6 to 1e-3, in "  \
                "a trial from the start; when resumed, as before."                                 \
    }
#define HD_OWN_INTEGRATOR(k)                                                                       \
    {                                                                                              \
        .name = "integrator", .kind = HD_PARAMETER_WORD,                                           \
        .words = (const hd_parameter_word[]){{"verlet", 0}, {"pefrl", 1}, {NULL, 0}},              \
        .offset = HD_OWN(k), .default_value = 1, .max = 1, .range = "verlet or pefrl", .unit = "", \
        .text = "Method by which particles move. verlet has order 2 and computes forces once a "   \
                "step; pefrl has order 4 and computes them four times."                            \
    }

/* ---- tangent maps -------------------------------------------------------------------------- */

/** What `carry` reads: free flights and kicks in turn, first and last a flight. */
typedef struct hd_kicks {
    int particles;
    size_t count;         /**< number of kicks */
    size_t numbers;       /**< numbers that a kick keeps: kept * particles */
    const double *flight; /**< [count + 1]: their lengths [time units] */
    const double *length; /**< [count]: by how much time a kick multiplies forces [time units] */
    const double *kept;   /**< [count][numbers] */
} hd_kicks;

/* The loops over columns are compiled for several processors, as hot loops of the core are, with
 * `bend` as a part of them, and by gcc with all optimisations of loops. */
#if defined(__clang__)
#define HD_HAMILTONIAN_LOOPS
#else
#define HD_HAMILTONIAN_LOOPS flatten, optimize("O3"),
#endif
#define HD_HAMILTONIAN_HOT
#if defined(__x86_64__) && defined(__GNUC__) && defined(__OPTIMIZE__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if __has_attribute(target_clones)
#undef HD_HAMILTONIAN_HOT
#define HD_HAMILTONIAN_HOT                                                                         \
    __attribute__((HD_HAMILTONIAN_LOOPS target_clones("avx512f", "fma", "default")))
#endif
#endif

/** Makes the row `name` from the function
 *
 *     static void bend(const double *kept, double time, const double *restrict dq,
 *                      double *restrict dp, int particles, int width);
 *
 * which takes `width` tangent vectors through a kick: it adds to each dp_i the sum of time *
 * dF_i/dq_j dq_j. Component c of particle i is at dq + (2 * coordinates * i + c) * width, and in dp
 * likewise. `told` are members of hd_hamiltonian in parentheses; what follows are members of
 * hd_dynamics, `particles` and `coordinates` among them. */
#define HD_HAMILTONIAN(name, bend_, told, ...)                                                     \
    static const hd_dynamics name;                                                                 \
    HD_HAMILTONIAN_HOT static void name##_carry(const void *maps, double *block, int width)        \
    {                                                                                              \
        switch (width) {                                                                           \
        case 1: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 1) break;                            \
        case 2: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 2) break;                            \
        case 4: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 4) break;                            \
        case 8: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 8) break;                            \
        case 16: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 16) break;                          \
        case 32: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 32) break;                          \
        default: HD_HAMILTONIAN_CARRY(bend_, name.coordinates, 64) break;                          \
        }                                                                                          \
    }                                                                                              \
    static const hd_dynamics name = {                                                              \
        HD_HAMILTONIAN_MEMBERS, .carry = name##_carry,                                             \
        .hamiltonian = &(const hd_hamiltonian){HD_HAMILTONIAN_BARE told}, __VA_ARGS__}

#define HD_HAMILTONIAN_BARE(...) __VA_ARGS__

/* clang-format off */
#define HD_HAMILTONIAN_MEMBERS                                                                     \
    .entry = HD_HAMILTONIAN_ENTRY * sizeof(double), .symplectic = true,                            \
    .check = hd_hamiltonian_check, .zero_exponents = hd_hamiltonian_zeros,                         \
    .record_rate = hd_hamiltonian_entries, .collision_rate = hd_hamiltonian_rate,                  \
    .step = hd_hamiltonian_time_step, .energy_asked = hd_hamiltonian_energy_asked,                 \
    .null_vectors = hd_hamiltonian_null, .create = hd_hamiltonian_create,                          \
    .free = hd_hamiltonian_free, .advance = hd_hamiltonian_advance, .time = hd_hamiltonian_time,   \
    .state = hd_hamiltonian_state, .examine = hd_hamiltonian_examine,                              \
    .archive = hd_hamiltonian_archive, .fingerprint = hd_hamiltonian_fingerprint,                  \
    .bytes = hd_hamiltonian_bytes, .fault = hd_hamiltonian_fault,                                  \
    .record_bytes = hd_hamiltonian_record_bytes, .maps_create = hd_kicks_create,                   \
    .maps_free = hd_kicks_free, .maps_fill = hd_kicks_fill
/* clang-format on */

/** The body of `carry` for a number of columns. */
#define HD_HAMILTONIAN_CARRY(bend_, coordinates_, width_)                                          \
    {                                                                                              \
        const hd_kicks *kicks = maps;                                                              \
        const int half = (coordinates_) * (width_);                                                \
        double *dp = block + half;                                                                 \
        for (size_t k = 0; k <= kicks->count; k++) {                                               \
            const double flight = kicks->flight[k];                                                \
            for (int i = 0; i < kicks->particles; i++) {                                           \
                double *restrict q = block + 2 * half * i;                                         \
                const double *restrict p = q + half;                                               \
                for (int c = 0; c < half; c++) q[c] += flight * p[c];                              \
            }                                                                                      \
            if (k < kicks->count)                                                                  \
                bend_(kicks->kept + k * kicks->numbers, kicks->length[k], block, dp,               \
                      kicks->particles, width_);                                                   \
        }                                                                                          \
    }

/* ---- members of a row, which HD_HAMILTONIAN uses: see hd_dynamics -------------------------- */

enum { HD_HAMILTONIAN_ENTRY = 32 }; /**< doubles of an entry of the record */
HD_MUST_CHECK hd_status hd_hamiltonian_check(const hd_scene_def *scene, char *message, size_t size);
double hd_hamiltonian_time_step(const hd_scene_def *scene);
int hd_hamiltonian_zeros(const hd_scene_def *scene);
double hd_hamiltonian_entries(const hd_scene_def *scene);
double hd_hamiltonian_rate(const hd_scene_def *scene);
double hd_hamiltonian_energy_asked(const hd_scene_def *scene);
int hd_hamiltonian_null(const hd_scene_def *scene, const double *q, const double *p,
                        double *column);
HD_MUST_CHECK hd_status hd_hamiltonian_create(void **state, const hd_scene_def *scene);
void hd_hamiltonian_free(void *state);
HD_MUST_CHECK hd_status hd_hamiltonian_advance(void *state, hd_record *record, double t_end);
double hd_hamiltonian_time(const void *state);
void hd_hamiltonian_state(const void *state, double *q, double *p);
void hd_hamiltonian_examine(const void *state, hd_invariants *examined);
void hd_hamiltonian_archive(void *state, hd_archive *archive);
uint32_t hd_hamiltonian_fingerprint(const void *state);
double hd_hamiltonian_bytes(const hd_scene_def *scene);
const char *hd_hamiltonian_fault(const hd_record *record, const hd_scene_def *scene);
double hd_hamiltonian_record_bytes(double entries);
HD_MUST_CHECK hd_status hd_kicks_create(void **maps, const hd_scene_def *scene);
void hd_kicks_free(void *maps);
HD_MUST_CHECK hd_status hd_kicks_fill(void *maps, const hd_record *record, double t_begin,
                                      double t_end);

HD_API_END
#endif
