/** A row of dynamics -> whether its functions do what they say. Tests of the motion; those of
 * tangent maps are in maps_test.c and shadows_test.c. */
#include "hdlyap/dynamics_test.h"

#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/trial.h"
#include "scene/scene.h"
#include "scene/scene_check.h"

/** Time before the tests, and of a test of the motion [hd_trial.unit]; entries that these may have.
 */
static const double FIRST = 10.0, MOTION = 1.0, ENTRIES_FIRST = 1e7, ENTRIES = 1e6;
/** Parts into which an advance is cut. */
enum { PARTS = 7 };
/** Most by which motion that is cut otherwise may differ, as a part of the largest coordinate: free
 * flights round in each part, and a chaotic motion enlarges that. */
static const double CUT_CLOSE = 1e-9;

/* ---- twins --------------------------------------------------------------------------------- */

/** Two of the same particles that go their ways: their records, and q, p of each. */
typedef struct twins {
    hd_trajectory *tr[2];
    hd_record *record[2];
    double *x[2];
} twins;

static hd_status twins_create(twins *two, const hd_trial *t)
{
    *two = (twins){.tr = {NULL, NULL}};
    for (int k = 0; k < 2; k++) {
        HD_TRY(hd_record_create(&two->record[k], t->of->entry));
        two->x[k] = hd_memory_alloc(t->rows, sizeof *two->x[k]);
        if (!two->x[k]) return HD_NO_MEMORY;
    }
    return HD_OK;
}

static void twins_clear(twins *two)
{
    for (int k = 0; k < 2; k++) {
        hd_trajectory_free(two->tr[k]);
        hd_record_free(two->record[k]);
        hd_memory_free(two->x[k]);
    }
}

/** Largest difference of their q and p; NaN if one is. */
static double apart(const twins *two, const hd_trial *t)
{
    double most = 0.0;
    for (int k = 0; k < 2; k++) hd_trajectory_state(two->tr[k], two->x[k], two->x[k] + t->rows / 2);
    for (size_t k = 0; k < t->rows; k++) {
        const double difference = fabs(two->x[0][k] - two->x[1][k]);
        if (isnan(difference)) return NAN; /* which fmax leaves out */
        most = fmax(most, difference);
    }
    return most;
}

/** True if q and p are the same bits. */
static bool are_same(const twins *two, const hd_trial *t)
{
    return memcmp(two->x[0], two->x[1], t->rows * sizeof *two->x[0]) == 0;
}

/* ---- cuts of time -------------------------------------------------------------------------- */

/** Moves on by `time` in parts of random length. */
static hd_status advance_in_parts(hd_trial *t, hd_trajectory *tr, hd_record *record, double time)
{
    const double end = hd_trajectory_time(tr) + time;
    for (int k = PARTS; k > 1; k--) {
        const double left = end - hd_trajectory_time(tr);
        HD_TRY(hd_trial_advance(t, tr, record,
                                hd_trajectory_time(tr) + 2.0 * left / k * hd_trial_random(t)));
    }
    return hd_trial_advance(t, tr, record, end);
}

static hd_status compare_cut(hd_trial *t, const twins *two, double time)
{
    const double difference = apart(two, t);
    double size = 0.0;
    for (size_t k = 0; k < t->rows; k++) size = fmax(size, fabs(two->x[0][k]));
    if (!(difference <= CUT_CLOSE * size) || (t->of->step && !are_same(two, t)))
        return hd_refuse(t->message, t->size,
                         "advance: q and p differ by %.3g if %g time units are cut into %d "
                         "advances: time steps must lie at fixed times",
                         difference, time, PARTS);
    if (hd_record_count(two->record[0]) != hd_record_count(two->record[1]))
        return hd_refuse(t->message, t->size,
                         "advance: the record has %zu entries, and %zu if %g time units are cut "
                         "into %d advances",
                         hd_record_count(two->record[0]), hd_record_count(two->record[1]), time,
                         PARTS);
    return HD_OK;
}

static hd_status go_both_ways(hd_trial *t, twins *two, const hd_image *start)
{
    const double time = hd_trial_time(t, MOTION, ENTRIES);
    for (int k = 0; k < 2; k++) HD_TRY(hd_trial_make(t, &two->tr[k], start));
    HD_TRY(hd_trial_advance(t, two->tr[0], two->record[0], hd_trajectory_time(two->tr[0]) + time));
    HD_TRY(advance_in_parts(t, two->tr[1], two->record[1], time));
    return compare_cut(t, two, time);
}

static hd_status test_cuts_of_time(hd_trial *t, const hd_image *start)
{
    twins two;
    hd_status status = twins_create(&two, t);
    if (status == HD_OK) status = go_both_ways(t, &two, start);
    twins_clear(&two);
    return status;
}

/* ---- archive ------------------------------------------------------------------------------- */

/** Whether both tell the same of themselves, to the bit. */
static bool tell_same(const twins *two)
{
    const double far = hd_trajectory_divergence(two->tr[0]); /* NaN if it is not told */
    if (!isnan(far) && far != hd_trajectory_divergence(two->tr[1])) return false;
    const hd_totals a = hd_trajectory_totals(two->tr[0]), b = hd_trajectory_totals(two->tr[1]);
    return memcmp(&a, &b, sizeof a) == 0 &&
           hd_trajectory_fingerprint(two->tr[0]) == hd_trajectory_fingerprint(two->tr[1]);
}

