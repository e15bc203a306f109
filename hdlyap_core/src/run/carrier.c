/** Record -> frame -> orthonormal frame, spectrum, and limit of the next interval. An interval that
 * turned out too long is undone and replayed in pieces. If even the shortest piece is too much it
 * holds a grazing collision, and is factored by repeated passes. */
#include "run/carrier.h"

#include <float.h>
#include <math.h>

#include "tangent/conjugate.h"
#include "tangent/frame.h"
#include "tangent/ortho.h"
#include "averages/spectrum.h"
#include "base/arrays.h"
#include "base/blas.h"
#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "hdlyap/blas.h"
#include "observe/observables.h"
#include "run/advance.h"
#include "scene/scene.h"
#include "tangent/threads.h"
#include "tangent/verify.h"

/** Loss of orthogonality that is allowed where vectors are not measured: logarithms telescope [T5],
 * and only its square enters a mean. */
static const double DEFECT_LOOSE = 1e-4;
/** Loss of orthogonality that is allowed where vectors are measured. */
static const double DEFECT_MEASURED = 1e-6;
/** Loss of orthogonality that is allowed where Y needs both ends of an interval to be orthonormal
 * to rounding [T18]: it takes a second pass. */
static const double DEFECT_COUPLED = 1e-12;
/** Largest loss of orthogonality elsewhere: its square may be this part of the interval's share of
 * the accuracy. */
static const double DEFECT_SHARE = 0.1;
/** An interval whose condition is too large is carried in up to PIECES_MAX pieces, because more
 * would cost more than they save [T6]; one that repeated passes cannot factor in PIECES_LAST pieces
 * is given up. */
enum { PIECES_MAX = 8, PIECES_LAST = 512 };
/** The norm of dq is faster from HALVES_MANY vectors on. After HALVES_ALIGNED orthonormalisations
 * the dq halves of a random start are as independent as the vectors. */
enum { HALVES_MANY = 64, HALVES_ALIGNED = 8 };
/** The frame is made isotropic again if its loss of isotropy exceeds this, which is the loss of
 * orthogonality that measured vectors may have [T18]. */
static const double ISOTROPY = 1e-6;
/** A random frame may have this loss of orthogonality; one pass leaves less. */
static const double ORTHONORMAL = 1e-10;
/** Most collisions of each particle between two orthonormalisations, at any accuracy and density.
 */
static const double COLLISIONS_MOST = 60.0;
/** How many positive exponents nearest to zero a target calls `smallest`. */
enum { SMALLEST_EXPONENTS = 8 };
/** Value in a checkpoint that stands for a half that is NaN. */
static const double NO_HALF = -2.0;

/* ---- creation ------------------------------------------------------------------------------ */

static int rows_of(const hd_scene_def *scene)
{
    return 2 * hd_scene_coordinates(scene) * scene->number;
}

static hd_status agree(const hd_carrier *c, hd_status status)
{
    return hd_communicator_agree(c->communicator, status);
}

static hd_status create_random(hd_carrier *c, const hd_scene_def *scene)
{
    return hd_frame_create_shared(&c->frame, scene, c->carried, scene->seed, c->threads,
                                  c->communicator);
}

/** Creates a random orthonormal frame; by repeated passes if its vectors are nearly dependent. */
static hd_status create_frame(hd_carrier *c, const hd_scene_def *scene)
{
    const hd_ortho_limits once = {1e7, ORTHONORMAL, HD_NORM_FULL};
    HD_TRY(create_random(c, scene));
    if (c->carried < c->vectors) return hd_conjugate_start(c->frame);
    if (hd_ortho_step(c->ortho, c->frame, once) == HD_OK) return HD_OK;
    hd_frame_free(c->frame);
    c->frame = NULL;
    HD_TRY(create_random(c, scene));
    return hd_ortho_step_stable(c->ortho, c->frame, 1.0 / DBL_EPSILON);
}

