/** Triangles of the forward pass -> covariant vectors of a window -> angles, weights and orders
 * [T16] [T17].
 *
 * The history (history.h) reaches from the window's start to the transient's end. On the way back C
 * belongs to the end of the next interval: if vectors were kept there they are measured; then C is
 * carried to the interval's start. */
#include "covariant/covariant_state.h"

#include <cblas.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "covariant/backward.h"
#include "covariant/window_room.h"
#include "dynamics/dynamics.h"
#include "scene/scene.h"

/** Two times that differ by less than this part of covariant_sampling are the same. */
static const double CLOSE = 1e-6;

enum { WEIGHTS = 3 }; /* of dq halves, of dp halves, of the frame */

static hd_modes *weights_of(const hd_covariant *c, int k)
{
    return k < 2 ? c->half[k] : c->of_frame;
}

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status allocate_arrays(hd_covariant *c)
{
    const size_t n = (size_t)c->vectors, rows = (size_t)c->rows;
    const size_t centres = 2 * (size_t)(c->counting ? c->vectors : c->centre);
    const size_t half = c->carried < c->vectors ? (size_t)c->carried : 0;
    const struct {
        double **array;
        size_t size;
    } wanted[] = {{&c->factor, n * (n > centres ? n : centres)},
                  {&c->coupling, half * half},
                  {&c->angle, n},
                  {&c->apart, n},
                  {&c->edge, n},
                  {&c->turned, n},
                  {&c->frame, rows * n},
                  {&c->q, rows / 2},
                  {&c->p, rows / 2}};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
        if (wanted[k].size > 0 &&
            !(*wanted[k].array = hd_memory_alloc(wanted[k].size, sizeof(double))))
            return HD_NO_MEMORY;
    return HD_OK;
}

/** Allocates what compares the spaces of both starts, and the centre with the null space. */
static hd_status allocate_spaces(hd_covariant *c)
{
    const int stable = c->vectors - c->unstable - c->centre;
    const int widest = c->counting ? c->vectors : stable > c->centre ? stable : c->centre;
    if (c->centre_most == 0) return HD_OK;
    HD_TRY(hd_angles_create(&c->spaces, c->vectors, widest));
    HD_TRY(hd_angles_create(&c->null, c->rows, c->centre_most));
    c->null_columns = hd_memory_alloc(
        (2 * (size_t)c->centre_most + HD_NULL_SPARE) * (size_t)c->rows, sizeof(double));
    return c->null_columns ? HD_OK : HD_NO_MEMORY;
}

static hd_status allocate(hd_covariant *c)
{
    HD_TRY(allocate_arrays(c));
    HD_TRY(allocate_spaces(c));
    HD_TRY(hd_backward_pair_create(&c->starts, c->vectors, c->carried < c->vectors));
    hd_modes **weights[WEIGHTS] = {&c->half[0], &c->half[1], &c->of_frame};
    for (int k = 0; k < WEIGHTS && hd_scene_dimension(&c->scene) > 0; k++)
        HD_TRY(hd_modes_create(weights[k], &c->scene, c->vectors, c->threads));
    HD_TRY(hd_spectrum_create(&c->spectrum, c->rows, c->vectors,
                              c->counting ? c->rows : hd_scene_positive_exponents(&c->scene),
                              hd_scene_sound_crossing(&c->scene)));
    HD_TRY(
        hd_splitting_create(&c->splitting, c->vectors, c->counting ? 0 : c->unstable, c->centre));
    HD_TRY(hd_doubling_create(&c->grown, (hd_doubling_def){.vectors = c->vectors}));
    return hd_localization_create(&c->shape, c->scene.number, hd_scene_coordinates(&c->scene),
                                  c->vectors, c->threads);
}

