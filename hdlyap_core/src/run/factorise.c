/** Log -> frame -> orthonormal frame, spectrum, and what the next interval may be. An interval that
 * turned out too long is taken back and replayed in pieces; a shortest piece that is still too much
 * holds a grazing collision and is factored by reflections. */
#include "run/factorise.h"

#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "tangent/verify.h"

/** Loss of orthogonality allowed where nobody looks at the vectors, as the logarithms telescope
 * [T5]; its square enters a mean. */
static const double DEFECT_LOOSE = 1e-4;
/** The same where somebody does. */
static const double DEFECT_MEASURED = 1e-6;
/** Of a frame that is orthonormal in the norm of dq, at most: few collisions are that sharp. */
static const double CONDITION_COMPLETE = 1e12;
/** The same where Y takes both ends of an interval to be orthonormal to rounding [T19]: a second
 * pass. */
static const double DEFECT_COUPLED = 1e-12;
/** Part of an interval's share of the accuracy that its square may be, as it too bounds a mean. */
static const double DEFECT_SHARE = 0.1;
/** Of an interval, beyond which dividing costs more than it saves [T6]; and beyond which what even
 * reflections cannot factor is given up. */
enum { PIECES_MAX = 8, PIECES_LAST = 512 };
/** Vectors from which on the norm of dq is worth while; and orthonormalisations after which the
 * vectors of a random start have dq halves as independent as the vectors themselves. */
enum { HALVES_MANY = 64, HALVES_ALIGNED = 8 };
/** Loss of isotropy beyond which the frame is made isotropic again: as much as orthogonality may
 * lack where somebody looks [T19]. */
static const double ISOTROPY = 1e-6;

hd_status hd_run_replay(hd_run *run, double t_begin, double t_end)
{
    hd_symplectic before;
    if (HD_VERIFIES) before = hd_verify_sample(run->frame);
    HD_TRY(hd_frame_replay(run->frame, run->log, t_begin, t_end));
    if (HD_VERIFIES) hd_verify_symplectic(run->frame, &before, (double)run->log->count);
    return HD_OK;
}

/** Pieces of the log that are factored by reflections: a collision of each disk, or an eighth of an
 * interval that is only a few collisions long. */
static double shortest_piece(const hd_run *run)
{
    return fmin(run->log->duration / PIECES_MAX, run->sample_max / HD_COLLISIONS_PER_SAMPLE);
}

hd_norm hd_run_norm(const hd_run *run, bool measured)
{
    const int positive = (4 * run->scene.disks - hd_scene_zero_exponents(&run->scene)) / 2;
    const bool many = run->carried >= HALVES_MANY && run->carried <= positive;
    const bool aligned = run->cost.orthonormalisations >= HALVES_ALIGNED;
    return !many || !aligned || measured || hd_run_is_windowing(run) ? HD_NORM_FULL : HD_NORM_DQ;
}

/** What is lost of isotropy decays [T19]; should it ever not, the frame gets it back. */
static hd_status keep_isotropic(hd_run *run)
{
    if (hd_conjugate_isotropy(run->conjugate, run->frame) > ISOTROPY)
        HD_TRY(hd_conjugate_start(run->frame));
    if (HD_VERIFIES) hd_verify_isotropy(run->frame);
    return HD_OK;
}

/** Carries the frame from t_begin to t_end of the log and orthonormalises it. */
static hd_status frame_piece(hd_run *run, double t_begin, double t_end, hd_ortho_limits limits)
{
    const double start = hd_clock_now(), length = t_end - t_begin;
    HD_TRY(hd_run_replay(run, t_begin, t_end));
    const double replayed = hd_clock_now();
    limits.condition = hd_interval_piece_max(&run->interval, length, run->log->duration);
    hd_status status = length > shortest_piece(run)
                           ? hd_ortho_step(run->ortho, run->frame, limits)
                           : hd_ortho_step_stable(run->ortho, run->frame, HD_CONDITION_STABLE);
    if (run->conjugate && status == HD_OK) status = keep_isotropic(run);
    run->cost.replay += replayed - start;
    run->cost.ortho += hd_clock_now() - replayed;
    if (HD_VERIFIES && status == HD_OK) hd_verify_ortho(run->ortho, run->frame);
    return status;
}

void hd_run_save_accuracy(hd_run *run)
{
    const bool averaging = run->spectrum && run->schedule.stage == HD_AVERAGING;
    const double used = HD_ENLARGED * run->rounding.sum / run->scene.accuracy;
    run->interval.saved = averaging ? hd_run_averaged(run) - used : INFINITY;
}

/** What an accepted orthonormalisation says about spectrum, interval and cost. */
static void piece_accepted(hd_run *run, double length)
{
    const hd_norm norm = hd_ortho_norm(run->ortho); /* of a stable step always the whole one */
    const double start = hd_clock_now();
    const double *stretch = hd_ortho_log_stretch(run->ortho);
    const double condition = hd_ortho_condition(run->ortho);
    double most = 0.0;
    for (int col = 0; col < run->carried; col++) most = fmax(most, fabs(stretch[col]));
    run->interval.norm = norm;
    if (length > 0) hd_interval_learn(&run->interval, length, condition, most);
    if (run->conjugate) stretch = hd_conjugate_stretch(run->conjugate, stretch);
    if (run->schedule.stage == HD_AVERAGING) hd_spectrum_add(run->spectrum, stretch, length);
    hd_cost *cost = &run->cost;
    if (length > 0) cost->interval = length;
    cost->condition = condition;
    cost->defect = hd_ortho_defect(run->ortho);
    const double counted = hd_interval_counted(condition, norm);
    run->rounding.condition_max = fmax(run->rounding.condition_max, counted);
    run->rounding.sum += HD_ROUNDING * counted;
    cost->orthonormalisations++;
    cost->second_passes += hd_ortho_passes(run->ortho) > 1;
    hd_run_save_accuracy(run);
    cost->spectrum += hd_clock_now() - start;
}

