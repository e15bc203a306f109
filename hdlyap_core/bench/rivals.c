/** What others write, on the same trajectory and with the same BLAS: seconds per time unit of
 *  (ours) hd_run, spectrum alone;
 *  (qr)   unblocked replay, Householder QR (dgeqrf, dorgqr) every half time unit;
 *  (mgs)  unblocked replay, modified Gram-Schmidt once per time unit.
 *  Usage: hdlyap_rivals [disks, default 780] [time units of ours, default 20] */
#define _POSIX_C_SOURCE 199309L
#include <cblas.h>
#include <hdlyap/hdlyap.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "timing.h"

/** Tangent vectors as most programs keep them: one after the other, 4N numbers each. */
typedef struct vectors {
    int rows, n;
    double *v;     /**< [n][rows]: dq_x dq_y dp_x dp_y of each disk */
    double *since; /**< [disks], of the last event of each */
    double *tau;   /**< [n], of LAPACK */
} vectors;

static hd_scene_def scene_of(int disks)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = disks;
    scene.density = 0.7;
    scene.aspect = 1.0;
    scene.equilibration = 20.0;
    scene.warmup = 10.0;
    return scene;
}

/* ---- ours ------------------------------------------------------------------------------------- */

static double ours(int disks, double duration)
{
    hd_scene_def scene = scene_of(disks);
    scene.duration = duration;
    hd_run *run;
    require(hd_run_create(&run, &scene, NULL, 0), "scene");
    while (hd_run_phase(run) != HD_AVERAGING) require(hd_run_step(run), "warm-up");
    const double start = seconds();
    while (hd_run_phase(run) != HD_FINISHED) require(hd_run_step(run), "averaging");
    const double taken = seconds() - start;
    hd_run_free(run);
    return taken / duration;
}

/* ---- theirs ----------------------------------------------------------------------------------- */

static vectors vectors_create(int disks, int n)
{
    vectors x = {.rows = 4 * disks, .n = n};
    x.v = malloc((size_t)n * (size_t)x.rows * sizeof(double));
    x.since = calloc((size_t)disks, sizeof(double));
    x.tau = calloc((size_t)n, sizeof(double));
    if (!x.v || !x.since || !x.tau) require(HD_NO_MEMORY, "vectors");
    for (size_t k = 0; k < (size_t)n * (size_t)x.rows; k++)
        x.v[k] = (double)rand() / RAND_MAX - 0.5;
    return x;
}

static void vectors_free(vectors *x)
{
    free(x->v);
    free(x->since);
    free(x->tau);
}

static void fly(double *v, double tau)
{
    v[0] += tau * v[2];
    v[1] += tau * v[3];
}

/** The collision of [T3] on one vector. */
static void collide(double *vi, double *vj, const hd_event *e)
{
    const double nx = e->n[0], ny = e->n[1];
    const double b = e->p[0] * nx + e->p[1] * ny, pt = e->p[1] * nx - e->p[0] * ny;
    const double qx = vj[0] - vi[0], qy = vj[1] - vi[1], px = vj[2] - vi[2], py = vj[3] - vi[3];
    const double a = qx * nx + qy * ny, s = qy * nx - qx * ny - pt / b * a;
    const double u = px * nx + py * ny + pt * s, w = b * s;
    vi[0] += a * nx, vi[1] += a * ny, vj[0] -= a * nx, vj[1] -= a * ny;
    vi[2] += u * nx - w * ny, vi[3] += u * ny + w * nx;
    vj[2] -= u * nx - w * ny, vj[3] -= u * ny + w * nx;
}

/** Event by event, all vectors each. */
static void replay(vectors *x, const hd_event_log *log)
{
    for (int i = 0; i < x->rows / 4; i++) x->since[i] = 0.0;
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *e = &log->event[k];
        for (int l = 0; l < x->n; l++) {
            double *v = x->v + (size_t)l * (size_t)x->rows;
            fly(v + 4 * e->i, e->t - x->since[e->i]);
            fly(v + 4 * e->j, e->t - x->since[e->j]);
            collide(v + 4 * e->i, v + 4 * e->j, e);
        }
        x->since[e->i] = x->since[e->j] = e->t;
    }
    for (int l = 0; l < x->n; l++)
        for (int i = 0; i < x->rows / 4; i++)
            fly(x->v + (size_t)l * (size_t)x->rows + 4 * i, log->duration - x->since[i]);
}

static void householder(vectors *x)
{
    if (LAPACKE_dgeqrf(LAPACK_COL_MAJOR, x->rows, x->n, x->v, x->rows, x->tau) != 0 ||
        LAPACKE_dorgqr(LAPACK_COL_MAJOR, x->rows, x->n, x->n, x->v, x->rows, x->tau) != 0)
        require(HD_ILL_CONDITIONED, "dgeqrf");
}

static void gram_schmidt(vectors *x)
{
    for (int l = 0; l < x->n; l++) {
        double *v = x->v + (size_t)l * (size_t)x->rows;
        const double norm = cblas_dnrm2(x->rows, v, 1);
        cblas_dscal(x->rows, 1.0 / norm, v, 1);
        for (int m = l + 1; m < x->n; m++) {
            double *w = x->v + (size_t)m * (size_t)x->rows;
            cblas_daxpy(x->rows, -cblas_ddot(x->rows, v, 1, w, 1), v, 1, w, 1);
        }
    }
}

/** Seconds per time unit of `steps` intervals, after one that is not counted. */
static double theirs(int disks, double interval, int steps, void (*orthonormalise)(vectors *))
{
    const hd_scene_def scene = scene_of(disks);
    hd_trajectory *trajectory;
    hd_event_log *log;
    require(hd_trajectory_create(&trajectory, &scene), "trajectory");
    require(hd_event_log_create(&log), "trajectory");
    require(hd_trajectory_advance(trajectory, log, scene.equilibration), "trajectory");
    vectors x = vectors_create(disks, hd_scene_vectors(&scene));
    hd_blas_use_threads(hd_blas_query().cores);
    orthonormalise(&x);
    const double start = seconds();
    for (int k = 0; k < steps; k++) {
        const double end = hd_trajectory_time(trajectory) + interval;
        require(hd_trajectory_advance(trajectory, log, end), "trajectory");
        replay(&x, log);
        orthonormalise(&x);
    }
    const double taken = seconds() - start;
    vectors_free(&x);
    hd_event_log_free(log);
    hd_trajectory_free(trajectory);
    return taken / (interval * steps);
}

int main(int argc, char **argv)
{
    hd_blas_restart_if_slow(argv);
    const int disks = argc > 1 ? atoi(argv[1]) : 780;
    const double duration = argc > 2 ? atof(argv[2]) : 20.0;
    if (disks < 10 || disks > 5000 || !(duration > 0 && duration < 1e6)) {
        fprintf(stderr, "hdlyap_rivals: disks = %d, time units = %g: must be 10 .. 5000, above 0\n",
                disks, duration);
        return 2;
    }
    const double w = ours(disks, duration);
    printf("%d disks, density 0.7, positive half, %s kernels; seconds per time unit and ratio\n",
           disks, hd_blas_query().kernel);
    printf("ours, accuracy 1e-8                            %10.4f\n", w);
    const double qr = theirs(disks, 0.5, 4, householder);
    printf("unblocked replay, dgeqrf + dorgqr every 0.5    %10.4f %8.1f\n", qr, qr / w);
    const double mgs = theirs(disks, 1.0, 1, gram_schmidt);
    printf("unblocked replay, modified Gram-Schmidt every 1 %9.4f %8.1f\n", mgs, mgs / w);
    return 0;
}
