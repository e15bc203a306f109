/** Memory: aligned, zeroed, counted, and NULL rather than less than asked for. */
#include "base/memory.h"
#include "testing.h"

enum { CACHE_LINE = 64 };

static const size_t SIZES[] = {1,        7,       63,      64, 65, 4096, 100000, (1u << 20) - 1,
                               1u << 20, 3000001, 1u << 21};
enum { SIZE_COUNT = sizeof SIZES / sizeof *SIZES };

TEST(blocks_are_aligned_and_zero)
{
    for (int round = 0; round < 3; round++)
        for (int k = 0; k < SIZE_COUNT; k++) {
            unsigned char *block = hd_memory_alloc(SIZES[k], 1);
            assert_non_null(block);
            assert_true((uintptr_t)block % CACHE_LINE == 0);
            for (size_t b = 0; b < SIZES[k]; b++) assert_true(block[b] == 0);
            memset(block, 0xa5, SIZES[k]); /* so that reuse without zeroing would show */
            hd_memory_free(block);
        }
}

TEST(nothing_is_something)
{
    void *none = hd_memory_alloc(0, 8), *empty = hd_memory_alloc(8, 0);
    assert_non_null(none);
    assert_non_null(empty);
    assert_ptr_not_equal(none, empty);
    hd_memory_free(none);
    hd_memory_free(empty);
    hd_memory_free(NULL);
}

TEST(overflow_gives_null)
{
    const size_t most = SIZE_MAX;
    const size_t pairs[][2] = {
        {most, 1},         {1, most},           {most, most},   {most / 2 + 1, 2},
        {most / 8 + 2, 8}, {most / 64 + 1, 64}, {most - 64, 1}, {(size_t)1 << 32, (size_t)1 << 32}};
    const size_t before = hd_memory_allocations();
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++)
        assert_null(hd_memory_alloc(pairs[k][0], pairs[k][1]));
    assert_int_equal(hd_memory_allocations(), before);
}

TEST(allocations_are_counted)
{
    const size_t before = hd_memory_allocations();
    void *first = hd_memory_alloc(3, 3), *second = hd_memory_alloc(1, 1 << 21);
    assert_int_equal(hd_memory_allocations(), before + 2);
    hd_memory_free(first);
    hd_memory_free(second);
    assert_int_equal(hd_memory_allocations(), before + 2);
}

static double resident_bytes(void)
{
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%*u %lu", &pages), 1);
    fclose(file);
    return (double)pages * 4096.0;
}

/** What is taken is what is asked for, whatever part of a huge page it ends with. */
TEST(no_more_is_taken_than_asked_for)
{
    enum { BLOCKS = 32 };
    static const size_t sizes[] = {(5u << 20) / 4, 1u << 21, (5u << 20) / 2};
    if (HD_SANITIZED) skip();
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        void *block[BLOCKS];
        const double before = resident_bytes(), asked = (double)(BLOCKS * sizes[k]);
        for (int b = 0; b < BLOCKS; b++) block[b] = hd_memory_alloc(sizes[k], 1);
        CHECK_WITHIN((resident_bytes() - before) / asked, 0.9, 1.05);
        for (int b = 0; b < BLOCKS; b++) hd_memory_free(block[b]);
    }
}
