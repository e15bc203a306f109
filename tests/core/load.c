/** One scene from its creation to its end, for callgrind to count the instructions of: each part is
 * a function of its own, by whose name they are collected. Usage: load disks density aspect x y
 * exponents observe look time x, y: 0 periodic, 1 reflecting; look: stages of `observe` that
 * somebody looks at; time: averaged. */
#include <hdlyap/hdlyap.h>
#include <stdio.h>
#include <stdlib.h>

enum { NUMBERS = 9 };

static void require(hd_status status)
{
    if (status == HD_OK) return;
    fprintf(stderr, "load: %s\n", hd_status_text(status));
    exit(3);
}

static hd_scene_def scene_of(const double x[NUMBERS])
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = (int)x[0];
    scene.density = x[1];
    scene.aspect = x[2];
    scene.boundary[0] = (hd_boundary)x[3];
    scene.boundary[1] = (hd_boundary)x[4];
    scene.exponents = (int)x[5];
    scene.observe = (unsigned)x[6];
    scene.duration = x[8];
    scene.equilibration = 5.0;
    scene.warmup = 5.0;
    scene.threads = 1;
    return scene;
}

__attribute__((noinline)) void load_create(hd_run **run, const hd_scene_def *scene)
{
    require(hd_run_create(run, scene, NULL, 0));
}

__attribute__((noinline)) void load_equilibrate(hd_run *run)
{
    while (hd_run_stage(run) < HD_WARMING_UP) require(hd_run_advance(run));
}

__attribute__((noinline)) void load_warm(hd_run *run)
{
    while (hd_run_stage(run) < HD_AVERAGING) require(hd_run_advance(run));
}

__attribute__((noinline)) void load_average(hd_run *run)
{
    while (hd_run_stage(run) != HD_FINISHED) require(hd_run_advance(run));
}

int main(int argc, char **argv)
{
    double x[NUMBERS];
    if (argc != 1 + NUMBERS) return 2;
    for (int k = 0; k < NUMBERS; k++) x[k] = atof(argv[k + 1]);
    const hd_scene_def scene = scene_of(x);
    hd_run *run;
    load_create(&run, &scene);
    hd_run_observe(run, (unsigned)x[7]);
    load_equilibrate(run);
    load_warm(run);
    load_average(run);
    printf("vectors %d collisions %llu\n", hd_run_vectors(run),
           (unsigned long long)hd_trajectory_collisions(hd_run_trajectory(run)));
    hd_run_free(run);
    return 0;
}
