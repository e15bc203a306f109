/** Run by mpirun on some ranks: what they compute together, each holds against what it computes
 * alone. With an argument every call of the communicator is late by a random time on each rank: no
 * clock may decide what is called. */
#define _GNU_SOURCE
#include <hdlyap/mpi.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hdlyap/checkpoint.h"
#include "hdlyap/follow.h"
#include "hdlyap/hydro.h"
#include "runs.h"
#include "scenes.h"

static hd_communicator *ranks;

/* ---- a transport that is late --------------------------------------------------------------- */

static const hd_transport *in_time;

static void wait_a_little(void) { usleep((useconds_t)(rand() % 300)); }

static void late_sum(void *context, double *x, size_t count)
{
    wait_a_little();
    in_time->sum(context, x, count);
}

static void late_gather(void *context, double *x, size_t count)
{
    wait_a_little();
    in_time->gather(context, x, count);
}

static void late_exchange(void *context, double *x, size_t count)
{
    wait_a_little();
    in_time->exchange(context, x, count);
}

static void late_broadcast(void *context, void *x, size_t bytes)
{
    wait_a_little();
    in_time->broadcast(context, x, bytes);
}

static const hd_transport late = {late_sum, late_gather, late_exchange, late_broadcast};

/* ---- calls ---------------------------------------------------------------------------------- */

static void calls_give_the_same_to_all(void **state)
{
    (void)state;
    const int all = ranks->ranks, rank = ranks->rank;
    double x[3] = {1.0, rank, 0.1 * rank};
    hd_communicator_sum(ranks, x, 3);
    CHECK_CLOSE(x[0], all, 0.0);
    CHECK_CLOSE(x[1], 0.5 * all * (all - 1), 0.0);
    unsigned long bits = rank == 0 ? 1234567890123UL : 0;
    hd_communicator_broadcast(ranks, &bits, sizeof bits);
    assert_int_equal(bits, 1234567890123UL);
    CHECK_OK(hd_communicator_agree(ranks, HD_OK));
    const hd_status mine = rank == all - 1 ? HD_NO_MEMORY : HD_OK;
    assert_int_equal(hd_communicator_agree(ranks, mine), HD_NO_MEMORY);
}

/** 70 rows, 11 columns of which each rank has as many as fit. */
static void shares_are_put_together(void **state)
{
    (void)state;
    enum { ROWS = 70, STRIDE = 16, COUNT = 11 };
    double x[ROWS][STRIDE];
    const int width = (COUNT + ranks->ranks - 1) / ranks->ranks, first = ranks->rank * width;
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < STRIDE; col++)
            x[row][col] = col >= first && col < first + width && col < COUNT ? row + 0.01 * col
                                                                             : -1.0;
    CHECK_OK(hd_communicator_share(ranks, x[0], ROWS, STRIDE, (size_t)width, COUNT));
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < COUNT; col++) CHECK_CLOSE(x[row][col], row + 0.01 * col, 0.0);
    CHECK_CLOSE(x[0][COUNT], -1.0, 0.0);
}

/* ---- a frame -------------------------------------------------------------------------------- */

typedef struct frames {
    hd_frame *own, *shared;
    hd_ortho *of_own, *of_shared;
} frames;

static frames frames_of(int disks, int vectors)
{
    frames f;
    CHECK_OK(hd_frame_create(&f.own, disks, vectors, 7, 1));
    CHECK_OK(hd_frame_create_shared(&f.shared, disks, vectors, 7, 1, ranks));
    CHECK_OK(hd_ortho_create(&f.of_own, 4 * disks, vectors));
    CHECK_OK(hd_ortho_create_shared(&f.of_shared, 4 * disks, vectors, ranks));
    return f;
}

static void frames_free(frames *f)
{
    hd_frame_free(f->own);
    hd_frame_free(f->shared);
    hd_ortho_free(f->of_own);
    hd_ortho_free(f->of_shared);
}

static void expect_columns(const frames *f, double tolerance)
{
    const hd_columns own = hd_frame_columns(f->own), shared = hd_frame_columns(f->shared);
    for (int row = 0; row < hd_frame_rows(f->own); row++)
        for (int col = 0; col < shared.count; col++)
            CHECK_CLOSE(shared.data[(size_t)row * (size_t)shared.stride + (size_t)col],
                        own.data[(size_t)row * (size_t)own.stride + (size_t)(shared.first + col)],
                        tolerance);
}

