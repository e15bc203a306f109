/** Vectors of one step that turn between the fields of its pairs at a known rate: L and P, or T of
 * a cosine and of a sine. */
#ifndef HD_ROTATING_H
#define HD_ROTATING_H

#include "synthetic.h"

enum { VECTORS_MAX = 8, PAIRS_MAX = 4, ROWS_MAX = 800 };

/** Phases from least squares on overlaps of 2N terms, of tracks with |z|^2 >= 0.05; summed over
 * some hundred samples. */
#define ROUNDING 1e-11
/** a^2 + b^2 below which there is no phase [T13]. */
#define WEAK 0.05

/** One step, alone in its frame. z[m][c]: of vector m and pair c at time 0; rows are
 * orthonormal. */
typedef struct rotating {
    world w;
    hd_phases *phases;
    const hd_step *step;
    int d, first; /**< pairs; index of the first phase */
    double re[VECTORS_MAX][PAIRS_MAX], im[VECTORS_MAX][PAIRS_MAX];
    double angle[VECTORS_MAX][PAIRS_MAX]; /**< turned since then */
    int column[VECTORS_MAX];              /**< in which a vector lies now */
    double sign[VECTORS_MAX];             /**< with which it does */
    double strength[VECTORS_MAX];         /**< 0: it is something else */
    double time, dt;
} rotating;

/** The step of this kind at (nx, ny) of this scene in the last columns of a frame of `vectors`;
 * drawn and shown. */
rotating rotating_create(hd_scene_def def, hd_mode_kind kind, int nx, int ny, int vectors,
                         double exponent);
/** 1, 2 or 4 pairs. The exponent allows turns up to 0.95 pi. */
rotating pairs_of(int d, int disks);
rotating pairs(int d);
/** 1 or 2 pairs of a T step. */
rotating t_pairs(int d);
/** Column of the first or the second field of pair c. */
int column_of(const rotating *r, int c, bool second);
void rotating_free(rotating *r);

/** Draws new vectors, at time 0. */
void begin(rotating *r);
/** Everything turns by omega dt; then a look, without adding to the averages. */
void turn(rotating *r, double omega);
/** Exponents all alike, and the steps anew. */
void find(rotating *r, double exponent);

/** Vectors a and b change places; a takes this sign, too. */
void exchange(rotating *r, int a, int b, double sign);

/** Fails unless the slots are in the columns of their vectors. */
void check_columns(const rotating *r);

const hd_phase *phase_of(const rotating *r, int slot, int c);
double strength_of(const hd_phase *phase);
/** Every strong track turned by `angle` in all, tracked for so long. Returns how many there are. */
int check_tracks(const rotating *r, double angle, double time, double tolerance);

#endif
