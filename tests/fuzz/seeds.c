/** Checkpoints to begin with, of runs of 2, 4 and 10 disks in each phase, with and without modes,
 * and of one that has phases to follow: written to the folder HDLYAP_SEEDS, if it is set, before
 * the fuzzer reads its folders. */
#include <stdio.h>
#include <stdlib.h>

#include "hdlyap/checkpoint.h"

static hd_scene_def scene_of(int disks, int exponents, unsigned observe)
{
    hd_scene_def def = hd_scene_def_default();
    def.number = disks;
    def.density = 0.5;
    def.aspect = 1.0;
    def.boundary[1] = disks == 4 ? HD_REFLECTING : HD_PERIODIC;
    def.exponents = exponents;
    def.equilibration = 1.0;
    def.warmup = 2.0;
    def.duration = 20.0;
    def.report_interval = 2.0;
    def.observe = observe;
    def.threads = 1;
    return def;
}

/** Its checkpoint soon after the beginning of each phase, and in the middle of the last; 0 if all
 * are written. */
static int save_run(const char *folder, const char *name, const hd_scene_def *def)
{
    static const double times[] = {0.1, 1.5, 4.0, 13.0};
    hd_run *run = NULL;
    char path[512], line[256] = "";
    hd_status status = hd_run_create(&run, def, line, sizeof line);
    for (int k = 0; k < 4 && status == HD_OK; k++) {
        while (status == HD_OK && hd_run_time(run) < times[k]) status = hd_run_advance(run);
        snprintf(path, sizeof path, "%s/%s_%d", folder, name, k);
        if (status == HD_OK) status = hd_run_save(run, path, name, line, sizeof line);
    }
    hd_run_free(run);
    if (status != HD_OK) fprintf(stderr, "%s: %s %s\n", name, hd_status_text(status), line);
    return status != HD_OK;
}

static int save_all(const char *folder)
{
    static const unsigned modes = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES |
                                  HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION;
    static const struct {
        const char *name;
        int exponents;
        unsigned observe;
    } kinds[] = {{"events", HD_EXPONENTS_NONE, HD_OBSERVE_GAS},
                 {"spectrum", HD_EXPONENTS_ALL, 0},
                 {"modes", HD_EXPONENTS_POSITIVE, modes}};
    static const int disks[] = {2, 4, 10};
    int failed = 0;
    hd_scene_def steps = scene_of(24, HD_EXPONENTS_POSITIVE,
                                  modes | HD_OBSERVE_T_PHASES | HD_OBSERVE_HYDRO |
                                      HD_OBSERVE_STRUCTURE);
    steps.density = 0.8;
    steps.aspect = 0.1; /* LP(1,0) and T(1,0) are resolved in the last */
    failed = save_run(folder, "steps_24", &steps);
    for (int k = 0; k < 9 && !failed; k++) {
        const hd_scene_def def = scene_of(disks[k / 3], kinds[k % 3].exponents,
                                          kinds[k % 3].observe);
        char name[32];
        snprintf(name, sizeof name, "%s_%d", kinds[k % 3].name, disks[k / 3]);
        failed = save_run(folder, name, &def);
    }
    return failed;
}

int LLVMFuzzerInitialize(int *argc, char ***argv);

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    const char *folder = getenv("HDLYAP_SEEDS");
    (void)argc, (void)argv;
    if (folder && save_all(folder)) exit(2);
    return 0;
}