static void each_rank_has_its_columns(void **state)
{
    (void)state;
    static const int sizes[][2] = {{5, 3}, {17, 30}, {40, 77}, {33, 132}};
    for (int k = 0; k < 4; k++) {
        frames f = frames_of(sizes[k][0], sizes[k][1]);
        double count = hd_frame_columns(f.shared).count;
        hd_communicator_sum(ranks, &count, 1);
        CHECK_CLOSE(count, sizes[k][1], 0.0);
        expect_columns(&f, 0.0);
        hd_frame_to_rows(f.shared);
        const int rows = hd_frame_rows_here(f.shared), first = rows * ranks->rank;
        for (int col = 0; col < sizes[k][1]; col++)
            for (int row = first; row < first + rows && row < 4 * sizes[k][0]; row++)
                CHECK_CLOSE(
                    hd_frame_vector(f.shared, col)[(row - first) * hd_frame_stride(f.shared)],
                    hd_frame_read(f.own)[row * hd_frame_stride(f.own) + col], 0.0);
        hd_frame_to_columns(f.shared);
        expect_columns(&f, 0.0);
        frames_free(&f);
    }
}

/** Vectors that grow apart by so many orders of magnitude. */
static void stretch(hd_frame *frame, double orders)
{
    const hd_columns x = hd_frame_columns(frame);
    const int n = hd_frame_vectors(frame);
    double *data = hd_frame_data(frame);
    for (int row = 0; row < hd_frame_rows(frame); row++)
        for (int col = 0; col < x.count; col++) {
            double *entry = data + (size_t)row * (size_t)x.stride + (size_t)col;
            *entry = sin(1.0 + row) + *entry * pow(10.0, -orders * (x.first + col + 1) / n);
        }
}