hd_status hd_covariant_create(hd_covariant **out, const hd_scene_def *def,
                              const hd_spectrum *spectrum, int threads)
{
    const int positive = hd_scene_positive_exponents(def), zero = hd_scene_zero_exponents(def);
    *out = NULL;
    hd_covariant *c = hd_memory_alloc(1, sizeof *c);
    if (!c) return HD_NO_MEMORY;
    c->scene = *def;
    c->threads = threads;
    c->rows = 2 * hd_scene_coordinates(def) * def->number;
    c->vectors = hd_scene_vectors(def);
    c->carried = hd_scene_carried(def);
    c->centre = c->centre_most = c->vectors >= positive + zero ? zero : 0;
    c->unstable = c->centre > 0 ? positive
                                : c->vectors; /* part of a centre is not measured as a space */
    if (!hd_scene_symplectic(def)) hd_covariant_prepare_counting(c, spectrum);
    const hd_status status = allocate(c);
    if (status == HD_OK)
        hd_covariant_clear(*out = c, 0.0);
    else
        hd_covariant_free(c);
    return status;
}

void hd_covariant_free(hd_covariant *c)
{
    if (!c) return;
    for (int k = 0; k < WEIGHTS; k++) hd_modes_free(weights_of(c, k));
    hd_backward_pair_free(c->starts);
    double *arrays[] = {c->factor, c->coupling, c->angle, c->apart, c->edge,
                        c->turned, c->frame,    c->q,     c->p,     c->null_columns};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) hd_memory_free(arrays[k]);
    hd_history_free(c->past);
    hd_spectrum_free(c->spectrum);
    hd_splitting_free(c->splitting);
    hd_doubling_free(c->grown);
    hd_localization_free(c->shape);
    hd_angles_free(c->spaces);
    hd_angles_free(c->null);
    hd_memory_free(c);
}

/* ---- forward ------------------------------------------------------------------------------- */

/** Begins the first window, or the first one after a window was lost. */
static void begin_window(hd_covariant *c, double time)
{
    c->way = FORWARD;
    c->window = c->now = time;
    if (c->windows == 0) c->ended = time;
    c->due = time + c->scene.covariant_sampling;
    hd_history_begin(c->past, time);
}

/** Makes room for intervals of this length, as far as covariant_memory allows it. */
static hd_status take_room(hd_covariant *c, double interval)
{
    const hd_history_def past = hd_window_that_fits(&c->scene, interval, c->threads);
    if (c->past && past.intervals <= c->intervals) return HD_OK;
    hd_history_free(c->past);
    c->past = NULL;
    c->intervals = past.intervals;
    c->bytes = hd_history_bytes(&past);
    return hd_history_create(&c->past, &past, &c->scene);
}

void hd_covariant_clear(hd_covariant *c, double now)
{
    hd_spectrum_clear(c->spectrum);
    hd_splitting_clear(c->splitting);
    hd_doubling_clear(c->grown);
    hd_localization_clear(c->shape);
    for (int k = 0; k < WEIGHTS; k++)
        if (weights_of(c, k)) hd_modes_clear(weights_of(c, k));
    memset(c->apart, 0, (size_t)c->vectors * sizeof *c->apart);
    memset(c->turned, 0, (size_t)c->vectors * sizeof *c->turned);
    c->windows = c->lost = 0;
    c->ended = now;
    c->null_apart = c->null_apart_most = -1.0;
    c->spaces_apart = (hd_covariant_mismatch){-1.0, -1.0, -1.0};
}

hd_status hd_covariant_begin(hd_covariant *c, double time, double interval)
{
    HD_TRY(take_room(c, interval));
    begin_window(c, time);
    return HD_OK;
}

/** The last interval of the window: it ends at the first sample at which the window is long enough.
 * The end of the history if there is none yet. */
static long window_last(const hd_covariant *c)
{
    const double asked = c->window + c->scene.covariant_window -
                         CLOSE * c->scene.covariant_sampling;
    long last = hd_history_first(c->past);
    while (last < hd_history_end(c->past) &&
           (!hd_history_has_snapshot(c->past, last) || hd_history_time(c->past, last) < asked))
        last++;
    return last;
}

/** Whether the history reaches a transient beyond the window's last sample. */
static bool is_complete(const hd_covariant *c)
{
    const long last = window_last(c);
    const double transient = c->scene.covariant_transient;
    const double least = transient - CLOSE * fmin(transient, c->scene.covariant_sampling);
    return last < hd_history_end(c->past) && c->now >= hd_history_time(c->past, last) + least;
}

