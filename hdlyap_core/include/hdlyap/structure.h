/** Structure factors of the vectors: how much of each vector's dq half is a wave, along and across
 * every wave vector that the particles can show, and the amplitudes of each vector's strongest wave
 * [T20]. They do not depend on fits of fields or on steps, although a run that has them computes
 * both. n is the number of vectors; arrays of n elements are in the order of the exponents, largest
 * first, belong to the run, and change when it goes on. Several threads may read one hd_structure
 * at once while no thread calls its run. Tags as [T20] are those of equations in THEORY.md. */
#ifndef HDLYAP_STRUCTURE_H
#define HDLYAP_STRUCTURE_H

#include "hdlyap/wave.h"

HD_API_BEGIN

/** The structure factors of a run; owned by the run. */
typedef struct hd_structure hd_structure;

/** Direction of the components of dq in a structure factor: along the wave vector, or across it. */
typedef enum hd_direction { HD_ALONG, HD_ACROSS, HD_DIRECTIONS } hd_direction;

/** Number of samples in the means. */
long hd_structure_samples(const hd_structure *structure);

/** Number of waves: all whose length is at least two mean distances of particles
 * (hd_wave_limits.largest), in ascending wave number. */
int hd_structure_waves(const hd_structure *structure);
/** Wave number `wave` of these, 0 .. hd_structure_waves - 1. */
const hd_wave *hd_structure_wave(const hd_structure *structure, int wave);
/** Mean structure factors S of all n vectors at one wave, along or across k. With dq scaled to
 * length 1 and a unit vector u in this direction, S = |sum over particles of (u . dq) exp(-i k .
 * q)|^2, averaged over the signs of the components of k; in the plane it is 1/2 for a random
 * vector. In space, S across k is the sum over two directions u. */
const double *hd_structure_mean(const hd_structure *structure, int wave, hd_direction e);

/** Index of the strongest wave of vector col: the one whose mean S, along plus across, was largest
 * before the last sample was added; -1 if there was no sample before. */
int hd_structure_peak(const hd_structure *structure, int col);
/** Amplitudes of all n vectors, each at its strongest wave, in the last sample, for the modulation
 * A with these bits (hdlyap/wave.h): along k, sum grad A . dq / k; across k, sum curl A . dq / k.
 * They are multiplied by sqrt(2) for each direction that has walls and a mode number above 0, so
 * that their squares add up to S. 0 for an A that the boundaries exclude. In space there are two
 * directions across k: A alone is the first one, A with HD_SECOND the second [T22]. */
const double *hd_structure_amplitude(const hd_structure *structure, hd_direction e,
                                     unsigned modulation);

HD_API_END
#endif