static bool record_same(const twins *two, const hd_trial *t)
{
    const size_t count = hd_record_count(two->record[0]);
    return hd_record_count(two->record[1]) == count &&
           (count == 0 || memcmp(hd_record_entry(two->record[0], 0),
                                 hd_record_entry(two->record[1], 0), count * t->of->entry) == 0);
}

static hd_status compare_kept(hd_trial *t, const twins *two, double time)
{
    const double difference = apart(two, t),
                 late = hd_trajectory_time(two->tr[1]) - hd_trajectory_time(two->tr[0]);
    const char *what = late != 0              ? "time"
                       : !are_same(two, t)    ? "q and p"
                       : !record_same(two, t) ? "what is recorded"
                       : !tell_same(two)      ? "totals, divergence or fingerprint"
                                              : NULL;
    if (!what) return HD_OK;
    return hd_refuse(t->message, t->size,
                     "archive: %g time units after a state was written and read into a new one, "
                     "the two differ in %s, q and p by %.3g: a number is missing, or not restored",
                     time, what, difference);
}

/** tr goes on; what is kept of it must go on likewise. */
static hd_status go_on_kept(hd_trial *t, twins *two, hd_image *kept)
{
    const double time = hd_trial_time(t, MOTION, ENTRIES);
    HD_TRY(hd_trial_keep(t, kept, two->tr[0]));
    HD_TRY(hd_trial_make(t, &two->tr[1], kept));
    HD_TRY(compare_kept(t, two, 0.0));
    const double end = hd_trajectory_time(two->tr[0]) + time;
    HD_TRY(hd_trial_advance(t, two->tr[0], two->record[0], end));
    HD_TRY(hd_trial_advance_made(t, two->tr[1], two->record[1], end));
    return compare_kept(t, two, time);
}

/** Moves the particles away from their start, and keeps them. */
static hd_status test_archive(hd_trial *t, hd_image *kept)
{
    twins two;
    hd_status status = twins_create(&two, t);
    if (status == HD_OK) status = hd_trajectory_create(&two.tr[0], &t->scene);
    if (status == HD_OK)
        status = hd_trial_advance(t, two.tr[0], NULL, hd_trial_time(t, FIRST, ENTRIES_FIRST));
    if (status == HD_OK)
        status = hd_trajectory_check_null(two.tr[0], &t->scene, t->message, t->size);
    if (status == HD_OK) status = go_on_kept(t, &two, kept);
    twins_clear(&two);
    return status;
}

/* ---- averages ------------------------------------------------------------------------------ */

/** Measures one state twice, where other numbers stand before. */
static hd_status compare_measured(hd_trial *t, const double *x)
{
    double value[2][HD_AVERAGES_MAX + 1];
    const int count = t->of->averages;
    for (int twice = 0; twice < 2; twice++) {
        for (int k = 0; k <= HD_AVERAGES_MAX; k++) value[twice][k] = 1.5 + twice;
        t->of->measure(&t->scene, x, x + t->rows / 2, value[twice]);
        if (value[twice][count] != 1.5 + twice)
            return hd_refuse(t->message, t->size,
                             "measure: must not write more than averages = %d numbers", count);
    }
    for (int k = 0; k < count; k++)
        if (!(value[0][k] == value[1][k] && fabs(value[0][k]) <= HD_AVERAGE_MOST))
            return hd_refuse(
                t->message, t->size,
                "measure: %s is %g, and then %g of the same state: must be from -1e100 "
                "to 1e100, and follow from the state alone",
                t->of->average[k].name, value[0][k], value[1][k]);
    return HD_OK;
}

static hd_status test_measure(hd_trial *t, const hd_image *kept)
{
    hd_trajectory *tr = NULL;
    double *x = hd_memory_alloc(t->rows, sizeof *x);
    hd_status status = x ? HD_OK : HD_NO_MEMORY;
    if (status == HD_OK) status = hd_trial_make(t, &tr, kept);
    if (status == HD_OK) {
        hd_trajectory_state(tr, x, x + t->rows / 2);
        status = compare_measured(t, x);
    }
    hd_trajectory_free(tr);
    hd_memory_free(x);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

static hd_status test_all(hd_trial *t, hd_image *kept)
{
    HD_TRY(test_archive(t, kept));
    if (t->of->averages > 0) HD_TRY(test_measure(t, kept));
    HD_TRY(test_cuts_of_time(t, kept));
    HD_TRY(hd_maps_test_cuts(t, kept));
    HD_TRY(hd_maps_test_symplectic(t, kept));
    HD_TRY(hd_maps_test_shadows(t, kept));
    HD_TRY(hd_maps_test_null(t, kept));
    return hd_maps_test_zeros(t, kept);
}

hd_status hd_dynamics_test(const hd_dynamics *row, const hd_scene_def *scene, char *message,
                           size_t size)
{
    hd_trial trial;
    hd_image kept = {NULL, 0};
    HD_TRY(hd_dynamics_check(row, message, size));
    const hd_scene_def usual = hd_scene_def_of(row), *asked = scene ? scene : &usual;
    if (hd_dynamics_of(asked) != row)
        return hd_refuse(message, size, "particles = %s: must be %s, as the row is tested on them",
                         hd_dynamics_of(asked)->particles, row->particles);
    HD_TRY(hd_scene_check_start(asked, message, size));
    hd_status status = hd_trial_create(&trial, row, asked, message, size);
    if (status == HD_OK) status = test_all(&trial, &kept);
    hd_trial_clear(&trial);
    hd_memory_free(kept.bytes);
    return status;
}
