/** The vectors of one step, which turn together. Each vector (a slot, which may change its column)
 * has a track, with a phase of its own, for each pair of fields. The sum over all tracks of conj(z)
 * z' between two samples turns by omega dt, too; it weights each track with its strength and does
 * not depend on which vector is which, so it predicts the tracks' next phases [T13]. */
#ifndef HD_ROTOR_H
#define HD_ROTOR_H

#include "modes/phase_predictor.h"
#include "modes/sets.h"
#include "modes/track.h"

enum { HD_PAIRS_MAX = HD_MODULATIONS_MAX, HD_SLOTS_MAX = 2 * HD_PAIRS_MAX };

typedef struct hd_rotor {
    int step, pairs, slots;
    int column, next, partner; /**< column of its first field; distance from one pair's to the next
                                  pair's; from the first to the second field of a pair */
    double wave_number;
    hd_track *track; /**< [slots][pairs] */
    int col, count;  /**< columns of the set whose vectors are followed; col -1: none */
    long samples;    /**< number of samples since this set is followed */
    int slot_col[HD_SLOTS_MAX];
    double sign[HD_SLOTS_MAX]; /**< sign of the vector in a slot, relative to the sign that it began
                                  with */
    double complex z[HD_SLOTS_MAX][HD_PAIRS_MAX]; /**< a + i b of each slot and pair at the last
                                                     sample, times sign */
    double time;
    hd_phase_predictor ahead; /**< predicts phases, so that they can be unwrapped */
    double turned, turning;   /**< angle by which the step has turned, from the mean rate of the
                                 tracks; time in which it did so */
    hd_blocks *blocks;        /**< the blocks of all rotors */
    double *sample; /**< [2], at 2 * number in the samples of all rotors: turned and turning since
                       the last sample */
    int number;
} hd_rotor;

/** Number of pairs of fields of a step of this kind; 0 for other steps, and for a single field,
 * which has no phase. */
int hd_rotor_pairs(const hd_step *step, hd_mode_kind kind);

/** Creates the rotor of step number `index`, whose fields begin at `column`; `tracks` belong to it.
 * Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_rotor_create(hd_rotor *r, hd_track *tracks, const hd_step *step,
                                        int index, int column);

/** Forgets everything; reports `state` until the next sample. */
void hd_rotor_restart(hd_rotor *r, hd_phase_state state);

/** Adds a sample, at any distance from the last one; if that is too far for the step's rate and its
 * prediction, phases start anew. Writes the turn and its time to `sample`, zeros if there is none.
 */
void hd_rotor_add(hd_rotor *r, const hd_step *step, const hd_modes *modes, double time);

int hd_rotor_tracked(const hd_rotor *r); /**< number of tracks that have a phase now */
/** Longest time to the next sample if the step is resolved. */
double hd_rotor_sampling(const hd_rotor *r, const hd_step *step);

/** Reads or writes a rotor without its tracks; `now` is the simulated time of the run. */
void hd_rotor_archive(hd_rotor *r, hd_archive *archive, int vectors, double now);

#endif
