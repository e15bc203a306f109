/** The node's topics out. */
#include "publishers.h"

#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { QUEUE_MIN = 8, QUEUE_MAX = 1000 };
/** For each subscriber that is behind. */
static const double queue_bytes = 128e6;

typedef hdr_status (*advertise_function)(hdr_publisher **, hdr_node *, const char *, int);

static const advertise_function advertise[TOPICS] = {
    [TOPIC_RUN_INFO] = hdr_run_info_advertise_latched,
    [TOPIC_SPECTRUM] = hdr_spectrum_advertise,
    [TOPIC_MODES] = hdr_modes_advertise,
    [TOPIC_STEPS] = hdr_steps_advertise,
    [TOPIC_LP_PHASES] = hdr_lp_phases_advertise,
    [TOPIC_T_PHASES] = hdr_t_phases_advertise,
    [TOPIC_FIELDS] = hdr_mode_field_advertise,
    [TOPIC_HYDRO] = hdr_hydro_advertise,
    [TOPIC_STRUCTURE] = hdr_structure_advertise,
    [TOPIC_COVARIANT] = hdr_covariant_advertise,
    [TOPIC_LOCALIZATION] = hdr_localization_advertise,
    [TOPIC_GAS] = hdr_gas_advertise,
    [TOPIC_STATE] = hdr_state_advertise,
    [TOPIC_STATUS] = hdr_run_status_advertise_latched,
    [TOPIC_COST] = hdr_cost_advertise,
};

/** Start, process, seed: no two runs share all three. */
static void run_id_write(char *run_id, size_t size, const char *seed)
{
    struct timespec now;
    struct tm utc;
    char date[32];
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(date, sizeof date, "%Y%m%dT%H%M%S", &utc);
    snprintf(run_id, size, "%s.%06ldZ-%ld-%s", date, now.tv_nsec / 1000, (long)getpid(), seed);
}

/** Messages of that many doubles that a queue may keep. */
static int queue_length(double doubles)
{
    const double messages = queue_bytes / (8.0 * doubles + 1000.0);
    return (int)fmax(QUEUE_MIN, fmin(QUEUE_MAX, messages));
}

hdr_status publishers_advertise(publishers *out, hdr_node *ros, unsigned set,
                                const double doubles[TOPICS], const char *seed)
{
    hdr_status status = HDR_OK;
    *out = (publishers){.node = hdr_node_name(ros)};
    run_id_write(out->run_id, sizeof out->run_id, seed);
    for (topic t = 0; t < TOPICS && status == HDR_OK; t++) {
        char name[32];
        snprintf(name, sizeof name, "~%s", topic_name(t));
        if (set & topic_bit(t))
            status = advertise[t](&out->publisher[t], ros, name, queue_length(doubles[t]));
        if (out->publisher[t] && status == HDR_OK) status = hdr_publisher_wait(out->publisher[t]);
    }
    return status;
}

unsigned publishers_subscribed(const publishers *out)
{
    unsigned set = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (out->publisher[t] && hdr_publisher_subscribers(out->publisher[t]) > 0)
            set |= topic_bit(t);
    return set;
}

static bool is_worse(hdr_lag a, hdr_lag b)
{
    return a.lost != b.lost ? a.lost > b.lost : a.seconds > b.seconds;
}

hdr_lag publishers_lag(const publishers *out)
{
    hdr_lag worst = {.topic = ""};
    for (topic t = 0; t < TOPICS; t++) {
        if (!out->publisher[t]) continue;
        const hdr_lag lag = hdr_publisher_lag(out->publisher[t]);
        if (is_worse(lag, worst)) worst = lag;
    }
    return worst;
}

const char *message_frame(void) { return "box"; }

hdr_header message_header(void)
{
    return (hdr_header){.stamp = hdr_time_now(), .frame_id = message_frame()};
}

hd_status publishers_sent(hdr_status status, topic t)
{
    if (status == HDR_NOT_FINITE) return HD_NOT_FINITE;
    if (status != HDR_OK) hdr_log(HDR_ERROR, "%s not sent: %s", topic_name(t), hdr_error_text());
    return HD_OK;
}

bool message_finite(const double *x, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!isfinite(x[k])) return false;
    return true;
}
