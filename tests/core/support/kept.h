/** Runs and their bytes, as the tests of checkpoints use them. */
#ifndef HD_KEPT_H
#define HD_KEPT_H

#include "run/checkpoint.h"
#include "testing.h"

enum {
    KEPT_ALL = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES |
               HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION | HD_OBSERVE_FLUCTUATIONS,
    KEPT_AT_REPORTS = KEPT_ALL | HD_OBSERVE_STRUCTURE | HD_OBSERVE_HYDRO /**< with all vectors at
                                                                            each */
};
/** Before the elements of an array in the bytes. */
enum { KEPT_HEAD = HD_ARCHIVE_NAME + 16 };

#define KEPT_LABEL "a label"

/** A short run of a periodic box, on one thread. */
hd_scene_def kept_scene(int disks, double density, double aspect, int exponents, unsigned observe);

hd_run *kept_run(hd_scene_def def);

/** Takes so many steps, or fewer if the run ends; returns how many. */
int kept_steps(hd_run *run, int count);

/** The run, written to that file and read from it. */
hd_run *kept_and_resumed(hd_run *run, const char *path, const hd_scene_def *scene);

/** To be freed: data. */
typedef struct bytes {
    char *data;
    size_t size;
} bytes;

bytes kept_bytes(hd_run *run); /**< its arrays */
/** As hd_run_read of them. */
hd_status kept_read(hd_run **run, const bytes *b, const hd_scene_def *scene, char *message,
                    size_t size);
bytes kept_file(const char *path);

/** Of the elements of the array that begins there. */
size_t kept_element_size(const char *array);
/** Of the array that begins there, with its head. */
size_t kept_array_size(const char *array);

#endif
