/** Messages as C sees them: views that point into the publisher's own buffers, or into what was
 * received, one struct per message. Field by field the .msg files of the same names, where the
 * units are. Strings are never NULL. */
#ifndef HDLYAP_ROS_MESSAGES_H
#define HDLYAP_ROS_MESSAGES_H

#include <stdbool.h>
#include <stdint.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** float64[]: element k is data[k * stride]. */
typedef struct hdr_doubles {
    const double *data;
    uint32_t count;
    uint32_t stride; /**< in doubles, >= 1 */
} hdr_doubles;

/** uint32[] */
typedef struct hdr_uints {
    const uint32_t *data;
    uint32_t count;
} hdr_uints;

/** uint64[] */
typedef struct hdr_counts {
    const uint64_t *data;
    uint32_t count;
} hdr_counts;

/** uint8[] */
typedef struct hdr_bytes {
    const uint8_t *data;
    uint32_t count;
} hdr_bytes;

/** string[] */
typedef struct hdr_strings {
    const char *const *data;
    uint32_t count;
} hdr_strings;

/** std_msgs/Header */
typedef struct hdr_header {
    hdr_time stamp;
    const char *frame_id;
    uint32_t seq; /**< counts a publisher's messages, filled while publishing: gaps are losses */
} hdr_header;

/** hdlyap/RunInfo */
typedef struct hdr_run_info {
    hdr_header header;
    const char *run_id, *version, *scene;
    uint32_t disks;
    double density, aspect, box_x, box_y;
    const char *boundary_x, *boundary_y, *seed, *exponents;
    uint32_t vectors, zero_exponents;
    double equilibration, warmup, duration, target_std_error;
    double interval, accuracy, report_interval;
    hdr_strings observables;
    double max_wave_number;
    uint32_t max_mode_number;
    hdr_uints wave_nx, wave_ny;
    double covariant_window, covariant_transient, covariant_sampling, covariant_memory;
    const char *covariant_storage;
    const char *field_indices;
    double field_interval;
    hdr_strings wait_for_subscribers;
    double pace;
    double slow_vectors_rate;
    uint32_t slow_vectors_count;
    const char *checkpoint;
    double checkpoint_interval;
    const char *resume;
    double resumed_time;
    uint32_t threads, blas_threads;
    const char *blas_library, *blas_kernel, *blas_threading;
} hdr_run_info;

/** hdlyap/Spectrum */
typedef struct hdr_spectrum {
    hdr_header header;
    const char *run_id;
    double sim_time, averaged_time;
    uint64_t collisions;
    double lambda_max, ks_entropy, pairing_error;
    uint32_t first_index;
    hdr_doubles exponents, std_errors, local_exponents, cos_theta, dp_dq_ratio;
} hdr_spectrum;

/** kind of a vector, of a step */
enum { HDR_MODE_NONE, HDR_MODE_ZERO, HDR_MODE_T, HDR_MODE_LP };

/** hdlyap/Mode */
typedef struct hdr_mode {
    uint32_t index;
    double exponent;
    uint8_t kind;
    uint32_t nx, ny;
    double wave_number, weight, weight_l, weight_p, weight_now, null_x, null_y, null_p;
    int32_t step;
} hdr_mode;

/** hdlyap/Modes */
typedef struct hdr_modes {
    hdr_header header;
    const char *run_id;
    double sim_time, averaged_time;
    uint32_t samples;
    const hdr_mode *modes;
    uint32_t count;
} hdr_modes;

/** hdlyap/Step */
typedef struct hdr_step {
    uint8_t kind;
    uint32_t nx, ny;
    double wave_number;
    bool conjugate, resolved;
    uint32_t expected, first_index, last_index;
    double multiplicity;
    int32_t set;
    uint32_t members;
    double exponent, std_error;
} hdr_step;

/** One of the two fits of hdlyap/Steps. */
typedef struct hdr_fit {
    uint32_t points;
    double c, c_error, c2, c2_error;
} hdr_fit;

/** hdlyap/Steps */
typedef struct hdr_steps {
    hdr_header header;
    const char *run_id;
    double sim_time, averaged_time, threshold;
    const hdr_step *steps;
    uint32_t count;
    hdr_fit t, l;
    uint32_t v_phases;
    double v, v_error;
} hdr_steps;

/** hdr_lp_phase.state */
enum { HDR_LP_UNRESOLVED, HDR_LP_WEAK, HDR_LP_COARSE, HDR_LP_TRACKED };

/** hdlyap/LpPhase */
typedef struct hdr_lp_phase {
    uint32_t step, nx, ny;
    uint8_t modulation;
    uint32_t index;
    uint8_t state;
    double a, b, phase, omega, omega_error, velocity, tracked_time;
} hdr_lp_phase;

/** hdlyap/LpPhases */
typedef struct hdr_lp_phases {
    hdr_header header;
    const char *run_id;
    double sim_time;
    uint32_t samples_per_report;
    const hdr_lp_phase *phases;
    uint32_t count;
} hdr_lp_phases;

