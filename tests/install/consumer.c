/* The smallest user of an installed hdlyap_core: four disks, their positive exponents. */
#include <hdlyap/hdlyap.h>

#include <stdio.h>

int main(void)
{
    hd_scene_def def = hd_scene_def_default();
    def.number = 4;
    def.density = 0.5;
    def.aspect = 1.0;
    def.equilibration = def.warmup = 10.0;
    def.duration = 100.0;

    char message[256];
    hd_run *run = NULL;
    hd_status status = hd_run_create(&run, &def, message, sizeof message);
    if (status == HD_REFUSED) {
        fprintf(stderr, "%s\n", message);
    }
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) {
        status = hd_run_advance(run);
    }
    if (status != HD_OK) {
        fprintf(stderr, "%s\n", hd_status_text(status));
        hd_run_free(run);
        return 1;
    }
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    for (int col = 0; col < hd_run_vectors(run); col++) {
        printf("%d %.3f\n", col + 1, hd_spectrum_exponent(spectrum, col));
    }
    hd_run_free(run);
    return 0;
}
