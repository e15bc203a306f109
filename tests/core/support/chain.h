/** A chain by hand, a dynamics of one's own, and scenes of it. */
#ifndef HD_CHAIN_H
#define HD_CHAIN_H

#include "chain_by_hand.h"
#include "runs.h"

enum { N = 8, ROWS = 2 * N };

/** So much energy that gaps between exponents are wide: .63 .54 .45 .36 .25 .14 0 0 with beta = 10.
 */
static inline hd_scene_def chain_of(int count, double beta, int exponents)
{
    hd_scene_def scene = hd_scene_def_of(&of_chain);
    scene.number = count;
    scene.own[BETA].real = beta;
    scene.own[ENERGY].real = 10.0;
    scene.own[STEP].real = 0.005;
    scene.exponents = exponents;
    scene.equilibration = 50.0;
    scene.duration = 400.0;
    scene.threads = 1;
    return scene;
}

static inline hd_scene_def with_covariant(int exponents)
{
    hd_scene_def scene = chain_of(N, 10.0, exponents);
    scene.observe = HD_OBSERVE_COVARIANT | HD_OBSERVE_LOCALIZATION;
    scene.warmup = scene.covariant_transient = 100.0;
    scene.covariant_window = 50.0;
    scene.covariant_sampling = 5.0;
    return scene;
}

static inline void check_refused(hd_scene_def scene, const char *line)
{
    char message[256] = "";
    hd_run *run;
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, line);
}

#endif
