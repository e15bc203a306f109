/** Structure factors of the vectors along and across every wave vector that the disks sample, and
 * the amplitudes of each vector's strongest wave [T20]. No field is fitted and no step is needed.
 * Several threads may read one at once while its run is not called. */
#ifndef HDLYAP_STRUCTURE_H
#define HDLYAP_STRUCTURE_H

#include "hdlyap/wave.h"

HD_API_BEGIN

typedef struct hd_structure hd_structure;

/** e along k, or across. */
typedef enum hd_direction { HD_ALONG, HD_ACROSS, HD_DIRECTIONS } hd_direction;

long hd_structure_samples(const hd_structure *structure); /**< snapshots in the means */

/** In ascending k; all with k up to hd_wave_limits.largest. */
int hd_structure_waves(const hd_structure *structure);
const hd_wave *hd_structure_wave(const hd_structure *structure, int wave);
const double *hd_structure_mean(const hd_structure *structure, int wave, hd_direction e);

/** Wave at which the mean, along and across together, was largest before the snapshot; -1 without
 * one. */
int hd_structure_peak(const hd_structure *structure, int col);
/** Snapshot of the amplitude of that wave, of modulation A (HD_SIN_X | HD_SIN_Y): along sum grad A
 * . dq / k, across sum curl A . dq / k, times sqrt(2) for each direction of walls with nodes: their
 * squares add up to the snapshot of S. 0 where A is none of the boundaries'; [n]. Of spheres across
 * is along the first of two directions, with HD_SECOND along the other one [T22]. */
const double *hd_structure_amplitude(const hd_structure *structure, hd_direction e,
                                     unsigned modulation);

HD_API_END
#endif
