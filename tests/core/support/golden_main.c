/** Prints every golden hash; fails if one is not as stored. Built once per compiler and level by
 * golden_levels.cmake, from the trajectory's sources alone. */
#include <inttypes.h>
#include <stdio.h>

#include "golden.h"

int main(void)
{
    int wrong = 0;
    for (int k = 0; k < GOLDEN_SCENES; k++) {
        const uint64_t hash = golden_hash(k);
        const int same = hash != 0 && hash == golden_stored(k);
        printf("scene %d: 0x%016" PRIx64 "%s\n", k, hash, same ? "" : " is not the stored one");
        wrong += !same;
    }
    return wrong != 0;
}
