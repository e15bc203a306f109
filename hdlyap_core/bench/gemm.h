/** Measures dgemm with the shape of the Gram matrix between pieces of work: it is the machine's
 * speed at that time, whatever else the machine is doing. */
#ifndef HD_BENCH_GEMM_H
#define HD_BENCH_GEMM_H

typedef struct gemm gemm;

/** Prepares V^T V for V of m x n. To measure the rate, m may be a part of a frame's rows. */
gemm *gemm_create(int m, int n);
void gemm_free(gemm *g);

/** Measures once more. Returns the seconds that it took. */
double gemm_measure(gemm *g);

/** Flops per second by a single measurement, for the comment of a table. */
double gemm_once(void);

double gemm_last(const gemm *g); /**< flops per second of the last measurement */
double gemm_rate(const gemm *g); /**< median flops per second */

/** The least seconds per time unit that a spectrum of n exponents in m dimensions costs: F = 4 m
 * n^2 flops at this rate of dgemm per ln(1e8) / spread of simulated time; spread: lambda_1 -
 * lambda_n. */
double gemm_floor(double rate, int m, int n, double spread);

#endif
