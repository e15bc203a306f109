/** A scene and its run -> how many there are of what messages list. */
#include "topics/extent.h"

#include <stdlib.h>

#include "hdlyap_ros/messages.h"

/** Kinds of fields of all wave vectors. */
static double subspaces_of(const hd_scene_def *def)
{
    const int count = hd_waves(def, NULL, 0);
    double subspaces = 0.0;
    hd_wave *wave = malloc(((size_t)count + 1) * sizeof *wave);
    if (!wave) return 2.0 * count;
    hd_waves(def, wave, count);
    for (int k = 0; k < count; k++) {
        subspaces += hd_wave_transverse(&wave[k], def->boundary).count > 0;
        subspaces += hd_wave_pairs(&wave[k], def->boundary).count > 0;
    }
    free(wave);
    return subspaces;
}

/** Those of the steps of which one vector each is published. */
static void count_examples(extent *e, const hd_steps *steps)
{
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        if (step->kind == HD_MODE_ZERO || step->conjugate) continue;
        e->fields++;
        if (step->kind == HD_MODE_LP) e->pairs += step->expected / 2;
    }
}

extent extent_of(const settings *set, const hd_run *run)
{
    const hd_scene_def *def = &set->def;
    const int known = hd_scene_positive_exponents(def) + hd_scene_zero_exponents(def);
    extent e = {.disks = def->disks, .vectors = hd_scene_vectors(def)};
    if (def->observe & HD_OBSERVE_STRUCTURE) e.waves = hd_structure_waves_of(def);
    if (def->observe & HD_OBSERVE_COVARIANT) e.subspaces = subspaces_of(def);
    if (e.vectors > known) e.angles = HD_PAIRS_OF_SPACES;
    const hd_steps *steps = hd_run_steps(run);
    if (!steps) return e;
    e.steps = hd_steps_count(steps);
    count_examples(&e, steps);
    if (set->fields.count > 0) { /* of steps that are not known yet */
        e.fields = set->fields.count;
        e.pairs = HD_MODULATIONS_MAX * e.fields;
    }
    if (hd_run_phases(run)) e.phases = hd_phases_count(hd_run_phases(run));
    if (hd_run_t_phases(run)) e.t_phases = hd_phases_count(hd_run_t_phases(run));
    if (hd_run_hydro(run)) e.responses = hd_hydro_count(hd_run_hydro(run));
    return e;
}

topic_size topic_size_of(topic t, const extent *e)
{
    const topic_size sizes[TOPICS] = {
#define TOPIC(name, type, stages, is, ...) [TOPIC_##name] = {__VA_ARGS__},
#include "topics/rows.inc"
#undef TOPIC
    };
    return sizes[t];
}
