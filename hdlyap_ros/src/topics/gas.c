/** Means of the gas: collision rate, pressure, energies, and the flow between walls that shear ->
 * message Gas. */
#include "topics/moment.h"

#include <math.h>

hd_status topic_publish_gas(const moment *now)
{
    const hd_gas_means m = hd_gas_read(hd_run_parts(now->run).gas);
    const bool has_z = moment_dimension(now) == 3;
    hdr_gas message = {
        .sim_time = hd_run_time(now->run),
        .averaged_time = m.time,
        .collision_rate = m.collision_rate,
        .collision_rate_error = m.collision_rate_error,
        .collision_rate_11 = m.pair_rate[0],
        .collision_rate_11_error = m.pair_rate_error[0],
        .collision_rate_12 = m.pair_rate[1],
        .collision_rate_12_error = m.pair_rate_error[1],
        .collision_rate_22 = m.pair_rate[2],
        .collision_rate_22_error = m.pair_rate_error[2],
        .expected_rate_11 = m.pair_rate_expected[0],
        .expected_rate_12 = m.pair_rate_expected[1],
        .expected_rate_22 = m.pair_rate_expected[2],
        .pressure = m.pressure,
        .pressure_error = m.pressure_error,
        .pressure_x = m.pressure_of[0],
        .pressure_x_error = m.pressure_of_error[0],
        .pressure_y = m.pressure_of[1],
        .pressure_y_error = m.pressure_of_error[1],
        .pressure_z = has_z ? m.pressure_of[2] : NAN,
        .pressure_z_error = has_z ? m.pressure_of_error[2] : -1.0,
        .compressibility = m.compressibility,
        .compressibility_error = m.compressibility_error,
        .expected_compressibility = m.compressibility_expected,
        .temperature = m.temperature,
        .temperature_error = m.temperature_error,
        .potential_energy = m.potential_energy,
        .potential_energy_error = m.potential_energy_error,
        .shear_stress = m.shear_stress,
        .shear_stress_error = m.shear_stress_error,
        .velocity_low = m.wall_velocity[0],
        .velocity_low_error = m.wall_velocity_error[0],
        .velocity_high = m.wall_velocity[1],
        .velocity_high_error = m.wall_velocity_error[1],
        .divergence = m.divergence,
        .divergence_error = m.divergence_error,
    };
    return m.time > 0.0 ? topic_send_gas(now->out, &message) : HD_OK;
}