int hd_carrier_threads_most(const hd_scene_def *scene, const hd_communicator *communicator)
{
    const int wanted = scene->threads, cores = hd_blas_query().cores;
    const int most = hd_threads_most(wanted, rows_of(scene), hd_scene_carried(scene));
    if (!communicator || wanted > 0) return most;
    const int own = cores / communicator->beside; /* ranks share the cores of their machine */
    return own < 1 ? 1 : own < most ? own : most;
}

static hd_status prepare_threads(hd_carrier *c, const hd_scene_def *scene)
{
    const int most = hd_carrier_threads_most(scene, c->communicator);
    if (most > 1) HD_TRY(hd_blas_room(most)); /* one thread has had its buffer since the start */
    const int granted = c->threads = hd_blas_threads_granted(most);
    hd_blas_use_threads(granted);
    if (scene->threads == 0 && !c->communicator)
        HD_TRY(hd_threads_choose(&c->threads, c->ortho, scene, c->carried, granted));
    c->threads_denied = c->threads == granted ? most - granted : 0;
    hd_blas_use_threads(c->threads);
    return HD_OK;
}

/** Number of vectors that are completed by their partners at once: those of this rank, if an
 * observable needs partners. */
static int completed(const hd_scene_def *scene, int here)
{
    return hd_observables_asked(scene, HD_NEEDS_VECTORS) ? here : 0;
}

static hd_status prepare_conjugate(hd_carrier *c, const hd_scene_def *scene)
{
    const int here = c->communicator ? hd_frame_stride(c->frame) : c->carried;
    if (c->carried == c->vectors) return HD_OK;
    return hd_conjugate_create(&c->conjugate, hd_frame_rows(c->frame), c->of->coordinates,
                               completed(scene, here));
}

/** Keeps the halves of a frame that is orthonormal in the full norm, because the next frame may be
 * so in the norm of dq alone. */
static hd_status keep_dq_dp(hd_carrier *c)
{
    const hd_shared shared = {2, (size_t)c->vectors, (size_t)hd_frame_stride(c->frame),
                              (size_t)c->carried, 0};
    const hd_columns own = hd_frame_columns(c->frame);
    double *cos_theta = c->dq_dp, *ratio = c->dq_dp + c->vectors;
    if (own.count > 0) hd_frame_dq_dp(c->frame, cos_theta + own.first, ratio + own.first);
    HD_TRY(hd_communicator_share(c->communicator, c->dq_dp, shared));
    if (c->conjugate) hd_conjugate_dq_dp(cos_theta, ratio, c->carried);
    for (int k = 0; k < 2 * c->vectors; k++)
        if (isnan(c->dq_dp[k])) c->dq_dp[k] = NO_HALF;
    return HD_OK;
}

static hd_status prepare(hd_carrier *c, const hd_scene_def *scene, double block)
{
    const int rows = rows_of(scene), n = c->vectors;
    HD_TRY(agree(c, hd_record_create(&c->record, c->of->entry)));
    HD_TRY(hd_ortho_create_shared(&c->ortho, rows, 2 * c->of->coordinates, c->carried,
                                  c->communicator));
    HD_TRY(agree(c, prepare_threads(c, scene)));
    HD_TRY(agree(
        c, hd_spectrum_create(&c->spectrum, rows, n, c->symplectic ? c->positive : rows, block)));
    if (c->diverges) HD_TRY(agree(c, hd_blocks_create(&c->divergence, 1, block)));
    c->dq_dp = hd_memory_alloc(2 * (size_t)n, sizeof *c->dq_dp);
    HD_TRY(agree(c, c->dq_dp ? HD_OK : HD_NO_MEMORY));
    HD_TRY(create_frame(c, scene));
    HD_TRY(agree(c, prepare_conjugate(c, scene)));
    return keep_dq_dp(c);
}

