/** Two runs -> their numbers, one by one. */
#include "same.h"
#include "kept.h"
#include "said.h"

/** What the wall clock says differs between two runs. */
static bool of_the_clock(const char *name)
{
    return strncmp(name, "run wall", 8) == 0 || strcmp(name, "cost") == 0;
}

/** All arrays of both, but those. */
static void expect_same_bytes(const bytes *a, const bytes *b)
{
    assert_int_equal(a->size, b->size);
    for (size_t at = 0; at < a->size;) {
        const char *name = a->data + at;
        const size_t size = kept_array_size(name);
        if (!of_the_clock(name) && memcmp(name, b->data + at, size) != 0)
            fail_msg("%s differs", name);
        at += size;
    }
}

void expect_same_state(hd_run *a, hd_run *b)
{
    said by_a = said_by(a), by_b = said_by(b);
    expect_same_said(&by_a, &by_b);
    said_free(&by_a);
    said_free(&by_b);
    const bytes of_a = kept_bytes(a), of_b = kept_bytes(b);
    expect_same_bytes(&of_a, &of_b);
    free(of_a.data);
    free(of_b.data);
}
