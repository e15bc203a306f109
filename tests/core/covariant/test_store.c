/** Records come back as they were put, and take memory as it is needed. */
#include "testing.h"
#include "base/memory.h"
#include "covariant/store.h"

OWNABLE(hd_store)

enum { DOUBLES = 1000, MOST = 50 };

static double number(long record, int k) { return 1e3 * (double)record + k; }

TEST(records_come_back)
{
    MADE(hd_store, store, DOUBLES, MOST);
    for (int again = 0; again < 2; again++) { /* a record may be put anew */
        for (long k = 0; k < MOST; k++) {
            double *data = hd_store_put(store, 7 * k % MOST);
            assert_non_null(data);
            for (int i = 0; i < DOUBLES; i++) data[i] = number(7 * k % MOST + again, i);
        }
        for (long k = 0; k < MOST; k++)
            for (int i = 0; i < DOUBLES; i++)
                CHECK_CLOSE(hd_store_fetch(store, k)[i], number(k + again, i), 0.0);
    }
}

/** What is put anew takes nothing. */
TEST(memory_is_taken_as_needed)
{
    MADE(hd_store, store, DOUBLES, 1000000);
    const size_t before = hd_memory_allocations();
    for (long k = 0; k < 20; k++) assert_non_null(hd_store_put(store, k % 10));
    assert_int_equal(hd_memory_allocations() - before, 3); /* 4 of 8 kB share a block */
}