hd_status hd_carrier_create(hd_carrier *c, const hd_scene_def *scene, double collision,
                            double block, hd_communicator *communicator, hd_cost *cost)
{
    const double limit = scene->interval > 0 ? scene->interval : INFINITY;
    *c = (hd_carrier){.communicator = communicator,
                      .of = hd_dynamics_of(scene),
                      .symplectic = hd_scene_symplectic(scene),
                      .diverges = hd_scene_diverges(scene),
                      .dispersing = hd_dynamics_of(scene)->dispersing &&
                                    hd_scene_symplectic(scene) == hd_dynamics_of(scene)->symplectic,
                      .particles = scene->number,
                      .vectors = hd_scene_vectors(scene),
                      .carried = hd_scene_carried(scene),
                      .positive = hd_scene_positive_exponents(scene),
                      .zero = hd_scene_zero_exponents(scene),
                      .threads = 1,
                      .accuracy = scene->accuracy,
                      .collision = collision,
                      .interval = hd_interval_first(2.0 * collision, limit, scene->accuracy),
                      .cost = cost};
    if (c->vectors == 0) return HD_OK;
    c->whole = true;
    return prepare(c, scene, block);
}

void hd_carrier_free(hd_carrier *c)
{
    hd_record_free(c->record);
    hd_frame_free(c->frame);
    hd_ortho_free(c->ortho);
    hd_conjugate_free(c->conjugate);
    hd_spectrum_free(c->spectrum);
    hd_blocks_clear(&c->divergence);
    hd_memory_free(c->dq_dp);
}

double hd_carrier_bytes(const hd_scene_def *scene, int threads, int ranks)
{
    const double n = hd_scene_vectors(scene), carried = hd_scene_carried(scene),
                 here = ceil(carried / ranks);
    if (n <= 0) return 0.0;
    const double longest = COLLISIONS_MOST * hd_scene_collision_time(scene);
    const double record = hd_record_bytes_of(
        scene, fmin(hd_advance_most(scene), longest * hd_dynamics_of(scene)->record_rate(scene)));
    const double frame = hd_frame_bytes(hd_dynamics_of(scene), rows_of(scene), here, threads);
    const double ortho = hd_ortho_bytes(rows_of(scene), carried, ranks);
    const double conjugate = carried < n
                                 ? hd_conjugate_bytes(rows_of(scene), completed(scene, (int)here))
                                 : 0.0;
    const double told = hd_scene_diverges(scene) ? hd_blocks_bytes(1.0) : 0.0;
    return record + frame + ortho + conjugate + hd_spectrum_bytes(n) + told +
           2.0 * sizeof(double) * n;
}

/* ---- from one orthonormalisation to the next ------------------------------------------------ */

/** Carries the frame from t_begin to t_end of the record. */
static hd_status replay(hd_carrier *c, double t_begin, double t_end)
{
    hd_symplectic before;
    if (HD_VERIFIES) before = hd_verify_sample(c->frame);
    HD_TRY(hd_frame_replay(c->frame, c->record, t_begin, t_end));
    if (HD_VERIFIES) hd_verify_symplectic(c->frame, &before, (double)hd_record_count(c->record));
    return HD_OK;
}

/** Length of a piece of the record that is factored by repeated passes: one collision of each
 * particle, or an eighth of an interval that is only a few collisions long. */
static double shortest_piece(const hd_carrier *c)
{
    return fmin(hd_record_duration(c->record) / PIECES_MAX, c->collision);
}

/** Whether the norm of dq is the faster one. */
static bool has_many(const hd_carrier *c)
{
    return c->dispersing && c->carried >= HALVES_MANY && c->carried <= c->positive;
}

bool hd_carrier_is_usual(const hd_carrier *c)
{
    return c->cost->orthonormalisations >= (has_many(c) ? HALVES_ALIGNED : 1);
}

hd_norm hd_carrier_norm(const hd_carrier *c, bool whole)
{
    return has_many(c) && hd_carrier_is_usual(c) && !whole ? HD_NORM_DQ : HD_NORM_FULL;
}

double hd_carrier_longest(const hd_scene_def *scene)
{
    const double most = COLLISIONS_MOST * hd_scene_collision_time(scene);
    return scene->interval > 0 ? fmin(most, scene->interval) : most;
}

