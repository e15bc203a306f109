/** dgemm on the shape of the Gram matrix, measured in between the work: the machine's speed at the
 * time, whatever else it is doing. */
#ifndef HD_BENCH_GEMM_H
#define HD_BENCH_GEMM_H

typedef struct gemm gemm;

/** V^T V for V of m x n; a part of the rows is enough for the rate. */
gemm *gemm_create(int m, int n);
void gemm_free(gemm *g);

/** One more measurement; returns the seconds that it took. */
double gemm_measure(gemm *g);

/** The same by one measurement of its own: for the comment of a table. */
double gemm_once(void);

double gemm_last(const gemm *g); /**< flops per second of the last measurement */
double gemm_rate(const gemm *g); /**< median flops per second */

/** Seconds per time unit that a spectrum of n exponents in 4N = m dimensions costs at least:
 * F = 4 m n^2 flops at this rate of dgemm per ln(1e8) / (lambda_1 - lambda_n) of simulated time.
 */
double gemm_floor(double rate, int m, int n, double spread);

#endif
