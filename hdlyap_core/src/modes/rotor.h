/** The vectors of one step, which turn together: each (a slot, which may change its column) and
 * each pair of fields is a track with a phase of its own. The sum over all tracks of conj(z) z'
 * between two samples turns by omega dt too, weighs each track with its strength and does not mind
 * which vector is which: it predicts the tracks' next phases [T13]. */
#ifndef HD_ROTOR_H
#define HD_ROTOR_H

#include "modes/foresight.h"
#include "modes/sets.h"
#include "modes/track.h"

enum { HD_PAIRS_MAX = HD_MODULATIONS_MAX, HD_SLOTS_MAX = 2 * HD_PAIRS_MAX };

typedef struct hd_rotor {
    int step, pairs, slots;
    int column, next, partner; /**< of the first field; from one pair to the next, and within one */
    double wave_number;
    hd_track *track; /**< [slots][pairs] */
    int col, count;  /**< the set followed; col -1: none */
    long samples;    /**< since the set was taken up */
    int slot_col[HD_SLOTS_MAX];
    double sign[HD_SLOTS_MAX]; /**< of the vector in a slot against the one it began with */
    double complex z[HD_SLOTS_MAX][HD_PAIRS_MAX]; /**< at the last sample, times sign */
    double time;
    hd_foresight ahead;     /**< what phases are unwrapped by */
    double turned, turning; /**< by the mean rate of the tracks, and for how long */
    hd_blocks *blocks;      /**< of all rotors */
    double *sample;         /**< [2], at column 2 number of their rows: turned and turning */
    int number;
} hd_rotor;

/** Of the fields of a step of this kind: 0 of others, and of a single field, which has no phase. */
int hd_rotor_pairs(const hd_step *step, hd_mode_kind kind);

/** Of a step with pairs, the `index`th one, whose fields begin at `column`; `tracks` are its own.
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_rotor_create(hd_rotor *r, hd_track *tracks, const hd_step *step,
                                        int index, int column);

/** Forgets all; `state` is said until the next sample. */
void hd_rotor_restart(hd_rotor *r, hd_phase_state state);

/** Samples may come at any distance: only one that is too far away for the step's rate, or for how
 * well it is foreseen, begins anew. What it has turned by is in `sample`, zeros if it has not. */
void hd_rotor_add(hd_rotor *r, const hd_step *step, const hd_modes *modes, double time);

int hd_rotor_tracked(const hd_rotor *r); /**< tracks that have a phase now */
/** Longest time to the next sample of a resolved step. */
double hd_rotor_sampling(const hd_rotor *r, const hd_step *step);

/** Without its tracks; `now`: simulated time of the run. */
void hd_rotor_archive(hd_rotor *r, hd_archive *archive, int vectors, double now);

#endif
