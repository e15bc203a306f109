/** Records come back as they were put, from memory and from a file; what finds no room says so. */
#define _GNU_SOURCE /* setrlimit */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

#include "testing.h"

#include "base/memory.h"
#include "covariant/store.h"

enum { DOUBLES = 1000, MOST = 50 };

static void fill(double *data, long record)
{
    for (int k = 0; k < DOUBLES; k++) data[k] = 1e3 * (double)record + k;
}

static void check_records(const char *folder)
{
    hd_store *store;
    double data[DOUBLES], found[DOUBLES];
    CHECK_OK(hd_store_create(&store, DOUBLES, MOST, folder));
    assert_int_equal(hd_store_most(store), MOST);
    for (int again = 0; again < 2; again++) { /* a record may be put anew */
        for (long k = 0; k < MOST; k++) {
            fill(data, 7 * k % MOST + again);
            CHECK_OK(hd_store_put(store, 7 * k % MOST, data));
        }
        for (long k = 0; k < MOST; k++) {
            fill(data, k + again);
            CHECK_OK(hd_store_fetch(store, found, k));
            assert_memory_equal(found, data, sizeof data);
        }
    }
    hd_store_free(store);
}

static void records_come_back(void **state)
{
    (void)state;
    check_records(NULL);
    check_records(".");
    check_records("/dev/shm");
}

/** In memory a store takes what it is given, and nothing for what is put anew. */
static void memory_is_taken_as_needed(void **state)
{
    (void)state;
    hd_store *store;
    double data[DOUBLES] = {0};
    CHECK_OK(hd_store_create(&store, DOUBLES, 1000000, NULL));
    const size_t before = hd_memory_allocations();
    for (long k = 0; k < 20; k++) CHECK_OK(hd_store_put(store, k % 10, data));
    assert_int_equal(hd_memory_allocations() - before, 10);
    hd_store_free(store);
}

static void a_folder_that_is_none_is_a_fault(void **state)
{
    (void)state;
    hd_store *store;
    errno = 0;
    assert_int_equal(hd_store_create(&store, DOUBLES, MOST, "no/such/folder"), HD_FILE_FAULT);
    assert_int_equal(errno, ENOENT);
    assert_null(store);
}

/** A file takes its room at once: what is too large is refused before anything is put. */
static void too_large_a_file_is_a_fault(void **state)
{
    (void)state;
    hd_store *store;
    assert_int_equal(hd_store_create(&store, 1u << 30, 1L << 33, "."), HD_FILE_FAULT);
    assert_int_equal(errno, EFBIG);
    struct rlimit limit, small;
    signal(SIGXFSZ, SIG_IGN); /* as the node does: the call fails instead */
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    small = limit;
    small.rlim_cur = DOUBLES * MOST * sizeof(double) - 1;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const hd_status status = hd_store_create(&store, DOUBLES, MOST, ".");
    const int fault = errno;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    assert_int_equal(status, HD_FILE_FAULT);
    assert_int_equal(fault, EFBIG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(records_come_back),
        cmocka_unit_test(memory_is_taken_as_needed),
        cmocka_unit_test(a_folder_that_is_none_is_a_fault),
        cmocka_unit_test(too_large_a_file_is_a_fault),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
