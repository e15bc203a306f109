/** Whole runs of spheres by several ranks, against one. */
#define _GNU_SOURCE
#include "runs.h"
#include "together.h"

static hd_scene_def scene_of_runs(int exponents)
{
    return scene_from(box_of(30, 0.5, 0.3, 0.4, 4, 3), .equilibration = 5.0, .warmup = 20.0,
                      .duration = 20.0, .threads = 1, .exponents = exponents,
                      .observe = HD_OBSERVE_STEPS | HD_OBSERVE_LOCALIZATION | HD_OBSERVE_GAS);
}

/** Weights differ by little, as long as directions are those of the dynamics. */
static void compare(hd_scene_def def)
{
    OWNED(hd_run) *run = finish(shared(def)), *alone = finished(def);
    check_same_run(run, alone);
    const hd_modes *together = hd_run_modes(run), *own = hd_run_modes(alone);
    for (int s = 0; s < hd_fields_subspaces(hd_modes_fields(own)); s++)
        for (int col = 0; col < hd_run_vectors(run); col++)
            CHECK_CLOSE(hd_modes_snapshot(together, s, HD_WEIGHT)[col],
                        hd_modes_snapshot(own, s, HD_WEIGHT)[col], 1e-6);
    CHECK_CLOSE(hd_gas_read(hd_run_gas(run)).pressure, hd_gas_read(hd_run_gas(alone)).pressure,
                1e-9);
}

TEST(runs_are_those_of_one_rank) { compare(scene_of_runs(HD_EXPONENTS_POSITIVE)); }
TEST(mixtures_are_those_of_one_rank)
{
    compare(with_second(scene_of_runs(HD_EXPONENTS_POSITIVE), 0.4, 1.2, 3.0));
}

TEST(halves_are_those_of_one_rank) { compare(scene_of_runs(HD_EXPONENTS_ALL)); }

/** A rank that comes late to the start: that the other waits is of the run's time, too. */
TEST(waiting_is_a_part_of_the_time)
{
    if (ranks->rank == 1) usleep(200000);
    OWNED(hd_run) *run = shared(scene_of_runs(HD_EXPONENTS_POSITIVE));
    const hd_cost cost = hd_run_cost(run);
    assert_true(cost.communication <= cost.wall);
    if (ranks->rank == 0) assert_true(cost.communication > 0.1);
}

int main(int argc, char **argv) { return ranks_main(argc, argv); }
