/** Preloaded into the node: after each message, a line in the file WITNESS with its type and what
 * the core's public headers say of the run at that moment, as JSON. What no row of published.txt
 * reads is not here. For the thread that publishes. */
#include <dlfcn.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/publisher.h"
#include "json.hpp"
#include "structs.hpp"

namespace
{
const hd_run *run;
hd_cost cost;          /**< what the core said first after its last step */
bool has_cost;         /**< false until it has been asked */
double begun;          /**< simulated time at the begin */
double stepped, since; /**< when the last step ended: by the clock of waiting, of the day */
/** Wall seconds so far: between steps; of them, in publishing all but run_info, which no report
 * contains; the same at the last step. */
double outside, sending, sent;
double changed[8];                 /**< times from which changes hold */
int steps_made, changes_made, nth; /**< nth: messages of the type fields since the last step */

double seconds(clockid_t clock)
{
    timespec now;
    clock_gettime(clock, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/* ---- what the core says --------------------------------------------------------------------- */

hd_parts parts() { return hd_run_parts(run); }
const hd_scene_def &scene() { return *hd_run_scene(run); }
int vectors() { return hd_run_vectors(run); }
int coordinates() { return scene().number * hd_scene_coordinates(&scene()); }

json sites()
{
    double site[HD_SITES_MAX];
    return numbers(site, hd_scene_sites(&scene(), site));
}

/** With each message. */
members say_run()
{
    const hd_counts counts = hd_scene_counts(&scene());
    const members all = named({{"since", since},
                               {"now", seconds(CLOCK_REALTIME)},
                               {"time", hd_run_time(run)},
                               {"stage", hd_run_stage(run)},
                               {"fields_due", hd_run_fields_due(run)},
                               {"vectors", vectors()},
                               {"positive", counts.positive},
                               {"zero", counts.zero},
                               {"d", hd_scene_dimension(&scene())},
                               {"coordinates", hd_scene_coordinates(&scene())},
                               {"inertia", hd_scene_inertia(&scene())},
                               {"sites", sites()},
                               {"root", LIST(scene().number, hd_scene_root_mass(&scene(), k))},
                               {"N", scene().number}});
    return parts().spectrum ? all + named({{"spectrum", say(parts().spectrum)}}) : all;
}

/** A column of the step of the smallest exponent of a kind. */
int lowest_of(hd_mode_kind kind)
{
    const int step = hd_steps_lowest(parts().steps, kind);
    return step < 0 ? -1 : hd_steps_example(parts().steps, step);
}

members say_steps()
{
    const hd_steps *of = parts().steps;
    const int count = hd_steps_count(of);
    return named({{"steps", EACH(count, *hd_steps_step(of, k))},
                  {"step_of", LIST(vectors(), hd_steps_of_vector(of, k))},
                  {"example", LIST(count, hd_steps_is_shown(of, k) ? hd_steps_example(of, k) : -1)},
                  {"lowest", LIST(2, lowest_of(k ? HD_MODE_LP : HD_MODE_T))}});
}

/** Weights in the fields of each subspace and in the null space, [subspace or part][vectors]. */
members say(const hd_modes *of)
{
    const hd_fields *fields = hd_modes_fields(of);
    const int count = hd_fields_subspaces(fields), nulls = hd_scene_dimension(&scene()) + 1,
              n = vectors();
    return named({{"fields", EACH(count, *hd_fields_subspace(fields, k))},
                  {"weight", LIST(count, numbers(hd_modes_average(of, k, HD_WEIGHT), n))},
                  {"weight_l", LIST(count, numbers(hd_modes_average(of, k, HD_WEIGHT_L), n))},
                  {"weight_p", LIST(count, numbers(hd_modes_average(of, k, HD_WEIGHT_P), n))},
                  {"weight_now", LIST(count, numbers(hd_modes_snapshot(of, k, HD_WEIGHT), n))},
                  {"null", LIST(nulls, numbers(hd_modes_null_average(of, k), n))},
                  {"null_now", LIST(nulls, numbers(hd_modes_null_snapshot(of, k), n))}});
}

members say(const hd_phases *of)
{
    const int count = hd_phases_count(of);
    double error;
    return say_steps() +
           named({{"followed", hd_run_phase_time(run)},
                  {"phases", EACH(count, *hd_phases_phase(of, k))},
                  {"diffusion", LIST(count, hd_phases_diffusion(of, k, &error))},
                  {"diffusion_error", LIST(count, (hd_phases_diffusion(of, k, &error), error))}});
}

/* ---- the same for the message of each topic -------------------------------------------------- */

members beside(const hdr_run_info *)
{
    double box[HD_DIMENSION_MAX] = {}, outline[2][HD_OUTLINE];
    hd_wave waves[256];
    const hd_scene_def *def = &scene();
    const hd_blas blas = hd_blas_query();
    const hd_dynamics *of = hd_dynamics_of(def);
    const int count = def->observe & HD_OBSERVE_WAVES ? hd_waves(def, waves, 256) : 0,
              corners = hd_scene_outline(def, outline[0], outline[1]);
    const auto in_row = [&](const hd_parameter *row, double value) {
        return hd_parameter_is_word(row, value) ? json(hd_parameter_word_of(row, int(value)))
                                                : json(value);
    };
    hd_kind kind[HD_KINDS_MAX];
    int rows;
    const hd_parameter *all = hd_scene_parameters(&rows);
    const auto parameter = [&](int k) {
        const hd_parameter *row = k < rows ? &all[k] : &of->parameter[k - rows];
        return named({{"name", row->name},
                      {"kind", int(row->kind)},
                      {"usual", in_row(row, row->default_value)},
                      {"effect", in_row(row, hd_parameter_effect(row, def))},
                      {"unit", row->unit},
                      {"as_before", !row->may_differ},
                      {"own", k >= rows && !(row->idle && row->idle(def))}});
    };
    if (hd_scene_dimension(def) > 0) hd_scene_box(def, box);
    return named({{"rows", list(rows + of->parameters, parameter)},
                  {"packing", hd_scene_packing(def)},
                  {"kinds", EACH(hd_scene_kinds(def, kind), kind[k])},
                  {"boundary", LIST(3, hd_scene_boundary_word(def, k))},
                  {"box", box},
                  {"waves", EACH(count, waves[k])},
                  {"outline_x", numbers(outline[0], corners)},
                  {"outline_y", numbers(outline[1], corners)},
                  {"ranks", hd_run_ranks(run)},
                  {"threads", hd_run_threads(run)},
                  {"blas_threads", blas.threads},
                  {"blas_library", blas.library},
                  {"blas_kernel", blas.kernel},
                  {"blas_threading", blas.threading},
                  {"version", HDLYAP_VERSION},
                  {"begun", begun},
                  {"change_time", hd_run_change_time(run)},
                  {"changed", numbers(changed, changes_made)}});
}

members beside(const hdr_state *)
{
    const int count = coordinates();
    std::vector<double> q(count), p(count);
    hd_trajectory_state(parts().trajectory, q.data(), p.data());
    return named({{"q", numbers(q.data(), count)}, {"p", numbers(p.data(), count)}});
}

members beside(const hdr_cost *)
{
    return named({{"cost", say(cost)},
                  {"is_caged", hd_run_is_caged(run)},
                  {"energy", say(hd_trajectory_energy(parts().trajectory))},
                  {"sent", sent},
                  {"outside", outside + seconds(CLOCK_MONOTONIC) - stepped}});
}
members beside(const hdr_run_status *) { return beside((const hdr_cost *)nullptr); }

members beside(const hdr_spectrum *)
{
    std::vector<double> cosine(vectors()), ratio(vectors());
    hd_run_dq_dp(run, cosine.data(), ratio.data());
    return named({{"divergence.mean", hd_run_divergence(run)},
                  {"divergence.error", hd_run_divergence_error(run)},
                  {"symplectic", hd_scene_symplectic(&scene())},
                  {"cosine", numbers(cosine.data(), vectors())},
                  {"ratio", numbers(ratio.data(), vectors())},
                  {"collisions", hd_trajectory_totals(parts().trajectory).collisions}});
}

members beside(const hdr_averages *)
{
    const hd_averages *of = parts().averages;
    return named({{"averages.time", hd_averages_time(of)},
                  {"averages.means", EACH(hd_averages_count(of), hd_averages_read(of, k))}});
}

members beside(const hdr_gas *) { return named({{"gas", say(hd_gas_read(parts().gas))}}); }

members beside(const hdr_modes *)
{
    return say_steps() + say(parts().modes) +
           named({{"samples", hd_modes_samples(parts().modes)},
                  {"turning", share(parts().modes, HD_SHARE_TURNING, 0.0)},
                  {"second", share(parts().modes, HD_SHARE_SECOND, NAN)}});
}

members beside(const hdr_steps *)
{
    const hd_steps *of = parts().steps;
    const hd_phases *phases = parts().phases;
    const int count = hd_steps_count(of);
    const hd_dispersion t = hd_steps_dispersion(of, parts().spectrum, HD_MODE_T),
                        l = hd_steps_dispersion(of, parts().spectrum, HD_MODE_LP);
    const auto rate = [&](int step, bool error) {
        double now[2];
        const bool known = phases && hd_phases_rate(phases, step, &now[0], &now[1]);
        return known ? now[error] : error ? -1.0 : NAN;
    };
    hd_velocity none = {};
    none.misfit = -1.0;
    return say_steps() +
           named({{"t", say(t)},
                  {"t_long", say(*t.in_long_boxes)},
                  {"l", say(l)},
                  {"l_long", say(*l.in_long_boxes)},
                  {"rate", LIST(count, rate(k, false))},
                  {"rate_error", LIST(count, rate(k, true))},
                  {"scatter", LIST(count, hd_steps_scatter(of, hd_steps_step(of, k)))},
                  {"velocity", say(phases ? hd_phases_velocity(phases) : none)}});
}

members beside(const hdr_lp_phases *) { return say(parts().phases); }
members beside(const hdr_t_phases *) { return say(parts().t_phases); }

members beside(const hdr_hydro *)
{
    const hd_hydro *of = parts().hydro;
    return say_steps() + named({{"responses", EACH(hd_hydro_count(of), *hd_hydro_at(of, k))}});
}

members beside(const hdr_localization *)
{
    hd_localization *of = parts().localization;
    return named({{"samples", hd_localization_samples(of)},
                  {"widths", numbers(hd_localization_widths(of), vectors())},
                  {"std_errors", LIST(vectors(), hd_localization_width_error(of, k))},
                  {"widths_now", LIST(vectors(), hd_localization_width_now(of, k))}});
}

/** HD_SIN_Z and then HD_SECOND are the bits behind those of the plane. */
members beside(const hdr_structure *)
{
    const hd_structure *of = parts().structure;
    const int waves = hd_structure_waves(of), d = hd_scene_dimension(&scene()), n = vectors(),
              means = hd_run_fields_due(run) ? waves : 0;
    const auto amplitude = [&](hd_direction e, int bits) {
        return numbers(hd_structure_amplitude(of, e, unsigned(bits)), n);
    };
    return named({{"samples", hd_structure_samples(of)},
                  {"waves", EACH(waves, *hd_structure_wave(of, k))},
                  {"along", LIST(means, numbers(hd_structure_mean(of, k, HD_ALONG), n))},
                  {"across", LIST(means, numbers(hd_structure_mean(of, k, HD_ACROSS), n))},
                  {"peak", LIST(n, hd_structure_peak(of, k))},
                  {"amplitude_along", LIST(1 << d, amplitude(HD_ALONG, k))},
                  {"amplitude_across", LIST((d - 1) << d, amplitude(HD_ACROSS, k))}});
}

members beside(const hdr_fluctuations *)
{
    const hd_fluctuations *f = parts().fluctuations;
    const hd_steps *steps = parts().steps;
    const int times = hd_fluctuations_times(f), n = vectors();
    const hd_step_columns of = steps ? hd_fluctuations_steps(f, steps) : hd_step_columns{};
    const int s = of.count;
    const auto columns = [&](int step) { return LIST(of.columns[step], of.own[step][k]); };
    const auto covariance = [&](int k) { return hd_fluctuations_covariance(f, &of, k / s, k % s); };
    const auto reversed = [&](int k) {
        return hd_fluctuations_reversed(f, k / (s * s), &of, k / s % s, k % s);
    };
    return (steps ? say_steps() : members()) +
           named({{"diffusion", LIST(n, hd_fluctuations_diffusion(f, k).value)},
                  {"diffusion_error", LIST(n, hd_fluctuations_diffusion(f, k).error)},
                  {"step", LIST(s, of.step[k])},
                  {"own", list(s, columns)},
                  {"covariance", LIST(s * s, covariance(k).value)},
                  {"covariance_error", LIST(s * s, covariance(k).error)},
                  {"orders", EACH(times, hd_fluctuations_order(f, k))},
                  {"variance", LIST(times * n, hd_fluctuations_variance(f, k / n, k % n))},
                  {"reversed", list(times * s * s, reversed)}});
}

members beside(const hdr_covariant *)
{
    const hd_covariant_results seen = hd_covariant_read(parts().covariant);
    const int n = vectors(), angles = seen.splitting.has_spaces ? HD_PAIRS_OF_SPACES : 0;
    const members all = named(
        {{"covariant", say(seen)},
         {"grown", say(seen.spectrum)},
         {"grown_error", LIST(n, hd_covariant_std_error(&seen, k))},
         {"following", cost.following},
         {"mismatch", numbers(seen.start_mismatch_each, n)},
         {"neighbours", numbers(seen.splitting.neighbours, n - 1)},
         {"neighbours_least", numbers(seen.splitting.neighbours_least, n - 1)},
         {"widths", numbers(seen.widths, n)},
         {"cosines", numbers(seen.cosines, n)},
         {"orders", EACH(seen.times, seen.order[k])},
         {"angles", EACH(angles, seen.splitting.angle[k])}});
    if (!seen.half[0]) return all;
    return all + named({{"dq", say(seen.half[0])},
                        {"dp", say(seen.half[1])},
                        {"frame", say(seen.of_frame)}});
}

/** L and P modes of the step of a vector; empty if it has none. */
members say_pairs(int step)
{
    hd_pmode *of = parts().fields;
    const hd_step *found = step < 0 ? nullptr : hd_steps_step(parts().steps, step);
    const bool has = found && found->kind == HD_MODE_LP &&
                     hd_pmode_reconstruct(of, found, parts().modes, hd_run_vectors_now(run));
    const int d = has ? hd_pmode_pairs(of) : 0, count = coordinates();
    std::vector<double> p(count), divided(count);
    hd_trajectory_state(parts().trajectory, nullptr, p.data());
    const hd_subspace *fields = hd_fields_subspace(hd_modes_fields(parts().modes),
                                                   has ? found->subspace : 0);
    const auto divide = [&](int k) {
        hd_pmode_divide(of, divided.data(), k + d, p.data());
        return numbers(divided.data(), count);
    };
    return named({{"modulation", LIST(d, fields->modulations.bits[k])},
                  {"residual", LIST(2 * d, hd_pmode_residual(of, k))},
                  {"rotation", has ? hd_pmode_rotation_distance(of) : NAN},
                  {"mode", LIST(2 * d, numbers(hd_pmode_field(of, k), count))},
                  {"divided", list(d, divide)}});
}

members beside(const hdr_mode_field *message)
{
    const int col = int(message->index) - 1;
    const hd_columns frame = hd_run_vectors_now(run);
    const members all = beside((const hdr_state *)nullptr) + say_steps() + named({{"nth", nth++}});
    if (col < frame.first || col >= frame.first + frame.count) return all;
    const double *from = frame.data + (col - frame.first);
    return all + named({{"vector", numbers(from, 2 * coordinates(), frame.stride)}}) +
           say_pairs(hd_steps_of_vector(parts().steps, col));
}

/** Only those vectors of which the message is. */
members beside(const hdr_slow_vectors *message)
{
    const hd_columns frame = hd_run_vectors_now(run);
    const int begin = int(message->first_index) - 1, end = begin + int(message->vectors),
              first = begin > frame.first ? begin : frame.first,
              last = end < frame.first + frame.count ? end : frame.first + frame.count;
    const auto vector = [&](int k) {
        return numbers(frame.data + (first - frame.first + k), 2 * coordinates(), frame.stride);
    };
    const members all = beside((const hdr_state *)nullptr) +
                        named({{"first", first}, {"vector", list(last - first, vector)}});
    const hd_modes *modes = parts().modes;
    if (!modes || begin < 0 || end > vectors()) return all;
    const hd_fields *fields = hd_modes_fields(modes);
    const int count = hd_fields_subspaces(fields);
    const hd_subspace *behind = hd_fields_subspace(fields, count - 1);
    const auto coefficients = [&](int column) {
        return numbers(hd_modes_coefficients(modes, column) + begin, end - begin);
    };
    return all + say_steps() +
           named({{"fields", EACH(count, *hd_fields_subspace(fields, k))},
                  {"coefficient", list(behind->column + behind->dimension, coefficients)}});
}

/* ---- between node and core ------------------------------------------------------------------ */

void write_line(const char *type, const members &said)
{
    static std::FILE *out = std::fopen(std::getenv("WITNESS"), "w");
    std::fprintf(out, "{%s}\n", (named({{"type", type}}) + say_run() + said).text.c_str());
    std::fflush(out);
}

/** The core's, or the wrapper's, own function of that name. */
template <class Function> Function real_of(Function, const char *name)
{
    Function real;
    void *found = dlsym(RTLD_NEXT, name);
    if (!found) std::abort();
    std::memcpy(&real, &found, sizeof real);
    return real;
}
#define REAL(function) real_of(&function, #function)

/** Of messages that nothing else is known of. */
template <class message> members beside(const message *) { return {}; }

/** Where a run begins or is changed. */
void change(const hd_run *of)
{
    if (!run) begun = hd_run_time(of);
    if (!run) since = seconds(CLOCK_REALTIME);
    if (run) changed[changes_made++ % 8] = hd_run_change_time(run);
    run = of;
}
const bool is_rare = std::getenv("WITNESS_RARE"); /**< the core says what it seldom says */
} // namespace

#define PUBLISH(type)                                                                              \
    hdr_status type##_publish(hdr_publisher *publisher, const type *message)                       \
    {                                                                                              \
        const double begin = seconds(CLOCK_MONOTONIC);                                             \
        const hdr_status status = REAL(type##_publish)(publisher, message);                        \
        if (status == HDR_OK && std::getenv("WITNESS")) write_line(#type, beside(message));        \
        if (std::strcmp(#type, "hdr_run_info")) sending += seconds(CLOCK_MONOTONIC) - begin;       \
        return status;                                                                             \
    }
HDR_MESSAGES(PUBLISH)

hd_status hd_run_create_shared(hd_run **out, const hd_scene_def *def, hd_communicator *communicator,
                               char *message, size_t size)
{
    const hd_status status = REAL(hd_run_create_shared)(out, def, communicator, message, size);
    if (status == HD_OK) change(*out);
    return status;
}

hd_status hd_run_resume_shared(hd_run **out, const char *path, const hd_scene_def *scene,
                               hd_communicator *communicator, char *message, size_t size)
{
    const hd_status status = REAL(hd_run_resume_shared)(out, path, scene, communicator, message,
                                                        size);
    if (status == HD_OK) change(*out);
    return status;
}

hd_status hd_run_change(hd_run *of, const hd_parameter *row, const char *value, char *message,
                        size_t size)
{
    change(of);
    return REAL(hd_run_change)(of, row, value, message, size);
}

hd_status hd_run_advance(hd_run *of)
{
    if (steps_made++ > 0) outside += seconds(CLOCK_MONOTONIC) - stepped;
    const hd_status status = REAL(hd_run_advance)(of);
    stepped = seconds(CLOCK_MONOTONIC);
    since = seconds(CLOCK_REALTIME);
    sent = sending;
    has_cost = false;
    nth = 0;
    return status;
}

/** Its clock stands still between two steps, so that all are told the same. */
hd_cost hd_run_cost(const hd_run *of)
{
    if (has_cost) return cost;
    has_cost = true;
    cost = REAL(hd_run_cost)(of);
    if (!is_rare) return cost;
    cost.second_passes += 5;
    cost.repairs += 3;
    cost.slow_vector_samples += 9;
    cost.communication = 0.25;
    cost.bytes = 4096;
    cost.calls = 17;
    return cost;
}

bool hd_run_is_caged(const hd_run *of) { return REAL(hd_run_is_caged)(of) || is_rare; }

/** The other way round: phases turn this way in all short runs. */
const hd_phase *hd_phases_phase(const hd_phases *of, int index)
{
    static hd_phase said;
    said = *REAL(hd_phases_phase)(of, index);
    if (is_rare) said.omega = -said.omega;
    return &said;
}

bool hd_phases_rate(const hd_phases *of, int step, double *omega, double *error)
{
    if (!REAL(hd_phases_rate)(of, step, omega, error)) return false;
    if (is_rare) *omega = -*omega;
    return true;
}

hd_covariant_results hd_covariant_read(const hd_covariant *of)
{
    hd_covariant_results results = REAL(hd_covariant_read)(of);
    if (is_rare) results.lost += 2;
    return results;
}