static hd_status follow(hd_carrier *c, const hd_carrying *how, hd_interval_event leg)
{
    if (!how->windows) return HD_OK;
    const double start = hd_clock_now();
    leg.frame = c->frame;
    leg.ortho = c->ortho;
    leg.record = c->record;
    leg.trajectory = how->trajectory;
    leg.expected = how->expected;
    const hd_status status = hd_windows_follow(how->windows, &leg);
    c->cost->following += hd_clock_now() - start;
    return status;
}

/** Makes the frame isotropic again if it has lost too much. Usually a loss decays by itself [T18].
 * The step's triangle is then no longer that of the frame. */
static hd_status keep_isotropic(hd_carrier *c, const hd_carrying *how)
{
    if (!(hd_conjugate_isotropy(c->conjugate, c->frame) <= ISOTROPY)) {
        HD_TRY(hd_conjugate_start(c->frame));
        HD_TRY(follow(c, how, (hd_interval_event){.at = HD_INTERVAL_LOST}));
    }
    if (HD_VERIFIES) hd_verify_isotropy(c->frame);
    return HD_OK;
}

/** Carries the frame from t_begin to t_end of the record and orthonormalises it. */
static hd_status frame_piece(hd_carrier *c, const hd_carrying *how, double t_begin, double t_end,
                             hd_ortho_limits limits)
{
    const double start = hd_clock_now(), length = t_end - t_begin;
    HD_TRY(replay(c, t_begin, t_end));
    const double replayed = hd_clock_now();
    limits.condition = hd_interval_piece_max(&c->interval, length, hd_record_duration(c->record));
    hd_status status = length > shortest_piece(c)
                           ? hd_ortho_step(c->ortho, c->frame, limits)
                           : hd_ortho_step_stable(c->ortho, c->frame, HD_CONDITION_STABLE);
    if (c->conjugate && status == HD_OK) status = keep_isotropic(c, how);
    c->cost->replay += replayed - start;
    c->cost->ortho += hd_clock_now() - replayed;
    if (HD_VERIFIES && status == HD_OK) hd_verify_ortho(c->ortho, c->frame);
    return status;
}

double hd_carrier_divergence(const hd_carrier *c)
{
    const double time = c->spectrum ? hd_spectrum_time(c->spectrum) : 0.0;
    return c->diverges && time > 0 ? (c->diverged[1] - c->diverged[0]) / time : NAN;
}

double hd_carrier_divergence_error(const hd_carrier *c)
{
    return c->diverges && c->spectrum
               ? hd_blocks_error(&c->divergence, &(hd_part){.factor = 1.0}, 1)
               : -1.0;
}

double hd_carrier_averaged(const hd_carrier *c)
{
    return hd_spectrum_time(c->spectrum) + hd_spectrum_sample_time(c->spectrum);
}

void hd_carrier_save_accuracy(hd_carrier *c, bool averaging)
{
    const double used = HD_ENLARGED * c->rounding.sum / c->accuracy;
    c->interval.saved = averaging && c->spectrum ? hd_carrier_averaged(c) - used : INFINITY;
}

/** Passes the results of an accepted orthonormalisation on to spectrum, interval and cost. */
static void piece_accepted(hd_carrier *c, double length, bool averaging)
{
    const hd_norm norm = hd_ortho_norm(c->ortho); /* always the full norm after repeated passes */
    const double start = hd_clock_now();
    const double *stretch = hd_ortho_log_stretch(c->ortho);
    const double condition = hd_ortho_condition(c->ortho);
    double most = 0.0;
    for (int col = 0; col < c->carried; col++) most = fmax(most, fabs(stretch[col]));
    c->interval.norm = norm;
    if (length > 0) hd_interval_learn(&c->interval, length, condition, most);
    if (c->conjugate) stretch = hd_conjugate_stretch(c->conjugate, stretch);
    if (averaging) hd_spectrum_add(c->spectrum, stretch, length);
    hd_cost *cost = c->cost;
    if (length > 0) cost->interval = length;
    cost->condition = condition;
    cost->defect = hd_ortho_defect(c->ortho);
    const double counted = hd_interval_counted(condition, norm);
    c->rounding.condition_max = fmax(c->rounding.condition_max, counted);
    c->rounding.sum += HD_ROUNDING * counted;
    cost->orthonormalisations++;
    cost->second_passes += hd_ortho_passes(c->ortho) > 1;
    hd_carrier_save_accuracy(c, averaging);
    cost->spectrum += hd_clock_now() - start;
}

