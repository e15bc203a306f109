/** What starts ranks, by the environment. */
#define _POSIX_C_SOURCE 200809L
#include "hdlyap/communicator.h"
#include "testing.h"

/** As mpirun -n 1 within a step of srun has it. */
TEST(the_first_variable_that_is_set_counts)
{
    const char *variable;
    unsetenv("PMI_SIZE");
    setenv("SLURM_STEP_NUM_TASKS", "4", 1);
    setenv("OMPI_COMM_WORLD_SIZE", "1", 1);
    assert_int_equal(hd_ranks_started(&variable), 1);
    assert_string_equal(variable, "OMPI_COMM_WORLD_SIZE");
    unsetenv("OMPI_COMM_WORLD_SIZE");
    assert_int_equal(hd_ranks_started(&variable), 4);
    unsetenv("SLURM_STEP_NUM_TASKS");
    assert_int_equal(hd_ranks_started(&variable), 1);
    assert_null(variable);
}
