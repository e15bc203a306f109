/** A run's disks and what it says of its covariant vectors, window by window, as lines "name number
 * ..." of all digits, for check_covariant_twin.py. The names of what looks find end in what is made
 * of all looks: .now (of the last one), .mean, .least, .sum. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "hdlyap/hdlyap.h"
#include "modes/fields.h"
#include "modes/modes.h"

enum { DISKS_MAX = 16 };

/** Its arguments, in this order. */
enum {
    DISKS = 1,
    DENSITY,
    WALL_X,
    WALL_Y,
    EXPONENTS,
    STEP,
    TRANSIENT,
    WINDOW,
    SAMPLING,
    DURATION,
    ARGUMENTS
};

static hd_scene_def scene_of(char **argument)
{
    double a[ARGUMENTS];
    hd_scene_def scene = hd_scene_def_default();
    for (int k = 1; k < ARGUMENTS; k++) a[k] = strtod(argument[k], NULL);
    scene.number = (int)a[DISKS];
    scene.density = a[DENSITY];
    scene.aspect = 0.9;
    for (int d = 0; d < 2; d++) scene.boundary[d] = a[WALL_X + d] > 0 ? HD_REFLECTING : HD_PERIODIC;
    scene.exponents = (int)a[EXPONENTS];
    scene.observe = HD_OBSERVE_COVARIANT;
    scene.interval = scene.report_interval = a[STEP];
    scene.equilibration = 16.0;
    scene.warmup = scene.covariant_transient = a[TRANSIENT];
    scene.covariant_window = a[WINDOW];
    scene.covariant_sampling = a[SAMPLING];
    scene.duration = a[DURATION];
    scene.threads = 1;
    return scene;
}

static void print(const char *set, const char *name, const double *x, int count)
{
    printf("%s%s", set, name);
    for (int k = 0; k < count; k++) printf(" %.17g", x[k]);
    printf("\n");
}

static void print_counts(const char *name, const long *x)
{
    printf("%s", name);
    for (int k = 0; k < HD_ANGLE_BINS; k++) printf(" %ld", x[k]);
    printf("\n");
}

static void print_state(const hd_run *run)
{
    const int disks = hd_run_scene(run)->number;
    double state[1 + 4 * DISKS_MAX] = {hd_run_time(run)};
    hd_trajectory_state(hd_run_parts(run).trajectory, state + 1, state + 1 + 2 * disks);
    print("", "state", state, 1 + 4 * disks);
}

/** Of each subspace: whether it is of T fields, nodes. */
static void print_scene(const hd_run *run)
{
    double box[2];
    const hd_fields *fields = hd_modes_fields(
        hd_covariant_read(hd_run_parts(run).covariant).half[0]);
    hd_scene_box(hd_run_scene(run), box);
    print("", "box", box, 2);
    for (int s = 0; s < hd_fields_subspaces(fields); s++) {
        const hd_subspace *space = hd_fields_subspace(fields, s);
        printf("subspace %d %d %d\n", space->kind == HD_MODE_T, space->wave.n[0], space->wave.n[1]);
    }
}

static void print_modes(const char *set, const hd_modes *modes)
{
    const hd_fields *fields = hd_modes_fields(modes);
    const int n = hd_modes_vectors(modes), nulls = 3; /* of disks */
    for (int k = 0; k < HD_WEIGHTS * hd_fields_subspaces(fields); k++) {
        const hd_weight which = (hd_weight)(k % HD_WEIGHTS);
        print(set, "weight.now", hd_modes_snapshot(modes, k / HD_WEIGHTS, which), n);
        print(set, "weight.mean", hd_modes_average(modes, k / HD_WEIGHTS, which), n);
    }
    for (int null = 0; null < nulls; null++) {
        print(set, "null.now", hd_modes_null_snapshot(modes, null), n);
        print(set, "null.mean", hd_modes_null_average(modes, null), n);
    }
    for (int column = 0; column < hd_fields_columns(fields) - nulls; column++)
        print(set, "coefficient.now", hd_modes_coefficients(modes, column), n);
    print(set, "norm.now", hd_modes_dq_norms(modes), n);
}

/** Of growth and of shape. */
static void print_vectors(const hd_covariant *c, int disks)
{
    for (int col = 0; col < hd_covariant_read(c).vectors; col++) {
        const double mean = hd_spectrum_exponent(hd_covariant_read(c).spectrum, col),
                     local = hd_spectrum_local(hd_covariant_read(c).spectrum, col),
                     entropy = log(disks * hd_covariant_read(c).widths[col]);
        print("", "rate.mean", &mean, 1);
        print("", "rate.now", &local, 1);
        print("", "entropy.mean", &entropy, 1);
        print("", "cosine.mean", &hd_covariant_read(c).cosines[col], 1);
        print("", "apart.least", &hd_covariant_read(c).start_mismatch_each[col], 1);
    }
    print_modes("dq_", hd_covariant_read(c).half[0]);
    print_modes("dp_", hd_covariant_read(c).half[1]);
    print_modes("frame_", hd_covariant_read(c).of_frame);
}

static void print_spaces(const hd_covariant *c)
{
    const hd_covariant_mismatch apart = hd_covariant_read(c).start_mismatch;
    const double spaces[] = {apart.centre, apart.stable, hd_covariant_read(c).null_most};
    if (!hd_covariant_read(c).splitting.has_spaces) return;
    print("", "spaces_apart.least", spaces, 3);
    for (hd_pair_of_spaces pair = 0; pair < HD_PAIRS_OF_SPACES; pair++) {
        const hd_angle_of_spaces *angle = &hd_covariant_read(c).splitting.angle[pair];
        print("", "angle.now", &angle->last, 1);
        print("", "angle.mean", &angle->mean, 1);
        print("", "angle.least", &angle->least, 1);
        print("", "angle_all.mean", &angle->mean_of_all, 1);
        print_counts("smallest.sum", angle->smallest);
        print_counts("all.sum", angle->all);
    }
}

static void print_window(const hd_covariant *c, int disks)
{
    const int pairs = hd_covariant_read(c).vectors - 1;
    const hd_splitting_results splitting = hd_covariant_read(c).splitting;
    const hd_order_over order = hd_covariant_read(c).order[0];
    printf("window %.17g %ld\n", hd_covariant_read(c).window_end, splitting.samples);
    print_vectors(c, disks);
    print("", "neighbours.mean", splitting.neighbours, pairs);
    print("", "neighbours.least", splitting.neighbours_least, pairs);
    print("", "violated.mean", order.violations, pairs);
    print("", "entangled.mean", order.domination_violations, pairs);
    print_spaces(c);
}

int main(int argc, char **argv)
{
    char message[500] = "";
    hd_run *run = NULL;
    if (argc != ARGUMENTS) return 2;
    const hd_scene_def scene = scene_of(argv);
    if (scene.number > DISKS_MAX) return 2;
    hd_status status = hd_run_create(&run, &scene, message, sizeof message);
    if (status == HD_OK) print_scene(run);
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) {
        const long windows = hd_covariant_read(hd_run_parts(run).covariant).windows;
        status = hd_run_advance(run);
        if (status == HD_OK && hd_run_stage(run) != HD_EQUILIBRATING) print_state(run);
        if (hd_covariant_read(hd_run_parts(run).covariant).windows > windows)
            print_window(hd_run_parts(run).covariant, scene.number);
    }
    hd_run_free(run);
    if (status != HD_OK) fprintf(stderr, "%s %s\n", hd_status_text(status), message);
    return status != HD_OK;
}
