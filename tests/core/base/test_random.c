/** Random numbers against values of an independent program, and against what uniform means. */
#include "base/random.h"
#include "testing.h"

/** From a Python program written after the papers of Blackman and Vigna: splitmix64 on the seed,
 * its first output xor the stream is the state that splitmix64 then fills s[0..3] from; (next >>
 * 11) 2^-52 - 1. */
static const struct {
    uint64_t seed, stream;
    double value[4];
} KNOWN[] = {
    {0u,
     0u,
     {0x1.ed5017def5e70p-1, -0x1.fcd9c764c56a0p-5, -0x1.57ae47d9fc052p-1, -0x1.bd75c4123c374p-2}},
    {1u,
     0u,
     {0x1.b849ff984d0dap-1, 0x1.5b6b634d2861cp-1, -0x1.56b4fa4c4fbbcp-1, 0x1.af9091d9f77d0p-3}},
    {1u,
     1u,
     {-0x1.3da3ac4f1cb32p-1, -0x1.90fbae30b5ff8p-1, 0x1.527bddf7952d0p-2, 0x1.9062d5c733120p-1}},
    {12345678901234567890u,
     7u,
     {-0x1.1159a8aca56c0p-3, 0x1.16fae16d21d60p-3, -0x1.ddd8ce4700780p-1, -0x1.11193afa95032p-1}},
    {18446744073709551615u,
     18446744073709551615u,
     {-0x1.2edced3db2888p-2, -0x1.fa2102fa773eap-1, 0x1.7359f05bc75e0p-3, -0x1.1bcd48dde408ap-1}},
};

TEST(known_first_values)
{
    for (size_t k = 0; k < sizeof KNOWN / sizeof *KNOWN; k++) {
        hd_random random = hd_random_seeded(KNOWN[k].seed, KNOWN[k].stream);
        for (int n = 0; n < 4; n++) {
            const double value = hd_random_symmetric(&random);
            if (value != KNOWN[k].value[n])
                fail_msg("seed %zu value %d: got %a want %a", k, n, value, KNOWN[k].value[n]);
        }
    }
}

TEST(seeds_and_streams_differ)
{
    enum { N = 30 };
    double first[N * N];
    for (int k = 0; k < N * N; k++) {
        hd_random random = hd_random_seeded((uint64_t)(k / N), (uint64_t)(k % N));
        first[k] = hd_random_symmetric(&random);
        for (int before = 0; before < k; before++) assert_true(first[before] != first[k]);
    }
}
