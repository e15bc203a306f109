/** How steps are found. */
#ifndef HD_STEPS_H
#define HD_STEPS_H

#include "base/archive.h"
#include "hdlyap/steps.h"

/** kind: HD_MODE_T or HD_MODE_LP. */
hd_relation hd_relation_of(const hd_scene_def *def, hd_mode_kind kind);

/** Finds steps in the fields of `modes`, which must live longer. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_steps_create(hd_steps **out, const hd_scene_def *def,
                                        const hd_modes *modes);
void hd_steps_free(hd_steps *steps);
void hd_steps_clear(hd_steps *steps);

/** Finds the sets from running averages of weights and exponents. Cost O(n subspaces). */
void hd_steps_find(hd_steps *steps, const hd_spectrum *spectrum);
const hd_modes *hd_steps_modes(const hd_steps *steps); /**< the weights in which steps are found */
/** First column of any resolved step; INT_MAX if there is none. */
int hd_steps_first(const hd_steps *steps);

/** Standard error of the sum over the resolved steps of factor(step, context) times exponent,
 * without what mixing adds; see hd_spectrum_error_of_sum. `spectrum` as in hd_steps_find. */
double hd_steps_error_of_sum(const hd_steps *steps, const hd_spectrum *spectrum,
                             double (*factor)(const hd_step *, const void *), const void *context);

/** The relation in the scene of the steps. kind: HD_MODE_T or HD_MODE_LP. */
const hd_relation *hd_steps_relation(const hd_steps *steps, hd_mode_kind kind);

double hd_steps_bytes(const hd_scene_def *scene);
void hd_steps_archive(hd_steps *steps, hd_archive *archive);

#endif
