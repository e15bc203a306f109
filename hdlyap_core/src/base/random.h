/** Seeded random numbers, the same bits everywhere: xoshiro256** (Blackman and Vigna 2018). */
#ifndef HD_RANDOM_H
#define HD_RANDOM_H

#include <stdint.h>

typedef struct hd_random {
    uint64_t s[4];
} hd_random;

/** Every seed is allowed; different streams of one seed are independent. */
hd_random hd_random_seeded(uint64_t seed, uint64_t stream);

/** Uniform in [-1, 1), a multiple of 2^-52. */
double hd_random_symmetric(hd_random *random);

#endif