static void begin_way_back(hd_covariant *c)
{
    if (c->counting) hd_covariant_count(c);
    hd_backward_pair_begin(c->starts, c->scene.seed, c->streams);
    c->streams += 2;
    c->at = hd_history_end(c->past) - 1;
    c->last = window_last(c);
    hd_doubling_break(c->grown);
    c->grown_time = 0.0; /* an earlier way back may not have ended */
    c->way = THROUGH_TRANSIENT;
}

/** Leaves this window out. The next one gets room for intervals like those of this one, as far as
 * covariant_memory allows it. */
static hd_status lose_window(hd_covariant *c, double time)
{
    const double lasted = time - c->window;
    const double count = (double)(hd_history_end(c->past) - hd_history_first(c->past) + 1);
    c->lost++;
    return hd_covariant_begin(c, time, lasted / count);
}

hd_status hd_covariant_add(hd_covariant *c, const hd_ortho *ortho, const hd_frame *frame,
                           const hd_record *record, double t_begin, double t_end)
{
    HD_ASSERT(!hd_covariant_is_going_back(c));
    c->now += t_end - t_begin;
    if (hd_history_is_full(c->past)) return lose_window(c, c->now);
    return hd_history_add(c->past, hd_ortho_factor(ortho), frame, record, t_begin, t_end);
}

bool hd_covariant_wants_state(const hd_covariant *c)
{
    return c->way == FORWARD && c->now >= c->due - CLOSE * c->scene.covariant_sampling;
}

double hd_covariant_due(const hd_covariant *c) { return c->due; }

hd_status hd_covariant_state(hd_covariant *c, hd_columns frame, const hd_trajectory *trajectory)
{
    const double sampling = c->scene.covariant_sampling;
    if (!hd_covariant_wants_state(c) || hd_history_end(c->past) == hd_history_first(c->past))
        return HD_OK;
    hd_trajectory_state(trajectory, c->q, c->p);
    HD_TRY(hd_history_snapshot(c->past, frame, c->q, c->p));
    /* in one step: adding one sampling time could be less than rounding of the time */
    c->due += sampling * (floor((c->now - c->due) / sampling + CLOSE) + 1.0);
    if (is_complete(c)) begin_way_back(c);
    return HD_OK;
}

/* ---- a look -------------------------------------------------------------------------------- */

static hd_columns vectors_of(const hd_covariant *c)
{
    return (hd_columns){c->frame, c->vectors, 0, c->vectors};
}

/** Raises *most to `now`, also if that is NaN, which fmax would drop. */
static void raise_to(double *most, double now)
{
    if (!(now <= *most) && !isnan(*most)) *most = now;
}

/** Largest angle between the covariant centre and the null space. */
static hd_status measure_null(hd_covariant *c)
{
    double *columns = c->null_columns;
    if (c->centre == 0) return HD_OK;
    for (int col = 0; col < c->centre; col++)
        cblas_dcopy(c->rows, c->frame + c->unstable + col, c->vectors,
                    columns + (size_t)col * (size_t)c->rows, 1);
    int known;
    HD_TRY(hd_null_vectors_of(&known, &c->scene, c->q, c->p,
                              columns + (size_t)c->centre * (size_t)c->rows));
    const hd_span covariant = {0, c->centre}, exact = {c->centre, known};
    if (known == 0) return HD_OK;
    HD_TRY(hd_angles_between(c->null, c->angle, columns, covariant, exact));
    c->null_apart = c->angle[known - 1];
    raise_to(&c->null_apart_most, c->null_apart);
    return HD_OK;
}

static hd_status measure_weights(hd_covariant *c, hd_modes *weights)
{
    if (!weights) return HD_OK;
    HD_TRY(hd_modes_measure(weights, vectors_of(c), c->q, c->p));
    hd_modes_add(weights);
    return HD_OK;
}

