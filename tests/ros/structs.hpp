/** Structs of the core's public headers as JSON: of those that messages are made from, the members
 * that rows of published.txt read. */
#pragma once

#include "hdlyap/fluctuations.h"
#include "hdlyap/hdlyap.h"
#include "json.hpp"

namespace
{
int vectors(); /**< of the run */

/* clang-format off */
#define M(m) {#m, of.m}
#define SAYS(type, ...) members say(const type &of) { return named({__VA_ARGS__}); }
SAYS(hd_mean, M(name), M(unit), M(mean), M(std_error))
SAYS(hd_gas_means, M(time), M(collision_rate), M(collision_rate_error), M(pressure_error), M(pressure_of),
     M(pressure_of_error), M(compressibility), M(compressibility_error), M(temperature), M(temperature_error),
     M(potential_energy), M(potential_energy_error), M(pair_rate), M(pair_rate_error), M(pair_rate_expected),
     M(compressibility_expected), M(shear_stress), M(shear_stress_error), M(wall_velocity), M(wall_velocity_error),
     M(divergence), M(divergence_error))
SAYS(hd_kind, M(number), M(diameter), M(mass))
SAYS(hd_energy, M(error), M(most), M(asked))
SAYS(hd_cost, M(wall), M(events), M(replay), M(ortho), M(spectrum), M(modes), M(following), M(communication), M(bytes),
     M(calls), M(events_per_second), M(interval), M(limit), M(condition), M(defect), M(error_bound),
     M(orthonormalisations), M(second_passes), M(slow_vector_samples), M(repairs), M(progress), M(remaining),
     M(target.name), M(target.error), M(target.wanted))
SAYS(hd_step, M(kind), M(wave.n), M(wave.number), M(subspace), M(expected), M(conjugate), M(resolved), M(col), M(count),
     M(set), M(multiplicity), M(exponent), M(std_error), M(sharing), M(set_time), M(own_part), M(gap), M(gap_error))
SAYS(hd_dispersion, M(points), M(k_min), M(k_max), M(prior_share), M(c_sampling_error), M(misfit), M(c.value),
     M(c.error), M(c2.value), M(c2.error), M(c3.value), M(c3.error))
SAYS(hd_relation, M(c2), M(c2_error), M(c3), M(c3_error), M(box_error))
SAYS(hd_velocity, M(phases), M(k_min), M(k_max), M(v), M(v_error), M(v_sampling_error), M(misfit))
SAYS(hd_phase, M(step), M(modulation), M(col), M(state), M(a), M(b), M(phase), M(omega), M(omega_error), M(time))
SAYS(hd_hydro_response, M(step), M(col), M(modulation), M(density), M(along), M(across), M(energy), M(across_second))
SAYS(hd_angle_of_spaces, M(last), M(mean), M(std_error), M(least), M(mean_of_all), M(smallest), M(all))
SAYS(hd_spectrum_sums, M(local_time), M(ks_entropy_error), M(exponent_sum_error), M(kaplan_yorke),
     M(kaplan_yorke_error))
SAYS(hd_covariant_results, M(windows), M(lost), M(window_end), M(null), M(null_most), M(splitting.samples),
     M(start_mismatch.centre), M(start_mismatch.stable))
SAYS(hd_subspace, M(kind), M(wave.n), M(wave.number), M(dimension), M(column))
SAYS(hd_wave, M(n), M(number))
SAYS(hd_order_over, M(time), M(count), {"violations", numbers(of.violations, vectors() - 1)},
     {"domination_violations", numbers(of.domination_violations, vectors() - 1)})
#undef M
#undef SAYS
/* clang-format on */

/** A list of `count` of what `value` is at k, and of what the core says of it. */
#define LIST(count, value) list(count, [&](int k) { return value; })
#define EACH(count, value) list(count, [&](int k) { return say(value); })

members say(const hd_spectrum *of)
{
    return named({{"time", hd_spectrum_time(of)},
                  {"exponent", LIST(vectors(), hd_spectrum_exponent(of, k))},
                  {"error", LIST(vectors(), hd_spectrum_std_error(of, k))},
                  {"local", LIST(vectors(), hd_spectrum_local(of, k))},
                  {"sums", say(hd_spectrum_sum_up(of))}});
}

/** Of each vector; none: where particles have no such share. */
json share(const hd_modes *modes, hd_share which, double none)
{
    const double *of = hd_modes_share_average(modes, which);
    return LIST(vectors(), of ? of[k] : none);
}
} // namespace
