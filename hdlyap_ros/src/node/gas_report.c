/** Averages of collisions and their virial -> Gas. */
#include "gas_report.h"

/** An error that is not known has one value. */
static double known(double error) { return error < 0.0 ? -1.0 : error; }

hd_status gas_report_publish(const publishers *to, const hd_run *run)
{
    const hd_gas_means m = hd_gas_read(hd_run_gas(run));
    const hdr_gas message = {
        .header = message_header(),
        .run_id = to->run_id,
        .sim_time = hd_run_time(run),
        .averaged_time = m.time,
        .collision_rate = m.collision_rate,
        .collision_rate_error = known(m.collision_rate_error),
        .pressure = m.pressure,
        .pressure_error = known(m.pressure_error),
        .pressure_x = m.pressure_of[0],
        .pressure_x_error = known(m.pressure_of_error[0]),
        .pressure_y = m.pressure_of[1],
        .pressure_y_error = known(m.pressure_of_error[1]),
        .compressibility = m.compressibility,
    };
    const double numbers[] = {
        message.sim_time,         message.collision_rate, message.collision_rate_error,
        message.pressure,         message.pressure_error, message.pressure_x,
        message.pressure_x_error, message.pressure_y,     message.pressure_y_error,
        message.compressibility};
    if (!(m.time > 0.0)) return HD_OK;
    if (!message_finite(numbers, sizeof numbers / sizeof *numbers)) return HD_NOT_FINITE;
    return publishers_sent(hdr_gas_publish(to->publisher[TOPIC_GAS], &message), TOPIC_GAS);
}
