/** The golden hashes with the library as it is built here (golden.h). */
#include "golden.h"
#include "testing.h"

static void library_gives_stored_hashes(void **state)
{
    (void)state;
    for (int k = 0; k < GOLDEN_SCENES; k++) {
        assert_true(golden_hash(k) != 0);
        if (golden_hash(k) != golden_stored(k))
            fail_msg("scene %d: %016llx", k, (unsigned long long)golden_hash(k));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(library_gives_stored_hashes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