/** Prepares the first orthonormalisation at the end of an interval. */
static hd_status begin_interval(hd_carrier *c, const hd_carrying *how)
{
    if (c->conjugate && hd_windows_begin(how->windows)) HD_TRY(hd_conjugate_start(c->frame));
    return follow(c, how, (hd_interval_event){.at = HD_INTERVAL_BEGINS});
}

/** Makes a frame that is orthonormal in the norm of dq orthonormal in the full norm, without moving
 * on in time. */
static hd_status complete_norm(hd_carrier *c, bool averaging)
{
    const double start = hd_clock_now();
    const hd_ortho_limits limits = {.condition = HD_CONDITION_MAX, .defect = DEFECT_MEASURED};
    if (c->whole) return HD_OK;
    HD_TRY(hd_ortho_step(c->ortho, c->frame, limits));
    c->cost->ortho += hd_clock_now() - start;
    c->whole = true;
    piece_accepted(c, 0.0, averaging);
    return HD_OK;
}

/** The loss of orthogonality that an interval may leave. */
static double defect_allowed(const hd_carrier *c, const hd_carrying *how, hd_norm norm)
{
    const bool looked_at = norm == HD_NORM_FULL && how->observed;
    if (how->whole && c->conjugate) return DEFECT_COUPLED;
    return fmin(looked_at ? DEFECT_MEASURED : DEFECT_LOOSE,
                sqrt(DEFECT_SHARE * c->accuracy * hd_record_duration(c->record)));
}

/** Carries the frame through a part of the record, if conditioning allows it. */
static hd_status carry_piece(hd_carrier *c, const hd_carrying *how, double t_begin, double t_end)
{
    const bool whole = how->measured && t_end >= hd_record_duration(c->record);
    const hd_norm norm = whole ? HD_NORM_FULL : hd_carrier_norm(c, how->whole);
    c->interval.norm = norm;
    return frame_piece(c, how, t_begin, t_end,
                       (hd_ortho_limits){.defect = defect_allowed(c, how, norm), .norm = norm});
}

/** Passes on the results of a part of the record that the frame was carried through. */
static hd_status take_piece(hd_carrier *c, const hd_carrying *how, double t_begin, double t_end)
{
    piece_accepted(c, t_end - t_begin, how->averaging);
    c->whole = hd_ortho_norm(c->ortho) == HD_NORM_FULL;
    return follow(c, how,
                  (hd_interval_event){.at = HD_INTERVAL_PIECE, .from = t_begin, .to = t_end});
}

/** Why the frame cannot be carried even through a short piece: tangent vectors that are not numbers
 * are another fault than vectors that become too ill-conditioned. */
static hd_status why_not(hd_carrier *c, double t_begin, double t_end)
{
    hd_frame_rewind(c->frame);
    HD_TRY(hd_frame_replay(c->frame, c->record, t_begin, t_end));
    const size_t size = (size_t)hd_frame_rows(c->frame) * (size_t)hd_frame_stride(c->frame);
    const bool finite = hd_all_finite(hd_frame_read(c->frame), size);
    HD_TRY(agree(c, finite ? HD_OK : HD_NOT_FINITE));
    return HD_ILL_CONDITIONED;
}

