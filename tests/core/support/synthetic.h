/** Worlds with a known truth: real positions and momenta, and vectors written by hand into a frame.
 */
#ifndef HD_SYNTHETIC_H
#define HD_SYNTHETIC_H

#include "testing.h"
#include "base/random.h"

typedef struct world {
    hd_scene_def scene;
    hd_trajectory *trajectory;
    double *q, *p;     /**< [2N] now */
    hd_fields *fields; /**< sampled there: the truth */
    hd_frame *frame;
    hd_modes *modes;
    hd_steps *steps;
    hd_spectrum *spectrum;
    hd_random random;
} world;

/** An equilibrated state; the frame is noise. */
world world_create(hd_scene_def scene, int vectors, int threads);
void world_free(world *w);
/** Lets the disks go on: the next state. */
void world_move(world *w, double time);
/** Puts the disks elsewhere: q[2N], p[2N]. */
void world_place(world *w, const double *q, const double *p);

double random_normal(hd_random *random);
/** Random orthogonal matrix, n x n row-major. */
void random_rotation(hd_random *random, double *out, int n);

int world_rows(const world *w); /**< of a dq half: 2N */
int world_subspace(const world *w, hd_mode_kind kind, int nx, int ny);
int world_dimension(const world *w, int subspace);
/** A modulation at one place, from its definition [T10]: A, dA/dx, dA/dy. */
void modulation_at(const hd_scene_def *scene, double out[3], const hd_wave *wave, unsigned bits,
                   const double *q);
/** out[2N] += factor times the normalised field at a column. */
void world_add_field(const world *w, double *out, int column, double factor);

/** Column col of the frame: dq and dp in these proportions, together with norm 1. */
void world_write(world *w, int col, const double *dq, const double *dp);
/** The same with dp = c dq. */
void world_write_mode(world *w, int col, const double *dq, double c);
void world_read(const world *w, int col, double *dq, double *dp);
/** Every column anew: random vectors. */
void world_noise(world *w);
/** Columns from col on: an orthonormal basis of the fields of these subspaces together, turned at
 * random; to each a random vector of length `noise` is added. */
void world_span(world *w, int col, const int *subspace, int subspaces, double noise);
/** Turns columns a and b by an angle in their plane. */
void world_turn(world *w, int a, int b, double angle);

/** A snapshot that goes into the averages. */
void world_look(world *w);
/** One sample of the spectrum, of one time unit, with these exponents [n]. */
void world_stretch(world *w, const double *exponents);

/** One look, one sample, and the steps that they show. */
void world_find(world *w, const double *exponents);

/** Step of a kind at n nodes; of the positive half. */
const hd_step *world_step(const world *w, hd_mode_kind kind, int nx, int ny);

/** Exponents that fall from 3 to 0.1 over the columns: no two alike. out[n]. */
void exponents_falling(const world *w, double *out);
void exponents_flat(double *out, int col, int count, double value);

#endif
