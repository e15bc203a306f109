/** The stiff limit: the less energy soft particles have, the more they are hard disks.
 *
 * Near r = 1 the potential power is 1600 (1 - r)^4: at energy E per particle pairs overlap by some
 * (E / 1600)^(1/4), and a meeting takes as long as that way. So lambda_1 / sqrt(E) of two differs
 * from that of hard disks by E^(1/4), at first. */
#include "runs.h"
#include "soft.h"

typedef struct known {
    double value, error;
} known;

/** lambda_1 of two particles at density 0.4, momenta of order 1; energy = 0: hard disks. */
static known largest(double energy, double duration)
{
    hd_scene_def def = soft_box(2, HD_POWER, HD_PEFRL, 0.0, 2, sqrt(2.0 / 0.4));
    if (energy == 0.0)
        def = scene(.number = 2, .density = 0.4, .aspect = 1.0, .seed = 7, .threads = 1);
    else
        def.own[HD_SOFT_ENERGY].real = energy;
    const double unit = energy == 0.0 ? 1.0 : 1.0 / sqrt(energy);
    def.exponents = 1;
    def.equilibration = def.warmup = 50.0 * unit;
    def.duration = duration * unit;
    OWNED(hd_run) *run = finished(def);
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    return (known){unit * hd_spectrum_exponent(spectrum, 0),
                   unit * hd_spectrum_std_error(spectrum, 0)};
}

TEST(stiff_particles_have_the_largest_exponent_of_hard_disks)
{
    const double coarse_energy = 1e-3, fine_energy = 1e-5, z = 4.0;
    const known hard = largest(0.0, 3e5), coarse = largest(coarse_energy, 1.5e4),
                fine = largest(fine_energy, 1.5e4);
    const double root = pow(coarse_energy / fine_energy, 0.25),
                 limit = (root * fine.value - coarse.value) / (root - 1.0),
                 error = hypot(hard.error, hypot(root * fine.error, coarse.error) / (root - 1.0));
    print_message("%.4f and %.4f lead to %.4f +- %.4f, hard disks have %.4f\n", coarse.value,
                  fine.value, limit, error, hard.value);
    assert_true(z * error < 0.03 * hard.value);
    CHECK_CLOSE(limit, hard.value, z * error);
    CHECK_WITHIN(coarse.value, 0.94 * hard.value, 0.97 * hard.value); /* it is a limit */
}
