/** What ranks tell each other, and the frame that they share. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include "tangent/ortho.h"
#include "together.h"

TEST(calls_give_the_same_to_all)
{
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

/** 70 rows, 11 columns of which each rank has as many as fit; from the first on, or from the last.
 */
static void expect_put_together(int from_behind)
{
    enum { ROWS = 70, STRIDE = 16, COUNT = 11 };
    double x[ROWS][STRIDE];
    const int width = (COUNT + ranks->ranks - 1) / ranks->ranks, first = ranks->rank * width;
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < STRIDE; col++) {
            const int at = from_behind ? COUNT - 1 - col : col;
            x[row][col] = at >= first && at < first + width && col < COUNT ? row + 0.01 * col
                                                                           : -1.0;
        }
    CHECK_OK(hd_communicator_share(ranks, x[0],
                                   (hd_shared){ROWS, STRIDE, (size_t)width, COUNT, from_behind}));
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < COUNT; col++) CHECK_CLOSE(x[row][col], row + 0.01 * col, 0.0);
    CHECK_CLOSE(x[0][COUNT], -1.0, 0.0);
}

TEST(shares_are_put_together)
{
    expect_put_together(0);
    expect_put_together(1);
}

/** They are started by one mpirun, here. */
TEST(all_are_on_one_machine) { assert_int_equal(ranks->beside, ranks->ranks); }

/** Of rank `from`: no two of all that are exchanged are the same. */
static double exchanged(int from, int to, size_t k) { return 1e8 * from + 1e6 * to + (double)k; }

/** One block, and one that takes three messages (PIECE of mpi.c). */
TEST(blocks_of_any_size_are_exchanged)
{
    const size_t counts[] = {3, (2 << 17) + 5};
    const int all = ranks->ranks, here = ranks->rank;
    HEAP double *x = calloc((size_t)all * counts[1], sizeof *x);
    assert_non_null(x);
    for (int c = 0; c < 2; c++) {
        const size_t count = counts[c];
        for (size_t k = 0; k < (size_t)all * count; k++)
            x[k] = exchanged(here, (int)(k / count), k % count);
        hd_communicator_exchange(ranks, x, count);
        for (size_t k = 0; k < (size_t)all * count; k++)
            if (x[k] != exchanged((int)(k / count), here, k % count))
                fail_msg("number %zu, blocks of %zu: %.0f", k, count, x[k]);
    }
}

/** Each kind by itself, and all together. */
TEST(calls_are_counted)
{
    double x[64] = {0.0};
    const hd_traffic before = hd_communicator_traffic(ranks);
    const hd_traffic sums = ranks->traffic[HD_CALL_SUM];
    const hd_traffic exchanges = ranks->traffic[HD_CALL_EXCHANGE];
    hd_communicator_sum(ranks, x, 5);
    hd_communicator_sum(ranks, x, 2);
    hd_communicator_exchange(ranks, x, 3);
    const hd_traffic after = hd_communicator_traffic(ranks);
    CHECK_CLOSE(ranks->traffic[HD_CALL_SUM].calls - sums.calls, 2.0, 0.0);
    CHECK_CLOSE(ranks->traffic[HD_CALL_SUM].bytes - sums.bytes, 56.0, 0.0);
    CHECK_CLOSE(ranks->traffic[HD_CALL_EXCHANGE].calls - exchanges.calls, 1.0, 0.0);
    CHECK_CLOSE(after.bytes - before.bytes, 56.0 + 24.0 * (ranks->ranks - 1), 0.0);
    CHECK_CLOSE(after.calls - before.calls, 3.0, 0.0);
    assert_true(after.seconds > before.seconds);
    enum { ROWS = 5, WIDTH = 2, HERE = 8 }; /* rows of WIDTH of each rank: to each other one */
    const hd_traffic gathers = ranks->traffic[HD_CALL_GATHER];
    const size_t stride = (size_t)(WIDTH * ranks->ranks);
    CHECK_OK(hd_communicator_share(ranks, x, (hd_shared){ROWS, stride, WIDTH, stride, 0}));
    CHECK_CLOSE(ranks->traffic[HD_CALL_GATHER].calls - gathers.calls, 1.0, 0.0);
    CHECK_CLOSE(ranks->traffic[HD_CALL_GATHER].bytes - gathers.bytes,
                HERE * ROWS * WIDTH * (ranks->ranks - 1.0), 0.0);
}

typedef struct frames {
    hd_frame *own, *shared;
    hd_ortho *of_own, *of_shared;
} frames;

static frames frames_of(int disks, int vectors)
{
    frames f;
    CHECK_OK(hd_frame_create(&f.own, PARTICLES(disks), vectors, 7, 1));
    CHECK_OK(hd_frame_create_shared(&f.shared, PARTICLES(disks), vectors, 7, 1, ranks));
    CHECK_OK(hd_ortho_create(&f.of_own, 4 * disks, vectors));
    CHECK_OK(hd_ortho_create_shared(&f.of_shared, 4 * disks, 4, vectors, ranks));
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

TEST(each_rank_has_its_columns)
{
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

TEST(vectors_are_orthonormalised_alike)
{
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

TEST(what_is_dependent_is_said_by_all)
{
    frames f = frames_of(20, 40);
    stretch(f.shared, 40.0);
    const hd_ortho_limits limits = {1e7, 1e-10, HD_NORM_FULL};
    assert_int_equal(hd_ortho_step(f.of_shared, f.shared, limits), HD_ILL_CONDITIONED);
    frames_free(&f);
}

/* ---- what begins no run --------------------------------------------------------------------- */

static bool is_unthreaded;

static void next(void *function, const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    assert_non_null(found);
    memcpy(function, &found, sizeof found);
}

/** MPI's own; or one that several threads cannot call. */
int MPI_Init_thread(int *argc, char ***argv, int wanted, int *provided)
{
    int (*real)(int *, char ***, int, int *);
    next(&real, "MPI_Init_thread");
    const int result = real(argc, argv, wanted, provided);
    if (is_unthreaded) *provided = 0;
    return result;
}

static void expect_ended(void)
{
    int (*finalized)(int *), ended = 0;
    next(&finalized, "MPI_Finalized");
    (void)finalized(&ended);
    assert_true(ended);
}

static void refused_unthreaded(int argc, char **argv)
{
    char line[200];
    is_unthreaded = true;
    assert_int_equal(hd_mpi_begin(&ranks, &argc, &argv, line, sizeof line), HD_REFUSED);
    assert_string_equal(line, "this MPI cannot be called by several threads");
    assert_null(ranks);
}

/** After what is refused MPI has ended. */
int main(int argc, char **argv)
{
    const char *how = argc > 1 ? argv[1] : "";
    const bool unthreaded = strcmp(how, "unthreaded") == 0;
    if (unthreaded) refused_unthreaded(argc, argv);
    const int result = unthreaded ? 0 : ranks_main(argc, argv);
    if (unthreaded || strcmp(how, "alone") == 0) expect_ended();
    return result;
}