/** hdlyap/ModeField */
typedef struct hdr_mode_field {
    hdr_header header;
    const char *run_id;
    double sim_time;
    uint32_t index;
    uint8_t kind;
    uint32_t nx, ny;
    double wave_number, exponent;
    hdr_doubles x, y, px, py;
    hdr_doubles dqx, dqy, dpx, dpy;
    uint32_t pairs;
    hdr_bytes modulation;
    hdr_doubles residual_l, residual_p;
    double rotation_distance;
    hdr_doubles l_x, l_y, p_x, p_y, p_over_px, p_over_py;
} hdr_mode_field;

/** hdlyap/HydroMode */
typedef struct hdr_hydro_mode {
    uint32_t step, index;
    uint8_t kind;
    uint32_t nx, ny;
    uint8_t modulation;
    double density, along, across, energy;
} hdr_hydro_mode;

/** hdlyap/Hydro */
typedef struct hdr_hydro {
    hdr_header header;
    const char *run_id;
    double sim_time;
    const hdr_hydro_mode *responses;
    uint32_t count;
} hdr_hydro;

/** hdr_covariant_angle.spaces */
enum { HDR_UNSTABLE_STABLE, HDR_UNSTABLE_CENTRE, HDR_CENTRE_STABLE };

/** hdlyap/CovariantAngle */
typedef struct hdr_covariant_angle {
    uint8_t spaces;
    double last, mean, std_error, least, mean_of_all;
    hdr_counts smallest_counts, all_counts;
} hdr_covariant_angle;

/** hdlyap/CovariantWeight */
typedef struct hdr_covariant_weight {
    uint8_t kind;
    uint32_t nx, ny;
    double wave_number;
    uint32_t dimension;
    hdr_doubles dq, dp, gram_schmidt;
} hdr_covariant_weight;

/** hdlyap/Covariant */
typedef struct hdr_covariant {
    hdr_header header;
    const char *run_id;
    double sim_time, averaged_time;
    uint32_t windows, lost_windows, looks;
    double seconds;
    uint32_t first_index;
    hdr_doubles exponents, std_errors, local_exponents, apart;
    hdr_doubles neighbour_angles, least_neighbour_angles, violations, entangled;
    hdr_doubles widths, cos_theta;
    double centre_apart, stable_apart, null_angle, largest_null_angle;
    const hdr_covariant_angle *angles;
    uint32_t angle_count;
    const hdr_covariant_weight *weights;
    uint32_t weight_count;
} hdr_covariant;

/** hdlyap/State */
typedef struct hdr_state {
    hdr_header header;
    const char *run_id;
    double sim_time, kinetic_energy;
    hdr_doubles x, y, px, py;
} hdr_state;

/** hdlyap/SlowVectors */
typedef struct hdr_slow_vectors {
    hdr_header header;
    const char *run_id;
    double sim_time;
    hdr_doubles x, y, px, py;
    uint32_t first_index, vectors;
    hdr_doubles exponents;
    hdr_bytes kind;
    hdr_uints nx, ny;
    hdr_bytes pairs;
    hdr_doubles a, b, dqx, dqy;
} hdr_slow_vectors;

/** hdr_cost.phase */
enum { HDR_EQUILIBRATING, HDR_WARMING_UP, HDR_AVERAGING, HDR_FINISHED };

/** In words. */
static inline const char *hdr_phase_name(unsigned phase)
{
    static const char *const names[] = {"equilibrating", "warming up", "averaging", "finished"};
    return phase <= HDR_FINISHED ? names[phase] : "unknown";
}

/** hdr_cost.interval_limit */
enum {
    HDR_LIMIT_SCHEDULE,
    HDR_LIMIT_CONDITION,
    HDR_LIMIT_GROWTH,
    HDR_LIMIT_OVERFLOW,
    HDR_LIMIT_SCENE,
    HDR_LIMIT_EVENTS,
    HDR_LIMIT_LOOK,
    HDR_LIMIT_REPAIR
};

/** hdlyap/Cost */
typedef struct hdr_cost {
    hdr_header header;
    const char *run_id;
    double sim_time;
    uint8_t phase;
    double wall_seconds, events_seconds, replay_seconds, ortho_seconds, spectrum_seconds;
    double modes_seconds, covariant_seconds, publish_seconds, events_per_second;
    double interval;
    uint8_t interval_limit;
    double condition, orthogonality_defect, error_bound;
    uint64_t orthonormalisations, second_passes, looks, repairs;
    double std_error, progress, remaining_seconds;
} hdr_cost;

/** hdr_diagnostic.level */
enum { HDR_DIAGNOSTIC_OK, HDR_DIAGNOSTIC_WARN, HDR_DIAGNOSTIC_ERROR };

typedef struct hdr_key_value {
    const char *key, *value;
} hdr_key_value;

/** diagnostic_msgs/DiagnosticArray with one status; one with several is received as several. */
typedef struct hdr_diagnostic {
    hdr_header header;
    uint8_t level;
    const char *name, *message, *hardware_id;
    const hdr_key_value *values;
    uint32_t count;
} hdr_diagnostic;

/** std_msgs/Float64 */
typedef struct hdr_float64 {
    double data;
} hdr_float64;

/** std_msgs/String */
typedef struct hdr_string {
    const char *data;
} hdr_string;

#ifdef __cplusplus
}
#endif
#endif
