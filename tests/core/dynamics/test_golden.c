/** The golden hashes with the library as it is built here (golden.h). */
#include "golden.h"
#include "testing.h"

TEST(library_gives_stored_hashes)
{
    for (int k = 0; k < GOLDEN_SCENES; k++) {
        assert_true(golden_hash(k) != 0);
        if (golden_hash(k) != golden_stored(k))
            fail_msg("scene %d: %016llx", k, (unsigned long long)golden_hash(k));
    }
}
