/** Private parameters -> a scene and what to publish of it, or one line that refuses them. */
#ifndef HDLYAP_SETTINGS_H
#define HDLYAP_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>

#include "common/nodes.h"
#include "hdlyap/checkpoint.h"
#include "hdlyap/wave.h"
#include "hdlyap_ros/params.h"

/** The vectors whose fields are published. */
typedef struct field_choice {
    const char *text; /**< as given: steps, or a list; in the params */
    const int *index; /**< [count] Lyapunov indices, from 1; in the params */
    int count;        /**< 0: one vector of each step */
} field_choice;

/** Changes to make while the run goes on. */
typedef struct change_list {
    const char *const *text; /**< [count], as given; in the params */
    int count;
} change_list;

typedef struct settings {
    const hdr_params *given; /**< what these were read from; NULL if from nothing */
    hd_scene_def def;
    const char *scene;     /**< name; in the params, or in the checkpoint */
    const char *particles; /**< name of the particles, e.g. disks */
    char seed[24];         /**< decimal */
    char exponents[16];    /**< as given: positive, all, none or a number */
    unsigned observables;  /**< set of topics: all but run_info, status and cost */
    field_choice fields;
    double slow_vectors_rate; /**< most messages of slow_vectors per wall second */
    /** Number of vectors in each, the last ones with positive exponents; 0: as many as reach the
     * lowest T and LP step. */
    int slow_vectors_count;
    unsigned awaited; /**< set of topics that must have a subscriber before the run starts */
    const char *slow_subscribers; /**< wait or drop; in the params */
    double pace; /**< most simulated time per wall second [time units/s]; 0: no limit */
    change_list changes;
    const char *checkpoint;     /**< file, or ""; in the params */
    double checkpoint_interval; /**< wall seconds between two checkpoints; 0: only at the end and
                                   when a service asks */
    const char *resume;         /**< file to go on from, or ""; in the params */
    char warning[512];          /**< says what is allowed but gives no results; "" if nothing */
    double table; /**< least wall seconds between two tables in the log; 0: no tables */
} settings;

/** Value of `resume`: the file `checkpoint`, if it is there. */
#define RESUME_AUTO "auto"

/** Finds the file to go on from, "" if none. Returns false if the parameter is refused. */
bool settings_resume(const char **path, const hdr_params *params, char *message, size_t size);

/** Reads and checks all parameters. Returns false if it refuses one, with one line in message: the
 * parameter, its value, what is allowed. A parameter that is not given has its value in `kept`, the
 * checkpoint to go on from, or its default if `kept` is NULL. params and kept must outlive the
 * settings. */
bool settings_read(settings *out, const hdr_params *params, const hd_checkpoint *kept,
                   char *message, size_t size);

/** Writes the particles and their box: "36 dumbbells in 24 x 2.5, packing fraction 0.62", "36
 * soft_disks in 24 x 2.5, potential wca, energy 1, time_step 0.0012, integrator verlet", or "8
 * chain, beta 2, energy 1" without a box. */
enum { SYSTEM_SIZE = 400 };
const char *settings_write_system(char text[SYSTEM_SIZE], const settings *set);

/** Writes the nodes of a wave: (1,0), or (1,0,0) in space. */
const char *settings_write_nodes(char text[NODES_SIZE], const hd_scene_def *def,
                                 const hd_wave *wave);

#endif
