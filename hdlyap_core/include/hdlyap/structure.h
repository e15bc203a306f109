/** Structure factors of the vectors along and across every wave vector that the particles sample,
 * and the amplitudes of each vector's strongest wave [T20]. They need no fit of fields and no
 * steps. Several threads may read one hd_structure at once while none calls its run. */
#ifndef HDLYAP_STRUCTURE_H
#define HDLYAP_STRUCTURE_H

#include "hdlyap/wave.h"

HD_API_BEGIN

typedef struct hd_structure hd_structure;

/** Direction e of a structure factor: along k, or across k. */
typedef enum hd_direction { HD_ALONG, HD_ACROSS, HD_DIRECTIONS } hd_direction;

long hd_structure_samples(const hd_structure *structure); /**< number of samples in the means */

/** Number of waves: all with k up to hd_wave_limits.largest, in ascending k. */
int hd_structure_waves(const hd_structure *structure);
const hd_wave *hd_structure_wave(const hd_structure *structure, int wave);
/** Mean structure factors of all n vectors. */
const double *hd_structure_mean(const hd_structure *structure, int wave, hd_direction e);

/** Strongest wave of a vector: the one at which the mean, along plus across, was largest before the
 * last sample; -1 without one. */
int hd_structure_peak(const hd_structure *structure, int col);
/** Amplitudes of the n vectors' strongest waves in the last sample for modulation A: along, sum
 * grad A . dq / k; across, sum curl A . dq / k; times sqrt(2) for each direction with walls and a
 * mode number, so that their squares add up to S. 0 for an A that the boundaries exclude. In space,
 * the one across is along the first of two directions, and with HD_SECOND along the second [T22].
 */
const double *hd_structure_amplitude(const hd_structure *structure, hd_direction e,
                                     unsigned modulation);

HD_API_END
#endif
