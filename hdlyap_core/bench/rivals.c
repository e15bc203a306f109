/** What others write, on the same trajectory and with the same BLAS: seconds per time unit of
 * (ours) hd_run, spectrum alone;
 * (qr)   unblocked replay, Householder QR (dgeqrf, dorgqr) every half time unit;
 * (mgs)  unblocked replay, modified Gram-Schmidt once per time unit;
 * and their ratios, in rounds.
 * Usage: hdlyap_rivals [--disks N] [--rounds N] [--duration TIME UNITS OF OURS IN A ROUND] [--out
 * FOLDER]; with --out it writes FOLDER/rivals.csv. */
#include <hdlyap/hdlyap.h>
#include <stdio.h>

#include "columns.h"
#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "ratio.h"
#include "timing.h"

static hd_scene_def scene_of(int disks)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = disks;
    scene.density = 0.7;
    scene.aspect = 1.0;
    scene.equilibration = 20.0;
    scene.warmup = 10.0;
    scene.report_interval = 10.0; /* the others report nothing */
    return scene;
}

/* ---- ours ---------------------------------------------------------------------------------- */

static hd_run *ours_create(int disks)
{
    const hd_scene_def scene = scene_of(disks);
    hd_run *run = created(&scene);
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    return run;
}

/** Seconds per time unit of the next `duration`. */
static double ours(hd_run *run, double duration)
{
    const double start = seconds(), begin = hd_run_time(run);
    while (hd_run_time(run) < begin + duration - 1e-9) require(hd_run_advance(run), "averaging");
    return (seconds() - start) / (hd_run_time(run) - begin);
}

/* ---- theirs -------------------------------------------------------------------------------- */

typedef struct rival {
    hd_trajectory *trajectory;
    hd_event_log *log;
    columns x;
    double *since; /**< [disks], of the last event of each */
    double interval;
    void (*orthonormalise)(columns *);
} rival;

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
static void replay(columns *x, double *since, const hd_event_log *log)
{
    for (int i = 0; i < x->rows / 4; i++) since[i] = 0.0;
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *e = &log->event[k];
        for (int l = 0; l < x->n; l++) {
            double *v = x->v + (size_t)l * (size_t)x->rows;
            fly(v + 4 * e->i, e->t - since[e->i]);
            fly(v + 4 * e->j, e->t - since[e->j]);
            collide(v + 4 * e->i, v + 4 * e->j, e);
        }
        since[e->i] = since[e->j] = e->t;
    }
    for (int l = 0; l < x->n; l++)
        for (int i = 0; i < x->rows / 4; i++)
            fly(x->v + (size_t)l * (size_t)x->rows + 4 * i, log->duration - since[i]);
}

/** Seconds per time unit of `steps` intervals. */
static double theirs(rival *r, int steps)
{
    const double start = seconds();
    for (int k = 0; k < steps; k++) {
        const double end = hd_trajectory_time(r->trajectory) + r->interval;
        hd_event_log_clear(r->log);
        require(hd_trajectory_extend(r->trajectory, r->log, end), "trajectory");
        replay(&r->x, r->since, r->log);
        r->orthonormalise(&r->x);
    }
    return (seconds() - start) / (r->interval * steps);
}

/** After one interval that does not count. */
static rival rival_create(int disks, double interval, void (*orthonormalise)(columns *))
{
    const hd_scene_def scene = scene_of(disks);
    rival r = {.interval = interval, .orthonormalise = orthonormalise};
    require(hd_trajectory_create(&r.trajectory, &scene), "trajectory");
    require(hd_event_log_create(&r.log), "trajectory");
    require(hd_trajectory_extend(r.trajectory, r.log, scene.equilibration), "trajectory");
    r.x = columns_create(4 * disks, hd_scene_vectors(&scene));
    r.since = room((size_t)disks, sizeof(double));
    for (size_t k = 0; k < (size_t)r.x.n * (size_t)r.x.rows; k++)
        r.x.v[k] = (double)rand() / RAND_MAX - 0.5;
    columns_householder(&r.x);
    theirs(&r, 1);
    return r;
}

static void rival_free(rival *r)
{
    columns_free(&r->x);
    free(r->since);
    hd_event_log_free(r->log);
    hd_trajectory_free(r->trajectory);
}

/* ---- side by side -------------------------------------------------------------------------- */

typedef struct result {
    sample ours, qr, mgs;           /**< seconds per time unit */
    sample qr_to_ours, mgs_to_ours; /**< of the same round */
} result;

static void measure(int disks, int rounds, double duration, gemm *g, result *r)
{
    hd_run *run = ours_create(disks); /* BLAS keeps its number of threads for the others */
    rival qr = rival_create(disks, 0.5, columns_householder);
    rival mgs = rival_create(disks, 1.0, columns_gram_schmidt);
    progress p = progress_begin("rivals", rounds);
    for (int k = 0; k < rounds; k++) {
        const double w = ours(run, duration);
        const double a = theirs(&qr, 2), b = theirs(&mgs, 1);
        gemm_measure(g);
        sample_add(&r->ours, w);
        sample_add(&r->qr, a);
        sample_add(&r->mgs, b);
        sample_add(&r->qr_to_ours, a / w);
        sample_add(&r->mgs_to_ours, b / w);
        progress_add(&p, 1.0);
    }
    progress_end();
    rival_free(&qr);
    rival_free(&mgs);
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    int disks = 780, rounds = 5;
    double duration = 4.0;
    const char *out = NULL;
    const option list[] = {{"--disks", .count = &disks, .least = 10, .most = 5000},
                           {"--rounds", .count = &rounds, .least = 1, .most = SAMPLE_MAX},
                           {"--duration", .number = &duration, .least = 1, .most = 1e6},
                           {"--out", .text = &out},
                           {0}};
    options_read(argc, argv, list);
    hd_blas_restart_if_slow(argv);
    const hd_scene_def scene = scene_of(disks);
    result r = {0};
    gemm *g = gemm_create(disks, hd_scene_vectors(&scene));
    measure(disks, rounds, duration, g, &r);
    printf("%d disks, density 0.7, positive half, %s kernels, %d rounds\n", disks,
           hd_blas_query().kernel, rounds);
    table *t = ratio_begin(out, "rivals");
    ratio_tell(t, "ours at accuracy 1e-8 [s/time unit]", disks, &r.ours);
    ratio_tell(t, "dgeqrf + dorgqr every 0.5 [s/time unit]", disks, &r.qr);
    ratio_tell(t, "modified Gram-Schmidt every 1 [s/time unit]", disks, &r.mgs);
    ratio_tell(t, "dgeqrf + dorgqr to ours", disks, &r.qr_to_ours);
    ratio_tell(t, "modified Gram-Schmidt to ours", disks, &r.mgs_to_ours);
    if (t) table_write(t, argv, gemm_rate(g));
    gemm_free(g);
    return 0;
}
