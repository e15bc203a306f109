/** Checks parts of a run; a broken invariant is an assertion. */
#include "tangent/verify.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "dynamics/dynamics.h"
#include "scene/container.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "tangent/conjugate.h"
#include "tangent/frame.h"
#include "tangent/interval.h"

/** Asserts that `value` is a number and at most `limit`. */
static void expect_at_most(double value, double limit, const char *what)
{
    const bool holds = value <= limit;
    if (!holds) fprintf(stderr, "hdlyap: verify: %s: %.3g above %.3g\n", what, value, limit);
    HD_ASSERT(holds);
}

/* ---- particles ------------------------------------------------------------------------------ */

static void expect_momentum(const hd_invariants *now, const hd_scene_def *scene)
{
    const double most = scene->number * now->energy_rounding;
    for (int d = 0; d < hd_scene_dimension(scene); d++)
        if (hd_null_conserved(scene, d) == 1.0)
            expect_at_most(fabs(now->momentum[d]), most, "momentum");
    if (!hd_container_of(scene)->rotates) return;
    double box[HD_DIMENSION_MAX];
    hd_scene_box(scene, box);
    expect_at_most(fabs(now->angular_momentum), most * box[0], "angular momentum");
}

void hd_verify_trajectory(const hd_trajectory *tr, const hd_scene_def *scene)
{
    if (!hd_dynamics_of(scene)->examine) return;
    const hd_invariants now = hd_trajectory_examined(tr);
    expect_at_most(now.overlap, now.overlap_max, "overlap");
    expect_at_most(fabs(now.energy_error), now.energy_rounding, "energy");
    expect_momentum(&now, scene);
}

void hd_verify_record(const hd_record *record, const hd_scene_def *scene)
{
    const char *fault = hd_record_fault(record, scene);
    if (fault) fprintf(stderr, "hdlyap: verify: events: %s\n", fault);
    HD_ASSERT(!fault);
}

/* ---- frame --------------------------------------------------------------------------------- */

/** The first vector of pair k, spread over this rank's vectors; the second one is the last of them.
 */
static int first_of(const hd_frame *frame, int k)
{
    return (int)((long)hd_frame_columns(frame).count * k / HD_VERIFY_PAIRS);
}

/** Rows are dq_x, dq_y, .. dp_x, dp_y, .. of each particle. */
static void pair_products(const hd_frame *frame, int a, int b, double *product, double *scale)
{
    const int half = hd_frame_coordinates(frame);
    const double *data = hd_frame_read(frame);
    double sum = 0.0, aa = 0.0, bb = 0.0;
    for (int row = 0; row < hd_frame_rows(frame); row++) {
        const double x = data[(size_t)row * (size_t)hd_frame_stride(frame) + (size_t)a];
        const double y = data[(size_t)row * (size_t)hd_frame_stride(frame) + (size_t)b];
        sum += hd_turned_sign(row, half) * x *
               data[(size_t)hd_turned(row, half) * (size_t)hd_frame_stride(frame) + (size_t)b];
        aa += x * x;
        bb += y * y;
    }
    *product = sum;
    *scale = sqrt(aa * bb);
}

hd_symplectic hd_verify_sample(const hd_frame *frame)
{
    hd_symplectic s = {0};
    const int last = hd_frame_columns(frame).count - 1;
    for (int k = 0; k < HD_VERIFY_PAIRS && last >= 0; k++)
        pair_products(frame, first_of(frame, k), last, &s.product[k], &s.scale[k]);
    return s;
}

/** The limit: every event rounds the entries that it changes, of a vector that grows. */
void hd_verify_symplectic(const hd_frame *frame, const hd_symplectic *before, double events)
{
    if (!hd_scene_symplectic(&frame->scene)) return;
    const hd_symplectic after = hd_verify_sample(frame);
    const double per_particle = 8.0 * events / hd_frame_rows(frame);
    for (int k = 0; k < HD_VERIFY_PAIRS; k++)
        expect_at_most(fabs(after.product[k] - before->product[k]),
                       16.0 * DBL_EPSILON * (4.0 + per_particle) *
                           fmax(before->scale[k], after.scale[k]),
                       "symplectic product");
}

/** A defect changes the volume by its square, for each pair of vectors [T5]. Products of many rows
 * are rounded as a random walk. */
void hd_verify_ortho(hd_ortho *ortho, hd_frame *frame)
{
    const double n = hd_frame_vectors(frame), defect = hd_ortho_defect(ortho);
    const double least = fmax(64.0, sqrt(hd_frame_rows(frame))) * DBL_EPSILON;
    expect_at_most(hd_ortho_defect_measured(ortho, frame, hd_ortho_norm(ortho)),
                   fmax(defect, least), "orthogonality");
    if (hd_frame_vectors(frame) < hd_frame_rows(frame)) return; /* always so in the norm of dq */
    if (!hd_scene_symplectic(&frame->scene)) return;
    double sum = 0.0;
    for (int col = 0; col < hd_frame_vectors(frame); col++) sum += hd_ortho_log_stretch(ortho)[col];
    expect_at_most(fabs(sum),
                   n * HD_ROUNDING * hd_ortho_condition(ortho) + n * n * 1e-8 + n * least,
                   "volume");
}

/** The limit is what a run allows, times what an estimate from few pairs may miss. */
void hd_verify_isotropy(const hd_frame *frame)
{
    expect_at_most(hd_conjugate_isotropy_measured(frame), 1e-5, "isotropy");
}
