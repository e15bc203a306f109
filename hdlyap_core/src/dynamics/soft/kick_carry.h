/** Carries columns of a block through the maps of kicks, LANES columns at once, which fill a
 * register of the processor. kick_maps.c includes this file once for each size of registers, after
 * it defines the maps, LANES, and CARRY, which adds the size to names. */
#if LANES == 1
typedef double CARRY(lanes);
#else
typedef double CARRY(lanes)
    __attribute__((vector_size(LANES * sizeof(double)), aligned(sizeof(double)), may_alias));
#endif

/** The rows of a particle, dq and dp, for the columns of one register or of two side by side. */
typedef struct CARRY(rows) {
    CARRY(lanes) q[2][3], p[2][3];
} CARRY(rows);

KERNEL CARRY(lanes) * CARRY(at)(double *v) { return (CARRY(lanes) *)v; }

/** Kicks a pair: adds bend (dq_j - dq_i) to dp_i and subtracts it from dp_j. own: rows of i, after
 * its flight. other: rows of j, which flies first for the time *flight; NULL if it has flown
 * already. */
KERNEL void CARRY(pull)(CARRY(rows) * own, double *other, const double *of_pair,
                        const double *flight, int of_one, int width, int registers)
{
    const double time = flight ? *flight : 0.0;
    double bend[HD_BENDS_SPACE]; /* a copy, which the compiler knows that no store below changes */
    for (int k = 0; k < bends_of(of_one); k++) bend[k] = of_pair[k];
    for (int c = 0; c < registers; c++, other += LANES) {
        CARRY(lanes) r[3], p[3];
        for (int d = 0; d < of_one; d++) {
            p[d] = *CARRY(at)(other + (of_one + d) * width);
            r[d] = *CARRY(at)(other + d * width);
            if (flight) *CARRY(at)(other + d * width) = r[d] += time * p[d];
            r[d] -= own->q[c][d];
        }
        for (int d = 0; d < of_one; d++) {
            CARRY(lanes) f = bend[place(d, 0, of_one)] * r[0];
            for (int e = 1; e < of_one; e++) f += bend[place(d, e, of_one)] * r[e];
            own->p[c][d] += f;
            *CARRY(at)(other + (of_one + d) * width) = p[d] - f;
        }
    }
}

/** Carries columns from `block` on through a run: particle i flies, then each pair is kicked. */
KERNEL void CARRY(pull_run)(double *block, const run *r, const int32_t *with, const double *bend,
                            const double *flight, int of_one, int width, int registers)
{
    const size_t one = 2 * (size_t)(of_one * width);
    const int32_t come = r->come, pairs = r->pairs;
    const double time = *flight++;
    double *at = block + one * (size_t)r->i;
    CARRY(rows) own;
    for (int c = 0; c < registers; c++)
        for (int d = 0; d < of_one; d++) {
            double *q = at + d * width + c * LANES;
            own.p[c][d] = *CARRY(at)(q + of_one * width);
            own.q[c][d] = *CARRY(at)(q) + time * own.p[c][d];
            if (time != 0) *CARRY(at)(q) = own.q[c][d];
        }
    for (int32_t n = 0; n < come; n++, bend += bends_of(of_one))
        CARRY(pull)(&own, block + one * (size_t)with[n], bend, flight++, of_one, width, registers);
    for (int32_t n = come; n < pairs; n++, bend += bends_of(of_one))
        CARRY(pull)(&own, block + one * (size_t)with[n], bend, NULL, of_one, width, registers);
    for (int c = 0; c < registers; c++)
        for (int d = 0; d < of_one; d++)
            *CARRY(at)(at + (of_one + d) * width + c * LANES) = own.p[c][d];
}

KERNEL void CARRY(through)(double *block, const maps *all, int of_one, int width)
{
    const int registers = LANES > 1 && width >= 2 * LANES ? 2 : 1;
    const double *bend = all->bend, *flight = all->flight;
    const int32_t *with = all->with;
    for (const run *r = all->run; r < all->run + all->runs; r++) {
        for (int c = 0; c < width; c += LANES * registers)
            CARRY(pull_run)(block + c, r, with, bend, flight, of_one, width, registers);
        with += r->pairs;
        bend += bends_of(of_one) * r->pairs;
        flight += 1 + r->come;
    }
    for (int i = 0; i < all->particles; i++, block += 2 * of_one * width)
        fly(block, all->since[i], of_one * width);
}

/** Calls through() with usual widths as constants, with which the compiler knows where rows are. */
KERNEL void CARRY(carry)(double *block, const maps *all, int of_one, int width)
{
    switch (width) {
    case 8: CARRY(through)(block, all, of_one, 8); break;
    case 16: CARRY(through)(block, all, of_one, 16); break;
    case 32: CARRY(through)(block, all, of_one, 32); break;
    case HD_BLOCK_WIDTH_MAX: CARRY(through)(block, all, of_one, HD_BLOCK_WIDTH_MAX); break;
    default: through_1(block, all, of_one, width); break;
    }
}

#undef CARRY
#undef LANES
