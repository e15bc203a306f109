/** One scene from its creation to its end, for valgrind. Usage: hdlyap_load disks density aspect x
 * y exponents observe time; x, y: 0 periodic, 1 reflecting; time: averaged. */
#include <hdlyap/hdlyap.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/scenes.h"

int main(int argc, char **argv)
{
    double x[8];
    if (argc != 9) return 2;
    for (int k = 0; k < 8; k++) x[k] = atof(argv[k + 1]);
    const hd_scene_def scene = scene(.number = (int)x[0], .density = x[1], .aspect = x[2],
                                     .boundary[0] = (hd_boundary)x[3],
                                     .boundary[1] = (hd_boundary)x[4], .exponents = (int)x[5],
                                     .observe = (unsigned)x[6], .duration = x[7],
                                     .equilibration = 5.0, .warmup = 5.0, .threads = 1);
    hd_run *run;
    hd_status status = hd_run_create(&run, &scene, NULL, 0);
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
    if (status != HD_OK)
        fprintf(stderr, "hdlyap_load: %s\n", hd_status_text(status));
    else
        printf("vectors %d\n", hd_run_vectors(run));
    hd_run_free(run);
    return status != HD_OK;
}
