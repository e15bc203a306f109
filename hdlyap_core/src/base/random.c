/** xoshiro256**, filled by splitmix64 as its authors advise. */
#include "base/random.h"

static uint64_t splitmix(uint64_t *x)
{
    uint64_t z = (*x += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

hd_random hd_random_seeded(uint64_t seed, uint64_t stream)
{
    hd_random random;
    uint64_t x = seed;
    x = splitmix(&x) ^ stream;
    for (int k = 0; k < 4; k++) random.s[k] = splitmix(&x);
    return random;
}

static uint64_t rotate(uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

static uint64_t next(hd_random *random)
{
    uint64_t *s = random->s;
    const uint64_t result = rotate(s[1] * 5, 7) * 9;
    const uint64_t t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotate(s[3], 45);
    return result;
}

double hd_random_symmetric(hd_random *random)
{
    return (double)(next(random) >> 11) * 0x1p-52 - 1.0;
}
