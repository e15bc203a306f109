/** The gas of spheres: the equation of state of Carnahan and Starling; what else holds of it is in
 * observe/test_gas.c. Seeds are fixed: what is Z standard errors off passes or fails
 * for good. */
#include "testing.h"

static const double Z = 3.0;

/** After 100 collisions of each sphere. */
static hd_trajectory *equilibrated(const hd_scene_def *def)
{
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create(&tr, def));
    CHECK_OK(
        hd_trajectory_extend(tr, NULL, 50.0 * def->number / hd_trajectory_totals(tr).expected));
    return tr;
}

/** By samples of about `each` collisions of a sphere. */
static hd_gas_means averaged(const hd_scene_def *def, int samples, double each)
{
    OWNED(hd_trajectory) *tr = equilibrated(def);
    const double dt = 0.5 * each * def->number / hd_trajectory_totals(tr).expected;
    MADE(hd_gas, gas, def, 0.0);
    hd_gas_begin(gas, tr);
    for (int k = 0; k < samples; k++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, hd_trajectory_time(tr) + dt));
        hd_gas_add(gas, tr);
    }
    return hd_gas_read(gas);
}

/** Good to 0.3 % below freezing (0.943); N spheres differ from infinitely many by some 1 / N, and
 * their kT = 2/3 N / (N - 1). */
TEST(carnahan_and_starling)
{
    static const double density[] = {0.1, 0.5, 0.9, 0.3, 0.7};
    for (int k = 0; k < (second_tier() ? 5 : 3); k++) {
        const hd_scene_def def = box_of(500, density[k], 1.0, 1.0, 0, 21);
        const double eta = PI * density[k] / 6.0, cube = pow(1.0 - eta, 3.0), allowed = 0.01;
        const double kt = 2.0 / 3.0 * 500 / 499, contact = (1.0 - 0.5 * eta) / cube;
        const double rate = 4.0 * sqrt(PI * kt) * density[k] * contact;
        const double z = (1.0 + eta + eta * eta - eta * eta * eta) / cube;
        const hd_gas_means m = averaged(&def, 48, HD_SANITIZED ? 4.0 : 24.0);
        assert_true(HD_SANITIZED || Z * m.pressure_error < allowed * m.pressure);
        CHECK_CLOSE(m.collision_rate, rate, allowed * rate);
        CHECK_CLOSE(m.compressibility, z, allowed * z);
        CHECK_CLOSE(m.pressure, 2.0 / 3.0 * density[k] * z, allowed * m.pressure);
        for (int d = 0; d < 3; d++)
            CHECK_CLOSE(m.pressure_of[d], m.pressure,
                        Z * hypot(m.pressure_of_error[d], m.pressure_error));
        MADE(hd_trajectory, tr, &def);
        CHECK_CLOSE(hd_trajectory_totals(tr).expected, 250.0 * rate, 0.01 * 250.0 * rate);
        /* mean speed sqrt(8 kT / pi), of collisions */
        CHECK_CLOSE(hd_scene_mean_free_path(&def), sqrt(8.0 * kt / PI) / rate,
                    0.002 * hd_scene_mean_free_path(&def));
    }
}

/** Of a thin gas sqrt(5/3 kT); of a dense one by differences of the equation of state. */
TEST(sound_crosses_the_longest_edge)
{
    for (double density = 1e-4; density < 1.0; density += 0.2) {
        const hd_scene_def def = box_of(500, density, 0.5, 3.0, 0, 1);
        double box[3], z[3];
        for (int k = 0; k < 3; k++) {
            const double eta = PI / 6.0 * density * (1.0 + (k - 1) * 1e-5);
            z[k] = (1.0 + eta + eta * eta - eta * eta * eta) / pow(1.0 - eta, 3.0);
        }
        hd_scene_box(&def, box);
        const double slope = z[1] + (z[2] - z[0]) / 2e-5; /* of rho Z */
        const double c = sqrt(2.0 / 3.0 * (slope + 2.0 / 3.0 * z[1] * z[1]));
        CHECK_CLOSE(hd_scene_sound_crossing(&def), box[2] / c, 1e-6 * box[2] / c);
    }
}