/** Exchanges dq and dp of all vectors. */
static void swap_halves(hd_covariant *c)
{
    const int n = c->vectors, half = hd_scene_coordinates(&c->scene);
    for (int row = 0; row < c->rows; row += 2 * half)
        cblas_dswap(half * n, c->frame + (size_t)row * (size_t)n, 1,
                    c->frame + (size_t)(row + half) * (size_t)n, 1);
}

/** Adds the vectors' growth from this sample to the one measured before, which is later in time. */
static void end_growth(hd_covariant *c)
{
    const double *grown = hd_backward_pair_growth(c->starts);
    if (c->grown_time == 0) return;
    hd_doubling_add(c->grown, grown, c->grown_time);
    hd_spectrum_add(c->spectrum, grown, c->grown_time);
    hd_spectrum_local_restart(c->spectrum);
    hd_spectrum_sample(c->spectrum);
    c->grown_time = 0.0;
}

/** Measures a sample: C belongs to the end of the interval, and V = Q C. */
static hd_status look(hd_covariant *c, long interval)
{
    const double *coefficients;
    HD_TRY(hd_backward_pair_look(c->starts, &coefficients));
    end_growth(c);
    HD_TRY(hd_splitting_add(c->splitting, coefficients));
    hd_history_vectors(c->past, c->frame, c->q, c->p, interval);
    HD_TRY(measure_weights(c, c->of_frame));
    cblas_dtrmm(CblasRowMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, c->rows,
                c->vectors, 1.0, coefficients, c->vectors, c->frame, c->vectors);
    hd_localization_measure(c->shape, vectors_of(c));
    hd_localization_add(c->shape);
    HD_TRY(measure_null(c));
    HD_TRY(measure_weights(c, c->half[0]));
    swap_halves(c);
    return measure_weights(c, c->half[1]);
}

/* ---- the way back -------------------------------------------------------------------------- */

/** Largest angle between the spaces that columns first .. first + count - 1 of both starts span. */
static hd_status spaces_apart(hd_covariant *c, double *angle, const double *const both[2],
                              int first, int count)
{
    const size_t n = (size_t)c->vectors, size = (size_t)count * n;
    const hd_span one = {0, count}, other = {count, count};
    for (int k = 0; k < 2; k++)
        memcpy(c->factor + (size_t)k * size, both[k] + (size_t)first * n, size * sizeof(double));
    HD_TRY(hd_angles_between(c->spaces, c->angle, c->factor, one, other));
    *angle = c->angle[count - 1];
    return HD_OK;
}

/** ln of the part of a vector that no faster one has: its growth in a window is that of the frame
 * and the change of this [T16]. */
static double own_part(const hd_covariant *c, const double *coefficients, int col)
{
    return log(fabs(coefficients[(size_t)col * (size_t)(c->vectors + 1)]));
}

/** Measures, at the window's end, how far the two starts agree; keeps the worst of all windows. */
static hd_status meet(hd_covariant *c)
{
    hd_covariant_mismatch *apart = &c->spaces_apart;
    const int stable = c->vectors - c->unstable - c->centre;
    const double *both[2];
    double now;
    HD_TRY(hd_backward_pair_meet(c->starts, both));
    (void)hd_backward_pair_growth(c->starts); /* drops the growth through the transient */
    apart->most = 0.0;
    for (int col = 0; col < c->vectors; col++) {
        const size_t first = (size_t)col * (size_t)c->vectors;
        c->apart[col] = hd_vectors_apart(both[0] + first, both[1] + first, col + 1);
        c->edge[col] = own_part(c, both[0], col);
        raise_to(&apart->most, c->apart[col]);
    }
    c->way = THROUGH_WINDOW;
    if (c->centre == 0) return HD_OK;
    HD_TRY(spaces_apart(c, &now, both, c->unstable, c->centre));
    raise_to(&apart->centre, now);
    if (stable == 0) return HD_OK;
    HD_TRY(spaces_apart(c, &now, both, c->unstable + c->centre, stable));
    raise_to(&apart->stable, now);
    return HD_OK;
}

