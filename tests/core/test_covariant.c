#include <float.h>
#include <string.h>

#include "runs.h"

static hd_scene_def small(void)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = 24;
    scene.density = 0.7;
    scene.exponents = HD_EXPONENTS_ALL;
    scene.equilibration = 10.0;
    scene.warmup = 100.0;
    scene.duration = 300.0;
    scene.report_interval = 1.0;
    scene.observe = HD_OBSERVE_COVARIANT;
    scene.covariant_window = 50.0;
    scene.covariant_transient = 100.0;
    scene.covariant_sampling = 2.0;
    scene.threads = 1;
    return scene;
}

static void looks(void **state)
{
    (void)state;
    for (int storage = 0; storage < 3; storage++) {
    hd_scene_def scene = small();
    scene.covariant_storage = (hd_storage)storage;
    hd_run *run = created(&scene);
    while (hd_run_phase(run) != HD_FINISHED) CHECK_OK(hd_run_step(run));
    const hd_covariant *c = hd_run_covariant(run);
    const hd_covariant_apart met = hd_covariant_met(c);
    print_message("windows %ld lost %ld null %.2e most %.2e met: each %.2e centre %.2e stable %.2e\n", hd_covariant_windows(c),
                  hd_covariant_lost(c), hd_covariant_null(c), hd_covariant_null_most(c), met.most, met.centre, met.stable);
    const hd_splitting *s = hd_covariant_splitting(c);
    for (int p = 0; p < 3; p++) {
        const hd_angle_of_spaces *a = hd_splitting_angle(s, (hd_pair_of_spaces)p);
        print_message("pair %d mean %.6f +- %.6f least %.6f all %.6f\n", p, a->mean, a->std_error, a->least, a->mean_of_all);
    }
    const hd_spectrum *fw = hd_run_spectrum(run), *bw = hd_covariant_spectrum(c);
    for (int col = 0; col < 96; col += col > 40 && col < 56 ? 1 : 8)
        print_message("%d forward %.5f %.5f covariant %.5f %.5f  neighbours %.3f width %.3f cos %.3f met %.1e viol %.2f %.2f\n", col, hd_spectrum_exponent(fw, col),
                      hd_spectrum_std_error(fw, col), hd_spectrum_exponent(bw, col), hd_spectrum_std_error(bw, col),
                      hd_splitting_neighbours(s)[col], hd_covariant_widths(c)[col], hd_covariant_cosines(c)[col], hd_covariant_met_each(c)[col],
                      hd_splitting_violations(s)[col], hd_splitting_entangled(s)[col]);
    print_message("cost %g of %g\n", hd_run_cost(run).covariant, hd_run_cost(run).wall);
    hd_run_free(run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(looks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