bool hd_run_is_observing(const hd_run *run)
{
    return run->observer.modes && run->observe & HD_OBSERVE_OF_MODES &&
           run->schedule.stage == HD_AVERAGING;
}

bool hd_run_is_localizing(const hd_run *run)
{
    return run->shape && run->observe & HD_OBSERVE_LOCALIZATION &&
           run->schedule.stage == HD_AVERAGING;
}

bool hd_run_is_windowing(const hd_run *run)
{
    return run->windows.covariant && (run->observe & HD_OBSERVE_COVARIANT) &&
           run->schedule.stage == HD_AVERAGING;
}

/** What the next intervals are expected to be: a report that needs all vectors ends one. */
static double expected_interval(const hd_run *run)
{
    const bool at_reports = run->observe & (HD_OBSERVE_AT_REPORTS | HD_OBSERVE_FIELDS);
    const double sample = hd_run_sample_longest(run);
    const double most = at_reports ? fmin(sample, run->schedule.report_interval) : sample;
    return fmin(hd_interval_longest(&run->interval).length, most);
}

/** Before its first orthonormalisation. */
static hd_status window_starts(hd_run *run)
{
    if (!hd_run_is_windowing(run)) return HD_OK;
    if (run->conjugate && run->windows.due) HD_TRY(hd_conjugate_start(run->frame));
    return hd_windows_start(&run->windows, run->frame, hd_run_time(run) - run->log->duration,
                            expected_interval(run));
}

static hd_status window_adds(hd_run *run, double begin, double end)
{
    if (!hd_run_is_windowing(run)) return HD_OK;
    return hd_windows_add(&run->windows, run->ortho, run->frame, run->log, begin, end);
}

static hd_status window_ends(hd_run *run)
{
    if (!hd_run_is_windowing(run)) return HD_OK;
    return hd_windows_end(&run->windows, run->frame, run->advance.trajectory);
}

/** The frame is orthonormal in the norm of dq: in the whole norm, too, at the same time. */
static hd_status complete(hd_run *run)
{
    const double start = hd_clock_now();
    const hd_ortho_limits limits = {.condition = CONDITION_COMPLETE, .defect = DEFECT_MEASURED};
    if (run->whole) return HD_OK;
    HD_TRY(hd_ortho_step(run->ortho, run->frame, limits));
    run->cost.ortho += hd_clock_now() - start;
    run->whole = true;
    piece_accepted(run, 0.0);
    return HD_OK;
}

/** Loss of orthogonality that an interval may leave. */
static double defect_allowed(const hd_run *run, double duration, hd_norm norm)
{
    const bool windowing = hd_run_is_windowing(run);
    const bool observing = hd_run_is_observing(run) || hd_run_is_localizing(run);
    const bool looked_at = norm == HD_NORM_FULL && (windowing || observing);
    if (windowing && run->conjugate) return DEFECT_COUPLED;
    return fmin(looked_at ? DEFECT_MEASURED : DEFECT_LOOSE,
                sqrt(DEFECT_SHARE * run->scene.accuracy * duration));
}

static hd_status factorise_log(hd_run *run, bool measured)
{
    const double duration = run->log->duration;
    double begin = 0.0, end = duration;
    HD_TRY(window_starts(run));
    while (begin < duration) {
        const double piece = end - begin;
        const hd_norm norm = hd_run_norm(run, measured && end >= duration);
        run->interval.norm = norm;
        const hd_ortho_limits limits = {.defect = defect_allowed(run, duration, norm),
                                        .norm = norm};
        const hd_status status = frame_piece(run, begin, end, limits);
        if (status != HD_OK && status != HD_ILL_CONDITIONED) return status;
        if (status == HD_OK) {
            piece_accepted(run, piece);
            run->whole = hd_ortho_norm(run->ortho) == HD_NORM_FULL;
            HD_TRY(window_adds(run, begin, end));
            begin = end;
            end = duration - end < 1.5 * piece ? duration
                                               : end + piece; /* no crumb of rounding is left */
            continue;
        }
        if (piece <= duration / PIECES_LAST) return HD_ILL_CONDITIONED;
        run->cost.repairs += piece >= duration;
        run->cost.limit = HD_LIMIT_REPAIR;
        hd_interval_failed(&run->interval, piece);
        hd_frame_rewind(run->frame);
        end = begin + 0.5 * piece;
    }
    hd_event_log_clear(run->log);
    run->interval_end = run->advance.plan.end = hd_run_time(run);
    return window_ends(run);
}

hd_status hd_run_factorise(hd_run *run, bool measured)
{
    if (run->log->duration > 0) return factorise_log(run, measured);
    return measured ? complete(run) : HD_OK;
}
