/** Whole runs through grazing collisions, against the exponents in long double (exact.h): thousands
 * of near ones as they come, and single extreme ones in a trajectory that is prepared. */
#include "base/check.h"
#include "exact.h"
#include "prepared.h"
#include "runs.h"

/** To which the reference is known: its own rounding, 1e-19 of a condition below 1e5, and that of
 * sums of 1e6 doubles. */
static const double EXACT = 1e-13;
static const double NEAR = 0.2; /* |p.n| / |p|; a part NEAR^2 / 2 of all is below */

static double impact_of(const hd_event *e)
{
    return fabs(e->n[0] * e->p[0] + e->n[1] * e->p[1]) / hypot(e->p[0], e->p[1]);
}

/** What the reference needs to know of a run: where its frame starts, and for how long it is
 * carried. */
typedef struct reference {
    exact_frame *x;
    long near;    /**< events below NEAR */
    double least; /**< |p.n| / |p| */
} reference;

/** The exponents' sums from t = 0 to `duration`; frees the trajectory. */
static reference reference_of(hd_trajectory *tr, const hd_frame *frame, double duration)
{
    reference r = {.x = exact_create(frame), .least = 1.0};
    OWNED(hd_record) *log = new_log();
    while (hd_trajectory_time(tr) < duration) {
        CHECK_OK(trajectory_to(tr, log, fmin(duration, hd_trajectory_time(tr) + 8.0)));
        exact_replay(r.x, log);
        for (size_t k = 0; k < log->count; k++) {
            if (events_in(log)[k].j < 0) continue;
            r.near += impact_of(&events_in(log)[k]) < NEAR;
            r.least = fmin(r.least, impact_of(&events_in(log)[k]));
        }
    }
    hd_trajectory_free(tr);
    return r;
}

static double deviation(const hd_run *run, const reference *r)
{
    double worst = 0.0;
    for (int col = 0; col < run->carrier.vectors; col++) {
        const double want = exact_log_stretch(r->x, col) / run->scene.duration;
        const double off = fabs(hd_spectrum_exponent(run->carrier.spectrum, col) - want);
        if (!(off <= worst)) worst = off;
        if (isnan(off)) return off;
    }
    return worst;
}

/** All exponents of four disks, averaged from the start. */
static hd_scene_def averaged_at_once(hd_boundary boundary, double duration)
{
    return scene(.number = 4, .density = 0.5, .aspect = 1.0, .boundary[0] = boundary,
                 .boundary[1] = boundary, .seed = 3, .exponents = HD_EXPONENTS_ALL_INDEPENDENT,
                 .equilibration = 0.0, .warmup = 0.0, .duration = duration, .report_interval = 10.0,
                 .threads = 1);
}

static hd_status status_at_end(hd_run *run)
{
    while (hd_run_stage(run) != HD_FINISHED) HD_TRY(hd_run_advance(run));
    return HD_OK;
}

static void check_against(const hd_scene_def *scene, const reference *r)
{
    OWNED(hd_run) *run = created(*scene);
    CHECK_OK(status_at_end(run));
    const double off = deviation(run, r), bound = hd_run_cost(run).error_bound;
    CHECK_CLOSE(off, 0.0, fmin(scene->accuracy, bound + EXACT));
}

static void check_many(hd_boundary boundary)
{
    const double intervals[] = {0.0, 0.0, 0.2}, accuracies[] = {1e-4, 1e-10, 1e-8};
    const double events = HD_SANITIZED || !second_tier() ? 5e4 : 2e5;
    hd_scene_def scene = averaged_at_once(boundary, 100.0);
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create(&tr, &scene));
    scene.duration = ceil(events / hd_trajectory_totals(tr).expected);
    OWNED(hd_run) *run = created(scene);
    const reference r = reference_of(tr, run->carrier.frame, scene.duration);
    assert_true((double)r.near > 0.3 * NEAR * NEAR * events);
    for (int k = 0; k < 3; k++) {
        scene.interval = intervals[k];
        scene.accuracy = accuracies[k];
        check_against(&scene, &r);
    }
    exact_free(r.x);
}

TEST(thousands_of_near_ones_keep_the_exponents)
{
    check_many(P);
    check_many(R);
}

/** Two of four disks touch and graze at once, the others come in between later. They overlap as
 * deep as a start may, or the contact would not be taken below 1e-8. */
static hd_trajectory *prepared(const hd_scene_def *scene, double impact)
{
    const double distance = 1.0 - 0.9e-9, n[2] = {cos(0.3), sin(0.3)};
    double box[2];
    hd_scene_box(scene, box);
    double q[8] = {0.2 * box[0],  0.2 * box[1], 0,           0, 0.3 * box[0],
                   0.75 * box[1], 0.8 * box[0], 0.7 * box[1]};
    double p[8] = {0, 0, 0, 0, 1.1, 0.3, -1.1, -0.3}, pair = 0.0;
    for (int d = 0; d < 2; d++) {
        const double t = d ? n[0] : -n[1];
        q[2 + d] = q[d] + distance * n[d];
        p[d] = 0.5 * impact * n[d] - 0.8 * t;
        p[2 + d] = -p[d];
    }
    for (int k = 0; k < 4; k++) pair += p[k] * p[k];
    for (int k = 4; k < 8; k++) p[k] *= sqrt((8.0 - pair) / 2.6); /* kinetic energy N */
    return started(scene, q, p);
}

typedef struct outcome {
    hd_status status;
    double off, bound; /**< largest deviation of an exponent, and what was stated */
    double impact; /**< error of b = p.n, 2 eps |p|, in the logarithm of the stretch, p_t^2 / b */
} outcome;

/** Of 20 time units after the graze. */
static outcome outcome_of(double impact, int exponents)
{
    hd_scene_def scene = scene_from(averaged_at_once(P, 20.0), .exponents = exponents);
    OWNED(hd_run) *run = created(scene);
    hd_trajectory_free(run->advance.trajectory);
    run->advance.trajectory = prepared(&scene, impact);
    const reference r = reference_of(prepared(&scene, impact), run->carrier.frame, scene.duration);
    assert_true(r.least < 1.1 * impact / 1.6 + 4.0 * DBL_EPSILON);
    outcome o = {.status = status_at_end(run),
                 .impact = 2.0 * DBL_EPSILON / r.least / scene.duration};
    o.off = deviation(run, &r);
    o.bound = hd_run_cost(run).error_bound;
    exact_free(r.x);
    return o;
}

/** Right to the stated bound and the impact, or refused by name. All of the spectrum feel the graze
 * twice, as its inverse stretches alike: a condition of (p_t^2 / b)^2; the positive half once. */
static void check_outcomes(int exponents, double survived)
{
    for (double impact = 0.1; impact > 0.5e-14; impact *= 0.1) {
        const outcome o = outcome_of(impact, exponents);
        if (o.status == HD_OK)
            CHECK_CLOSE(o.off, 0.0, o.bound + o.impact + EXACT);
        else
            assert_int_equal(o.status, HD_ILL_CONDITIONED);
        if (impact > 0.9 * survived) assert_int_equal(o.status, HD_OK);
    }
}

TEST(single_extreme_ones_are_survived_or_refused)
{
    check_outcomes(HD_EXPONENTS_ALL_INDEPENDENT, 1e-6);
    check_outcomes(HD_EXPONENTS_POSITIVE, 1e-12);
    check_outcomes(1, 1e-14);
}
