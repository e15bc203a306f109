/* A node in C: computes the spectrum of four disks with the core, publishes it through the wrapper
 * until it is stopped. */
#include <hdlyap/hdlyap.h>
#include <hdlyap_ros/hdlyap_ros.h>

#include <stdio.h>
#include <time.h>

enum { EXPONENTS = 5 };

static hd_status compute(hd_run **run, double *exponents)
{
    hd_scene_def def = hd_scene_def_default();
    def.number = 4;
    def.density = 0.5;
    def.aspect = 1.0;
    def.equilibration = def.warmup = 10.0;
    def.duration = 100.0;
    hd_status status = hd_run_create(run, &def, NULL, 0);
    while (status == HD_OK && hd_run_stage(*run) != HD_FINISHED) status = hd_run_advance(*run);
    for (int col = 0; status == HD_OK && col < EXPONENTS; col++)
        exponents[col] = hd_spectrum_exponent(hd_run_parts(*run).spectrum, col);
    return status;
}

static hdr_status publish_until_stopped(hdr_node *ros, const double *exponents)
{
    const struct timespec period = {.tv_nsec = 100000000};
    const hdr_doubles values = {.data = exponents, .count = EXPONENTS, .stride = 1};
    hdr_publisher *publisher;
    hdr_status status = hdr_spectrum_advertise(&publisher, ros, "spectrum", 1);
    while (status == HDR_OK && !hdr_stop_requested()) {
        const hdr_spectrum message = {
            .header = {.stamp = hdr_time_now(), .frame_id = "box"},
            .run_id = "downstream",
            .lambda_max = exponents[0],
            .first_index = 1,
            .exponents = values,
        };
        status = hdr_spectrum_publish(publisher, &message);
        nanosleep(&period, NULL);
    }
    return status;
}

int main(int argc, char **argv)
{
    hd_run *run = NULL;
    hdr_node *ros;
    double exponents[EXPONENTS];
    const hd_status status = compute(&run, exponents);
    hd_run_free(run);
    if (status != HD_OK) {
        fprintf(stderr, "%s\n", hd_status_text(status));
        return 3;
    }
    if (hdr_node_create(&ros, &argc, argv, "talker", 1.0, 3) != HDR_OK) {
        fprintf(stderr, "%s\n", hdr_error_text());
        return 1;
    }
    const hdr_status published = ros ? publish_until_stopped(ros, exponents) : HDR_OK;
    hdr_node_free(ros, 0.0);
    return published == HDR_OK ? 0 : 1;
}
