/** Messages as C sees them: views that point into the caller's buffers, one struct per message.
 *  Field by field the .msg files of the same names, where the units are. Strings are never NULL. */
#ifndef HDLYAP_ROS_MESSAGES_H
#define HDLYAP_ROS_MESSAGES_H

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

/** string[] */
typedef struct hdr_strings {
    const char *const *data;
    uint32_t count;
} hdr_strings;

/** std_msgs/Header; its seq is filled while publishing. */
typedef struct hdr_header {
    hdr_time stamp;
    const char *frame_id;
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
    double pace;
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

/** hdlyap/State */
typedef struct hdr_state {
    hdr_header header;
    const char *run_id;
    double sim_time, kinetic_energy;
    hdr_doubles x, y, px, py;
} hdr_state;

/** hdr_cost.phase */
enum { HDR_EQUILIBRATING, HDR_WARMING_UP, HDR_AVERAGING, HDR_FINISHED };

/** hdlyap/Cost */
typedef struct hdr_cost {
    hdr_header header;
    const char *run_id;
    double sim_time;
    uint8_t phase;
    double wall_seconds, events_seconds, replay_seconds, ortho_seconds, spectrum_seconds;
    double publish_seconds, events_per_second;
    double interval, condition, orthogonality_defect, error_bound;
    uint64_t orthonormalisations, second_passes, repairs;
    double progress, remaining_seconds;
} hdr_cost;

/** hdr_diagnostic.level */
enum { HDR_DIAGNOSTIC_OK, HDR_DIAGNOSTIC_WARN, HDR_DIAGNOSTIC_ERROR };

typedef struct hdr_key_value {
    const char *key, *value;
} hdr_key_value;

/** diagnostic_msgs/DiagnosticArray with one status */
typedef struct hdr_diagnostic {
    hdr_header header;
    uint8_t level;
    const char *name, *message, *hardware_id;
    const hdr_key_value *values;
    uint32_t count;
} hdr_diagnostic;

#ifdef __cplusplus
}
#endif
#endif
