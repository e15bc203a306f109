/** Averages of collisions and their virial -> Gas. */
#include "topics/moment.h"

static topic_size size_of(const extent *e)
{
    (void)e;
    return (topic_size){.report = HDR_GAS_BYTES};
}

static hd_status publish(const moment *now, void *state)
{
    const hd_gas_means m = hd_gas_read(hd_run_gas(now->run));
    hdr_gas message = {
        .sim_time = hd_run_time(now->run),
        .averaged_time = m.time,
        .collision_rate = m.collision_rate,
        .collision_rate_error = m.collision_rate_error,
        .pressure = m.pressure,
        .pressure_error = m.pressure_error,
        .pressure_x = m.pressure_of[0],
        .pressure_x_error = m.pressure_of_error[0],
        .pressure_y = m.pressure_of[1],
        .pressure_y_error = m.pressure_of_error[1],
        .compressibility = m.compressibility,
    };
    (void)state;
    return m.time > 0.0 ? topic_send_gas(now->out, &message) : HD_OK;
}

const topic_maker topic_gas = {.size = size_of, .publish = publish};