static void vectors_are_orthonormalised_alike(void **state)
{
    (void)state;
    static const struct {
        int disks, vectors;
        double orders;
        hd_norm norm;
        bool stable;
    } cases[] = {{60, 117, 0.0, HD_NORM_FULL, false}, {60, 117, 4.0, HD_NORM_FULL, false},
                 {60, 117, 4.0, HD_NORM_DQ, false},   {20, 80, 2.0, HD_NORM_FULL, false},
                 {9, 5, 1.0, HD_NORM_FULL, false},    {60, 117, 4.0, HD_NORM_FULL, true},
                 {60, 117, 11.0, HD_NORM_FULL, true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const hd_ortho_limits limits = {1e12, 1e-10, cases[k].norm};
        frames f = frames_of(cases[k].disks, cases[k].vectors);
        stretch(f.own, cases[k].orders);
        stretch(f.shared, cases[k].orders);
        if (cases[k].stable) {
            CHECK_OK(hd_ortho_step_stable(f.of_own, f.own, 1e15));
            CHECK_OK(hd_ortho_step_stable(f.of_shared, f.shared, 1e15));
        } else {
            CHECK_OK(hd_ortho_step(f.of_own, f.own, limits));
            CHECK_OK(hd_ortho_step(f.of_shared, f.shared, limits));
        }
        const double condition = hd_ortho_condition(f.of_own), eps = 2.3e-16;
        CHECK_CLOSE(hd_ortho_condition(f.of_shared), condition, 1e-3 * condition);
        for (int col = 0; col < cases[k].vectors; col++)
            CHECK_CLOSE(hd_ortho_log_stretch(f.of_shared)[col], hd_ortho_log_stretch(f.of_own)[col],
                        20.0 * eps * condition);
        expect_columns(&f, 100.0 * eps * condition);
        const double defect = hd_ortho_defect_measured(f.of_shared, f.shared, cases[k].norm);
        CHECK_CLOSE(defect, 0.0, fmax(hd_ortho_defect(f.of_shared), 1e-13));
        if (ranks->rank == 0) print_message("condition %.1e, defect %.1e\n", condition, defect);
        frames_free(&f);
    }
}

static void what_is_dependent_is_said_by_all(void **state)
{
    (void)state;
    frames f = frames_of(20, 40);
    stretch(f.shared, 40.0);
    const hd_ortho_limits limits = {1e7, 1e-10, HD_NORM_FULL};
    assert_int_equal(hd_ortho_step(f.of_shared, f.shared, limits), HD_ILL_CONDITIONED);
    frames_free(&f);
}

/* ---- runs ----------------------------------------------------------------------------------- */

static hd_scene_def scene_of_runs(int disks, unsigned observe)
{
    hd_scene_def scene = scene_of(disks, 0.7, 0.3, HD_PERIODIC, HD_PERIODIC, 3);
    scene.equilibration = 5.0;
    scene.warmup = 20.0;
    scene.duration = 40.0;
    scene.report_interval = 1.0;
    scene.threads = 1;
    scene.observe = observe;
    return scene;
}

static void finish(hd_run *run)
{
    while (hd_run_stage(run) != HD_FINISHED) CHECK_OK(hd_run_advance(run));
}

static void expect_same_exponents(const hd_run *run, const hd_run *alone)
{
    const double bound = hd_run_cost(run).error_bound + hd_run_cost(alone).error_bound;
    double most = 0.0;
    assert_int_equal(hd_run_vectors(run), hd_run_vectors(alone));
    for (int col = 0; col < hd_run_vectors(run); col++)
        most = fmax(most, fabs(hd_spectrum_exponent(hd_run_spectrum(run), col) -
                               hd_spectrum_exponent(hd_run_spectrum(alone), col)));
    CHECK_CLOSE(most, 0.0, bound);
    if (ranks->rank == 0) print_message("exponents apart by %.1e, bounds %.1e\n", most, bound);
}

static void exponents_are_those_of_one_rank(void **state)
{
    (void)state;
    for (int all = 0; all < 2; all++) {
        hd_scene_def scene = scene_of_runs(all ? 24 : 60, 0);
        if (all) scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
        hd_run *run, *alone = created(&scene);
        CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
        finish(run);
        finish(alone);
        expect_same_exponents(run, alone);
        hd_run_free(run);
        hd_run_free(alone);
    }
}

/** The run has the same trajectory; its frame differs by rounding, and so by little as long as the
 * directions are those of the dynamics. */
static void modes_are_those_of_one_rank(void **state)
{
    (void)state;
    const hd_scene_def scene = scene_of_runs(60, HD_OBSERVE_MODES | HD_OBSERVE_STEPS |
                                                     HD_OBSERVE_PHASES);
    hd_run *run, *alone = created(&scene);
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    finish(run);
    finish(alone);
    expect_same_exponents(run, alone);
    const hd_modes *own = hd_run_modes(alone), *shared = hd_run_modes(run);
    const int n = hd_run_vectors(run), subspaces = hd_fields_subspaces(hd_modes_fields(own));
    double most = 0.0, largest = 0.0;
    for (int s = 0; s < subspaces; s++)
        for (int col = 0; col < n; col++) {
            const double weight = hd_modes_snapshot(own, s, HD_WEIGHT)[col];
            most = fmax(most, fabs(hd_modes_snapshot(shared, s, HD_WEIGHT)[col] - weight));
            largest = fmax(largest, weight);
        }
    assert_true(largest > 0.5);
    CHECK_CLOSE(most, 0.0, 1e-6);
    const hd_steps *a = hd_run_steps(run), *b = hd_run_steps(alone);
    assert_int_equal(hd_steps_count(a), hd_steps_count(b));
    for (int k = 0; k < hd_steps_count(a); k++) {
        assert_int_equal(hd_steps_step(a, k)->resolved, hd_steps_step(b, k)->resolved);
        assert_int_equal(hd_steps_step(a, k)->col, hd_steps_step(b, k)->col);
    }
    double cosine[2][4 * 60], ratio[2][4 * 60];
    hd_run_halves(run, cosine[0], ratio[0]);
    hd_run_halves(alone, cosine[1], ratio[1]);
    for (int col = 0; col < n; col++) {
        CHECK_CLOSE(cosine[0][col], cosine[1][col], 1e-6);
        CHECK_CLOSE(ratio[0][col], ratio[1][col], 1e-6);
    }
    hd_run_free(run);
    hd_run_free(alone);
}

/** The same on every rank, and once more the same: with other delays. */
static void bits_are_the_same(void **state)
{
    (void)state;
    const hd_scene_def scene = scene_of_runs(30, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
    double kept[2 * 30];
    int n = 0;
    for (int again = 0; again < 2; again++) {
        hd_run *run;
        CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
        finish(run);
        n = hd_run_vectors(run);
        for (int col = 0; col < n; col++) {
            double here = hd_spectrum_exponent(hd_run_spectrum(run), col), first = here;
            hd_communicator_broadcast(ranks, &first, sizeof first);
            CHECK_CLOSE(here, first, 0.0);
            if (again) CHECK_CLOSE(here, kept[col], 0.0);
            kept[col] = here;
        }
        hd_run_free(run);
    }
}

/** Vectors of the modes, from all ranks, and the hydrodynamic response, on each. */
static void vectors_are_gathered_for_reports(void **state)
{
    (void)state;
    const hd_scene_def scene = scene_of_runs(60, HD_OBSERVE_ALL & ~(unsigned)HD_OBSERVE_COVARIANT);
    hd_run *run, *alone = created(&scene);
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    hd_run_fields_from(run, 100);
    finish(run);
    finish(alone);
    const hd_columns got = hd_run_frame_columns(run), want = hd_run_frame_columns(alone);
    assert_int_equal(got.first + got.count, want.count);
    assert_true(got.first <= 100 && got.first > 60);
    for (int row = 0; row < 240; row++)
        for (int col = 0; col < got.count; col++)
            CHECK_CLOSE(got.data[row * got.stride + col],
                        want.data[row * want.stride + got.first + col], 1e-6);
    hd_hydro *hydro[2];
    double q[120], p[120];
    hd_run *const both[2] = {run, alone};
    for (int k = 0; k < 2; k++) {
        CHECK_OK(hd_hydro_create(&hydro[k], &scene, hd_run_steps(both[k])));
        hd_trajectory_state(hd_run_trajectory(both[k]), q, p);
        hd_hydro_measure(hydro[k], hd_run_steps(both[k]), hd_run_frame_columns(both[k]), q, p);
    }
    int resolved = 0;
    for (int k = 0; k < hd_hydro_count(hydro[0]); k++) {
        resolved += hd_hydro_at(hydro[0], k)->col >= 0;
        CHECK_CLOSE(hd_hydro_at(hydro[0], k)->density, hd_hydro_at(hydro[1], k)->density, 1e-6);
    }
    assert_true(resolved > 0);
    for (int k = 0; k < 2; k++) {
        hd_hydro_free(hydro[k]);
        hd_run_free(both[k]);
    }
}

/** A watcher sees the slowest vectors at each of its times. */
static void the_slowest_are_watched(void **state)
{
    (void)state;
    const hd_scene_def scene = scene_of_runs(40, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
    hd_run *run;
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    const int first = hd_run_vectors(run) - 6;
    hd_run_watch(run, 0.25, first);
    int seen = 0;
    while (hd_run_time(run) < 35.0) {
        CHECK_OK(hd_run_advance(run));
        const hd_columns known = hd_run_columns(run);
        if (hd_run_stage(run) != HD_AVERAGING || hd_run_time(run) < 26.0) continue;
        assert_int_equal(known.first, first);
        assert_int_equal(known.count, 6);
        seen++;
    }
    assert_true(seen >= 36);
    hd_run_free(run);
}

/* ---- checkpoints ----------------------------------------------------------------------------- */

static void run_until(hd_run *run, double time)
{
    while (hd_run_time(run) < time) CHECK_OK(hd_run_advance(run));
}

/** Kept by several ranks, it goes on with several or with one; kept by one, with several. */
static void checkpoints_fit_any_number_of_ranks(void **state)
{
    (void)state;
    const hd_scene_def scene = scene_of_runs(30, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
    char message[300] = "", own[40], path[] = "ranks.checkpoint";
    snprintf(own, sizeof own, "ranks_%d.checkpoint", ranks->rank);
    hd_run *run, *same, *fewer, *more, *alone = created(&scene);
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    run_until(run, 40.0);
    run_until(alone, 40.0);
    CHECK_OK(hd_run_save(run, path, "", message, sizeof message));
    CHECK_OK(hd_run_save(alone, own, "", message, sizeof message));
    CHECK_OK(hd_run_resume_shared(&same, path, NULL, ranks, message, sizeof message));
    CHECK_OK(hd_run_resume(&fewer, path, NULL, message, sizeof message));
    CHECK_OK(hd_run_resume_shared(&more, own, NULL, ranks, message, sizeof message));
    finish(run);
    finish(alone);
    finish(same);
    finish(fewer);
    finish(more);
    for (int col = 0; col < hd_run_vectors(run); col++)
        CHECK_CLOSE(hd_spectrum_exponent(hd_run_spectrum(same), col),
                    hd_spectrum_exponent(hd_run_spectrum(run), col), 0.0);
    expect_same_exponents(fewer, run);
    expect_same_exponents(more, alone);
    hd_run *const all[] = {run, alone, same, fewer, more};
    for (int k = 0; k < 5; k++) hd_run_free(all[k]);
    (void)remove(own);
    if (ranks->rank == 0) (void)remove(path);
}

static void checkpoints_that_fail_are_said_by_all(void **state)
{
    (void)state;
    const hd_scene_def scene = scene_of_runs(20, 0);
    char message[300] = "";
    hd_run *run, *none;
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    assert_int_equal(hd_run_save(run, "no/such/folder", "", message, sizeof message),
                     HD_FILE_FAULT);
    assert_int_equal(strstr(message, "no/such/folder") != NULL, ranks->rank == 0);
    /* a file that one of them does not see */
    char path[40];
    CHECK_OK(hd_run_save(run, "ranks.checkpoint", "", message, sizeof message));
    snprintf(path, sizeof path, "ranks.checkpoint%s", ranks->rank == ranks->ranks - 1 ? "x" : "");
    assert_int_equal(hd_run_resume_shared(&none, path, NULL, ranks, message, sizeof message),
                     HD_FILE_FAULT);
    assert_non_null(strstr(message, "ranks.checkpoint"));
    hd_run_free(run);
    if (ranks->rank == 0) (void)remove("ranks.checkpoint");
}

/* ---- rank 0 leads --------------------------------------------------------------------------- */

static const hd_parameter *parameter_named(const char *name)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    while (strcmp(row->name, name) != 0) row++;
    return row;
}

/** All that a node does with a run, and what it says of it. */
static double lead(hd_communicator *c)
{
    hd_scene_def scene = scene_of_runs(30,
                                       HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_FIELDS);
    char message[300], path[] = "led.checkpoint";
    hd_run *run;
    scene.exponents = HD_EXPONENTS_ALL;
    if (c) assert_int_equal(hd_run_create_shared(&run, &scene, c, message, 300), HD_REFUSED);
    scene.exponents = HD_EXPONENTS_POSITIVE;
    CHECK_OK(hd_run_create_shared(&run, &scene, c, message, 300));
    hd_run_fields_every(run, 2.0);
    hd_run_fields_from(run, 40);
    run_until(run, 30.0);
    hd_run_watch(run, 0.5, hd_run_vectors(run) - 4);
    run_until(run, 35.0);
    hd_run_watch(run, INFINITY, hd_run_vectors(run));
    hd_run_observe(run, HD_OBSERVE_STEPS);
    CHECK_OK(hd_run_change(run, parameter_named("duration"), 50.0, message, 300));
    assert_int_equal(hd_run_change(run, parameter_named("duration"), -1.0, message, 300),
                     HD_REFUSED);
    run_until(run, 45.0);
    CHECK_OK(hd_run_reset_average(run));
    CHECK_OK(hd_run_save(run, path, "a label", message, 300));
    hd_run_free(run);
    CHECK_OK(hd_run_resume_shared(&run, path, NULL, c, message, 300));
    (void)remove(path);
    finish(run);
    const double sum = hd_spectrum_ks_entropy(hd_run_spectrum(run));
    CHECK_CLOSE(hd_run_time(run), 95.0, 1e-9);
    hd_run_free(run);
    return sum;
}

static void others_follow(void **state)
{
    (void)state;
    if (ranks->rank > 0) {
        hd_run_follow(ranks);
        return;
    }
    hd_run_lead(ranks);
    const double sum = lead(ranks);
    hd_run_dismiss(ranks);
    CHECK_CLOSE(sum, lead(NULL), 1e-6);
}

static void what_they_cannot_carry_is_refused(void **state)
{
    (void)state;
    char message[200];
    hd_run *run;
    hd_scene_def scene = scene_of_runs(20, 0);
    scene.exponents = HD_EXPONENTS_ALL;
    assert_int_equal(hd_run_create_shared(&run, &scene, ranks, message, sizeof message),
                     HD_REFUSED);
    assert_non_null(strstr(message, "all_independent"));
    scene = scene_of_runs(20, HD_OBSERVE_COVARIANT);
    assert_int_equal(hd_run_create_shared(&run, &scene, ranks, message, sizeof message),
                     HD_REFUSED);
    assert_non_null(strstr(message, "covariant"));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calls_give_the_same_to_all),
        cmocka_unit_test(shares_are_put_together),
        cmocka_unit_test(each_rank_has_its_columns),
        cmocka_unit_test(vectors_are_orthonormalised_alike),
        cmocka_unit_test(what_is_dependent_is_said_by_all),
        cmocka_unit_test(exponents_are_those_of_one_rank),
        cmocka_unit_test(modes_are_those_of_one_rank),
        cmocka_unit_test(bits_are_the_same),
        cmocka_unit_test(vectors_are_gathered_for_reports),
        cmocka_unit_test(the_slowest_are_watched),
        cmocka_unit_test(checkpoints_fit_any_number_of_ranks),
        cmocka_unit_test(checkpoints_that_fail_are_said_by_all),
        cmocka_unit_test(others_follow),
        cmocka_unit_test(what_they_cannot_carry_is_refused),
    };
    CHECK_OK(hd_mpi_begin(&ranks, &argc, &argv));
    if (!ranks) return 77; /* nothing to compare */
    srand((unsigned)ranks->rank);
    in_time = ranks->transport;
    if (argc > 1) ranks->transport = &late;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    if (failed) abort(); /* the others may wait */
    hd_mpi_end(ranks);
    return 0;
}
