/** Memory of the paper's scene from its creation to its first report: at most 1.4 times the frame
 * and its Gram matrix, 8 m n + 8 n^2 bytes, and the disks' own state. */
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "ledger.h"
#include "restart.h"
#include "testing.h"

static const double MOST = 1.4;
/** OpenBLAS's packing buffers, of which a kernel touches what it needs (32 MB a thread at most, 12
 * MB seen), and allocations rounded up to huge pages. */
static const double LIBRARY = 64e6;

/** Bytes at the peak: asked for by the core, and resident, with libraries and all that they take.
 */
typedef struct peak {
    double asked, resident;
    int vectors;
} peak;

static hd_scene_def paper(int exponents)
{
    return scene(.exponents = exponents, .equilibration = 0.2, .warmup = 0.2, .duration = 0.2,
                 .report_interval = 0.2);
}

/** In a process of its own, which tells its vectors and bytes through a pipe. */
static void run_and_tell(int out, const hd_scene_def *scene)
{
    hd_run *run;
    if (hd_run_create(&run, scene, NULL, 0) != HD_OK) _exit(1);
    while (hd_run_stage(run) != HD_FINISHED)
        if (hd_run_advance(run) != HD_OK) _exit(1);
    const peak told = {.asked = (double)ledger_now().peak, .vectors = hd_run_vectors(run)};
    _exit(write(out, &told, sizeof told) == (ssize_t)sizeof told ? 0 : 1);
}

static peak peak_of(const hd_scene_def *scene)
{
    int ends[2], status = 1;
    peak told;
    struct rusage usage;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) run_and_tell(ends[1], scene);
    assert_true(child > 0 && wait4(child, &status, 0, &usage) == child);
    assert_int_equal(status, 0);
    assert_int_equal(read(ends[0], &told, sizeof told), sizeof told);
    close(ends[0]);
    close(ends[1]);
    told.resident = 1024.0 * (double)usage.ru_maxrss;
    return told;
}

TEST(of_the_positive_half)
{
    const hd_scene_def alone = paper(HD_EXPONENTS_NONE), with = paper(HD_EXPONENTS_POSITIVE);
    const peak disks = peak_of(&alone), whole = peak_of(&with);
    const double n = whole.vectors, unit = 8.0 * 4.0 * with.number * n + 8.0 * n * n;
    const double asked = (whole.asked - disks.asked) / unit;
    const double resident = (whole.resident - disks.resident) / unit;
    assert_true(asked > 1.0 && resident > 1.0); /* both see the frame */
    assert_true(asked <= MOST);
    assert_true(resident <= MOST + LIBRARY / unit);
}

int main(int argc, char **argv)
{
    (void)argc;
    restart_if_slow(argv);
    return tests_run(NULL);
}
