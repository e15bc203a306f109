/** Programs that mpirun starts on some ranks: what they compute together, each holds against what
 * it computes alone. With `late` every call of the communicator is late by a random time on
 * each rank: no clock may decide what is called. */
#ifndef HD_TOGETHER_H
#define HD_TOGETHER_H

#include <hdlyap/mpi.h>
#include <unistd.h>
#include "testing.h"

static hd_communicator *ranks;

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

/** A run of all ranks together. */
static inline hd_run *shared(hd_scene_def scene)
{
    hd_run *run = NULL;
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    return run;
}

/** Of a single process that is said to be one of several. */
static inline void refused_alone(int argc, char **argv)
{
    char line[512] = "", wanted[64];
    const char *variable;
    snprintf(wanted, sizeof wanted, "PMI_SIZE = %d, but ", hd_ranks_started(&variable));
    assert_string_equal(variable, "PMI_SIZE");
    assert_int_equal(hd_mpi_begin(&ranks, &argc, &argv, line, sizeof line), HD_REFUSED);
    print_message("%s\n", line);
    assert_null(ranks);
    assert_ptr_equal(strstr(line, wanted), line);
    assert_non_null(strstr(line, "or unset PMI_SIZE"));
}

/** Usage: test [alone | late | TEST]. Of a single rank there is nothing to compare. */
static inline int ranks_main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "alone") == 0) {
        refused_alone(argc, argv);
        return 0;
    }
    CHECK_OK(hd_mpi_begin(&ranks, &argc, &argv, NULL, 0));
    if (!ranks) return 77;
    srand((unsigned)ranks->rank);
    in_time = ranks->transport;
    const bool is_late = argc > 1 && strcmp(argv[1], "late") == 0;
    if (is_late) ranks->transport = &late;
    if (tests_run(argc > 1 && !is_late ? argv[1] : NULL)) abort(); /* the others may wait */
    hd_mpi_end(ranks);
    return 0;
}

#endif
