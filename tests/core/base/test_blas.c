/** Which kernels are taken for which processor, the restart, and room for threads. */
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>
#include "restart.h"
#include "testing.h"

TEST(old_kernels_are_noticed)
{
    assert_string_equal(hd_blas_better_kernel("Prescott", 1, 1), "SkylakeX");
    assert_string_equal(hd_blas_better_kernel("Prescott", 1, 0), "Haswell");
    assert_string_equal(hd_blas_better_kernel("Haswell", 1, 1), "SkylakeX");
    assert_string_equal(hd_blas_better_kernel("Sandybridge", 1, 0), "Haswell");
    assert_null(hd_blas_better_kernel("Prescott", 0, 0));
    assert_null(hd_blas_better_kernel("SkylakeX", 1, 1));
    assert_null(hd_blas_better_kernel("Cooperlake", 1, 1));
    assert_null(hd_blas_better_kernel("Zen", 1, 0));
    assert_null(hd_blas_better_kernel("Haswell", 1, 0));
    assert_null(hd_blas_better_kernel("unknown", 1, 1)); /* not OpenBLAS */
}

TEST(the_library_says_what_it_is)
{
    const hd_blas blas = hd_blas_query();
    assert_true(blas.cores >= 1 && blas.threads >= 1);
    assert_non_null(blas.library);
    assert_non_null(blas.kernel);
    if (blas.better_kernel) /* with which nothing is left to wish */
        assert_null(hd_blas_better_kernel(blas.better_kernel, 1, 1) &&
                    hd_blas_better_kernel(blas.better_kernel, 1, 0));
    hd_blas_use_threads(1);
    assert_int_equal(hd_blas_query().threads, 1);
}

static size_t asked; /* bytes of address space that nobody is to use, last */
static size_t at_most = SIZE_MAX;

/** In place of the library's. */
void *mmap(void *place, size_t size, int protection, int flags, int file, off_t offset)
{
    if (protection == PROT_NONE) {
        asked = size;
        if (size > at_most) return MAP_FAILED;
    }
    return (void *)syscall(SYS_mmap, place, size, protection, flags, file, offset);
}

/** Each thread has a buffer and a stack of its own; threads that the caller has still to begin come
 * once. */
TEST(room_is_for_each_thread)
{
    CHECK_OK(hd_blas_room(1));
    const size_t one = asked;
    CHECK_OK(hd_blas_room(2));
    const size_t each = asked - one;
    CHECK_OK(hd_blas_room(7));
    assert_true(each > 0 && one > each && asked == one + 6 * each);
    at_most = one + 6 * each;
    CHECK_OK(hd_blas_room(7));
    assert_int_equal(hd_blas_room(8), HD_NO_MEMORY);
    at_most = SIZE_MAX;
}

/** Kernels of OpenBLAS that run on every processor of this kind, and that hardly one would get by
 * itself; NULL if none are known. */
#if defined(__x86_64__)
static const char *const OLD = "Prescott";
#elif defined(__aarch64__)
static const char *const OLD = "thunderx";
#else
static const char *const OLD = NULL;
#endif

/** The user's own choice stays: no restart, whatever kernels it means. Child of this test. */
static int print_kernel(char **argv)
{
    char name[32] = "";
    restart_if_slow(argv);
    FILE *own = fopen("/proc/self/comm", "r"); /* on Linux */
    if (own && !fgets(name, sizeof name, own)) return 1;
    printf("%s %s %s\n", hd_blas_query().kernel, getenv("HDLYAP_RESTARTED") ? "restarted" : "first",
           name);
    return 0;
}

static char *self;

static void run_child(const char *environment, char *line, int size)
{
    char command[4096];
    snprintf(command, sizeof command,
             "env -u HDLYAP_RESTARTED -u GOMP_SPINCOUNT -u OMP_WAIT_POLICY %s '%s' kernel",
             environment, self);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    assert_non_null(fgets(line, size, pipe));
    assert_int_equal(pclose(pipe), 0);
}

TEST(a_users_choice_is_kept)
{
    char line[256], setting[80], expected[64];
    if (!OLD || strcmp(hd_blas_query().kernel, "unknown") == 0) skip();
    snprintf(setting, sizeof setting, "OMP_WAIT_POLICY=passive OPENBLAS_CORETYPE=%s", OLD);
    snprintf(expected, sizeof expected, "%s first ", OLD);
    run_child(setting, line, sizeof line);
    assert_int_equal(strncmp(line, expected, strlen(expected)), 0);
    run_child("-u OPENBLAS_CORETYPE", line, sizeof line); /* once, and to something better */
    snprintf(expected, sizeof expected, "%s restarted", OLD);
    assert_null(strstr(line, expected));
}

/** That killall and pgrep know, whatever the link that it was started by is called. */
TEST(a_restart_keeps_the_name)
{
    char line[256];
    run_child("-u OPENBLAS_CORETYPE", line, sizeof line);
#if defined(__linux__)
    assert_non_null(strstr(line, " restarted test_blas\n"));
#endif
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "kernel") == 0) return print_kernel(argv);
    self = argv[0];
    return tests_run(argc > 1 ? argv[1] : NULL);
}