/** The next window begins where this one ended. */
static hd_status end_window(hd_covariant *c)
{
    const double *first;
    HD_TRY(hd_backward_pair_look(c->starts, &first));
    end_growth(c);
    for (int col = 0; col < c->vectors; col++)
        c->turned[col] += own_part(c, first, col) - c->edge[col];
    c->window = c->ended = hd_history_time(c->past, c->last);
    hd_history_drop(c->past, c->window);
    c->windows++;
    c->way = FORWARD;
    return HD_OK;
}

hd_status hd_covariant_step(hd_covariant *c)
{
    HD_ASSERT(hd_covariant_is_going_back(c));
    if (c->way == THROUGH_TRANSIENT && c->at == c->last) HD_TRY(meet(c));
    const bool measuring = c->way == THROUGH_WINDOW;
    if (measuring && hd_history_has_snapshot(c->past, c->at)) HD_TRY(look(c, c->at));
    hd_history_factor(c->past, c->factor, c->coupling, c->at);
    HD_TRY(hd_backward_pair_step(c->starts, c->factor, c->coupling, !measuring));
    if (measuring) c->grown_time += hd_history_length(c->past, c->at);
    return --c->at < hd_history_first(c->past) ? end_window(c) : HD_OK;
}

/* ---- results ------------------------------------------------------------------------------- */

bool hd_covariant_is_going_back(const hd_covariant *c) { return c->way >= THROUGH_TRANSIENT; }
double hd_covariant_bytes(const hd_covariant *c) { return c->bytes; }

hd_covariant_results hd_covariant_read(const hd_covariant *c)
{
    hd_covariant_results r = {.vectors = c->vectors,
                              .unstable = c->centre > 0 ? c->unstable : 0,
                              .centre = c->centre,
                              .windows = c->windows,
                              .lost = c->lost,
                              .window_end = c->ended,
                              .spectrum = c->spectrum,
                              .turned = c->turned,
                              .splitting = hd_splitting_read(c->splitting),
                              .start_mismatch = c->spaces_apart,
                              .start_mismatch_each = c->apart,
                              .null = c->null_apart,
                              .null_most = c->null_apart_most,
                              .half = {c->half[0], c->half[1]},
                              .of_frame = c->of_frame,
                              .widths = hd_localization_widths(c->shape),
                              .cosines = hd_localization_cosines(c->shape)};
    r.times = hd_doubling_times(c->grown);
    for (int k = 0; k < HD_TIMES_MAX; k++) r.order[k] = hd_doubling_order(c->grown, k);
    return r;
}

double hd_covariant_std_error(const hd_covariant_results *results, int vector)
{
    const double error = hd_spectrum_std_error(results->spectrum, vector);
    return error < 0 ? error
                     : hypot(error, results->turned[vector] / hd_spectrum_time(results->spectrum));
}

/** Reads or writes the averages; the window under way is lost. */
void hd_covariant_archive(hd_covariant *c, hd_archive *archive)
{
    double *const numbers[] = {
        &c->ended,      &c->spaces_apart.most, &c->spaces_apart.centre, &c->spaces_apart.stable,
        &c->null_apart, &c->null_apart_most};
    hd_archive_long(archive, "covariant windows", &c->windows, 0, LONG_MAX / 2);
    hd_archive_long(archive, "covariant lost", &c->lost, 0, LONG_MAX / 2);
    hd_archive_bits(archive, "covariant starts", &c->streams);
    hd_archive_of_doubles(archive, "covariant numbers", sizeof numbers / sizeof *numbers);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        hd_archive_next_doubles(archive, numbers[k], 1);
    hd_archive_doubles(archive, "covariant apart", c->apart, (size_t)c->vectors);
    hd_archive_doubles(archive, "covariant turned", c->turned, (size_t)c->vectors);
    if (c->counting) hd_covariant_archive_counts(c, archive);
    hd_spectrum_archive(c->spectrum, archive);
    hd_splitting_archive(c->splitting, archive);
    hd_doubling_archive(c->grown, archive);
    hd_localization_archive(c->shape, archive);
    for (int k = 0; k < WEIGHTS; k++)
        if (weights_of(c, k)) hd_modes_archive(weights_of(c, k), archive);
}