static hd_status carry_through(hd_carrier *c, const hd_carrying *how)
{
    const double duration = hd_record_duration(c->record);
    double begin = 0.0, end = duration;
    HD_TRY(begin_interval(c, how));
    while (begin < duration) {
        const double piece = end - begin;
        const hd_status status = carry_piece(c, how, begin, end);
        if (status != HD_OK && status != HD_ILL_CONDITIONED) return status;
        if (status == HD_OK) {
            HD_TRY(take_piece(c, how, begin, end));
            begin = end;
            end = duration - end < 1.5 * piece ? duration
                                               : end + piece; /* rounding leaves no short piece */
            continue;
        }
        if (piece <= duration / PIECES_LAST) return why_not(c, begin, end);
        c->cost->repairs += piece >= duration;
        c->cost->limit = HD_LIMIT_REPAIR;
        hd_interval_failed(&c->interval, piece);
        hd_frame_rewind(c->frame);
        end = begin + 0.5 * piece;
    }
    hd_record_clear(c->record);
    return follow(c, how, (hd_interval_event){.at = HD_INTERVAL_ENDS});
}

hd_status hd_carrier_orthonormalise(hd_carrier *c, hd_carrying how)
{
    if (hd_record_duration(c->record) > 0) return carry_through(c, &how);
    return how.measured ? complete_norm(c, how.averaging) : HD_OK;
}

hd_status hd_carrier_sample(hd_carrier *c, bool averaging, double diverged)
{
    HD_TRY(keep_dq_dp(c));
    if (!averaging) return HD_OK;
    const double since = diverged - c->diverged[1];
    if (c->diverges) hd_blocks_add(&c->divergence, &since, hd_spectrum_sample_time(c->spectrum));
    c->diverged[1] = diverged;
    hd_spectrum_sample(c->spectrum);
    return HD_OK;
}

void hd_carrier_begin(hd_carrier *c, bool averaging, double age, double diverged)
{
    if (averaging) c->diverged[0] = c->diverged[1] = diverged;
    if (averaging && c->spectrum) hd_spectrum_begin(c->spectrum, age);
    if (averaging && c->spectrum && c->diverges) hd_blocks_restart(&c->divergence);
    if (averaging) c->rounding.sum = HD_ROUNDING * c->rounding.condition_max;
    hd_carrier_save_accuracy(c, averaging);
}

/* ---- what can be read ---------------------------------------------------------------------- */

hd_columns hd_carrier_vectors(const hd_carrier *c)
{
    const hd_columns none = {.count = 0}, carried = c->frame ? hd_frame_columns(c->frame) : none;
    if (!c->conjugate) return carried;
    return carried.count <= hd_conjugate_most(c->conjugate)
               ? hd_conjugate_complete(c->conjugate, carried)
               : none;
}

void hd_carrier_dq_dp(const hd_carrier *c, double *cos_theta, double *dp_dq_ratio)
{
    for (int col = 0; col < c->vectors; col++) {
        const double cosine = c->dq_dp[col], ratio = c->dq_dp[c->vectors + col];
        cos_theta[col] = cosine == NO_HALF ? NAN : cosine;
        dp_dq_ratio[col] = ratio == NO_HALF ? NAN : ratio;
    }
}

/** Number of vectors with positive exponents: by theory, or by sign. */
static int positive_of(const hd_carrier *c)
{
    if (c->symplectic || !c->spectrum) return c->vectors < c->positive ? c->vectors : c->positive;
    return hd_spectrum_signs(c->spectrum, c->zero).positive;
}

double hd_carrier_smallest_error(const hd_carrier *c)
{
    const int end = positive_of(c);
    const int begin = end > SMALLEST_EXPONENTS ? end - SMALLEST_EXPONENTS : 0;
    return c->spectrum ? hd_spectrum_largest_error(c->spectrum, begin, end) : INFINITY;
}

double hd_carrier_error_bound(const hd_carrier *c)
{
    const double averaged = c->spectrum ? hd_carrier_averaged(c) : 0.0, defect = c->cost->defect;
    const double rounded = HD_ENLARGED * c->rounding.sum + defect * defect;
    return averaged > 0 ? rounded / averaged : NAN;
}
