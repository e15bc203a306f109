/** Columns of a block through the maps of kicks, LANES at once, which fill a register of the
 * processor. Who includes this, once for each kind of register, has the maps before it and CARRY,
 * which makes names. */
#if LANES == 1
typedef double CARRY(lanes);
#else
typedef double CARRY(lanes)
    __attribute__((vector_size(LANES * sizeof(double)), aligned(sizeof(double)), may_alias));
#endif

/** Of a particle, in one register or in two side by side. */
typedef struct CARRY(rows) {
    CARRY(lanes) q[2][3], p[2][3];
} CARRY(rows);

KERNEL CARRY(lanes) * CARRY(at)(double *v) { return (CARRY(lanes) *)v; }

/** A pair: bend (dq_j - dq_i) is added to dp_i and taken from dp_j; j has flown before, or does so
 * now. */
KERNEL void CARRY(pull)(CARRY(rows) * own, double *other, const double *of_pair,
                        const double *flight, int of_one, int width, int registers)
{
    const double time = flight ? *flight : 0.0;
    double bend[HD_BENDS_SPACE]; /* which no store touches */
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

/** Columns from `block` on of a particle with its partners. */
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

/** The widths are spelled out: the compiler knows then where each row is. */
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
