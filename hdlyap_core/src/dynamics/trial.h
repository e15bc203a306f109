/** What a test of a row of dynamics (dynamics_test.c, maps_test.c) works with: particles that are
 * moved, kept as the bytes of their archive, and made again from these. */
#ifndef HD_TRIAL_H
#define HD_TRIAL_H

#include <stdbool.h>
#include <stdio.h>

#include "base/random.h"
#include "dynamics/dynamics.h"
#include "dynamics/trajectory.h"

/** A row on trial. */
typedef struct hd_trial {
    const hd_dynamics *of;
    hd_scene_def scene;
    size_t rows; /**< components of a tangent vector; q and p together are as many numbers */
    double unit; /**< (N / 2) / collision_rate: tangent vectors grow by about e [time units] */
    void *maps;
    FILE *file; /**< through which archives go */
    hd_random random;
    char *message; /**< the line that says what is wrong */
    size_t size;
} hd_trial;

/** The bytes of an archive. */
typedef struct hd_image {
    char *bytes;
    size_t size;
} hd_image;

/** Fails with HD_NO_MEMORY or HD_FILE_FAULT; clear it all the same. */
HD_MUST_CHECK hd_status hd_trial_create(hd_trial *trial, const hd_dynamics *row,
                                        const hd_scene_def *scene, char *message, size_t size);
void hd_trial_clear(hd_trial *trial);

/** So many units of time, or less, if they would have too many entries of a record. */
double hd_trial_time(const hd_trial *trial, double units, double entries);
/** Uniform in 0 .. 1. */
double hd_trial_random(hd_trial *trial);

/* Below, a row that does what it must not is HD_REFUSED with a line. */

HD_MUST_CHECK hd_status hd_trial_advance(hd_trial *trial, hd_trajectory *trajectory,
                                         hd_record *record, double t_end);
/** The same for particles that were made from what was kept, which the line says. */
HD_MUST_CHECK hd_status hd_trial_advance_made(hd_trial *trial, hd_trajectory *trajectory,
                                              hd_record *record, double t_end);
/** Keeps the particles as they are now; the caller frees out->bytes. */
HD_MUST_CHECK hd_status hd_trial_keep(hd_trial *trial, hd_image *out, hd_trajectory *trajectory);
/** Makes particles from what was kept. */
HD_MUST_CHECK hd_status hd_trial_make(hd_trial *trial, hd_trajectory **out, const hd_image *image);
/** Makes particles from what was kept, moves them on by `time`, and writes what happened to a
 * record that the caller frees, unless that is NULL; and q, p before and after to begin[rows],
 * end[rows].
 */
HD_MUST_CHECK hd_status hd_trial_go(hd_trial *trial, hd_record **record, double *begin, double *end,
                                    const hd_image *image, double time);
/** Carries block[rows][width] through a part of the record. */
HD_MUST_CHECK hd_status hd_trial_carry(hd_trial *trial, double *block, int width,
                                       const hd_record *record, double begin, double end);

/* Tests of tangent maps (maps_test.c) from a kept state on. */

HD_MUST_CHECK hd_status hd_maps_test_cuts(hd_trial *trial, const hd_image *start);
HD_MUST_CHECK hd_status hd_maps_test_symplectic(hd_trial *trial, const hd_image *start);
HD_MUST_CHECK hd_status hd_maps_test_null(hd_trial *trial, const hd_image *start);
HD_MUST_CHECK hd_status hd_maps_test_zeros(hd_trial *trial, const hd_image *start);
/** (shadows_test.c) */
HD_MUST_CHECK hd_status hd_maps_test_shadows(hd_trial *trial, const hd_image *start);

#endif
