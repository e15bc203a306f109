/** What the user asks for: private parameters -> a scene and what to publish of it, or one line that
 *  refuses them. */
#ifndef HDLYAP_SETTINGS_H
#define HDLYAP_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"
#include "hdlyap_ros/params.h"

/** Vectors whose fields are published. */
typedef struct field_choice {
    const char *text; /**< as asked for: steps, or a list; in the params */
    const int *index; /**< [count] Lyapunov indices, from 1; in the params */
    int count;        /**< 0: one of each step */
} field_choice;

typedef struct settings {
    hd_scene_def def;
    const char *scene;    /**< name; in the params */
    char seed[24];        /**< decimal */
    char exponents[16];   /**< as asked for: positive, all, none or a number */
    unsigned observables; /**< set of topics: all but run_info and cost */
    field_choice fields;
    unsigned awaited; /**< set of topics that must have a subscriber before the run starts */
    double pace;      /**< time units per wall second, 0 = as fast as it goes */
} settings;

/** False if refused, with one line in message: the parameter, its value, what is allowed. The params
 *  must outlive the settings. */
bool settings_read(settings *out, const hdr_params *params, char *message, size_t size);

#endif
