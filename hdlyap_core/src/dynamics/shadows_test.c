/** Archive -> trajectories that start nearby -> whether tangent maps carry vectors as these go.
 *
 * Only the row knows what its archive holds, so numbers of it are changed one by one: the change of
 * q and p that this makes is a tangent vector, unless there is none, and the later change is what
 * the maps must make of it. Both are central differences over d and d / 2; where these two do not
 * agree, as at a collision that only one of them has, nothing is said. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/trial.h"

enum {
    SHADOWS = 16, /* directions: a width of `carry` */
    TRIES = 160,  /* numbers of the archive that may be changed for them */
    SHORTER = 4   /* times that a time may be halved twice, if differences do not agree */
};
/** Entries that a record may have, and time [hd_trial.unit]. */
static const double ENTRIES = 2e5, TIME = 2.0;
/** The change, as a part of the root mean square of its array. */
static const double CHANGE = 1e-8;
/** Of the largest component: how close the two differences must be, and by how much the maps may
 * differ from the finer one, which is four times as exact. */
static const double AGREE = 1e-4, CLOSE = 1e-3;
/** A component that grows by more has jumped, as a position at the edge of a box. */
static const double JUMP = 1e4;

/* ---- numbers of an archive ----------------------------------------------------------------- */

/** A number in the bytes of an archive: where it is, and how much it is changed. */
typedef struct place {
    size_t offset;
    double change;
} place;

/** Root mean square of numbers; 1 if all are 0. */
static double typical(const char *bytes, size_t count)
{
    double square = 0.0, x;
    for (size_t k = 0; k < count; k++) {
        memcpy(&x, bytes + k * sizeof x, sizeof x);
        square += x * x / (double)count;
    }
    return square > 0 ? sqrt(square) : 1.0;
}

/** Finds the arrays of doubles (archive.h has the format) -> places of all numbers, or only their
 * count if `out` is NULL. */
static size_t find_places(place *out, const hd_image *image)
{
    enum { TYPE = 8, HEAD = HD_ARCHIVE_NAME + TYPE + 8 };
    size_t found = 0, at = 0;
    while (at + HEAD <= image->size) {
        const char *type = image->bytes + at + HD_ARCHIVE_NAME;
        int64_t count;
        memcpy(&count, type + TYPE, sizeof count);
        at += HEAD;
        const double change = *type == 'f' ? CHANGE * typical(image->bytes + at, (size_t)count) : 0;
        for (size_t k = 0; k < (size_t)count && *type == 'f'; k++, found++)
            if (out) out[found] = (place){at + k * sizeof(double), change};
        at += (size_t)count * (*type == 'S' ? 1 : sizeof(double));
    }
    return found;
}

/* ---- one direction ------------------------------------------------------------------------- */

/** Room for the directions, of which vector k is column k of blocks [rows][SHADOWS]. */
typedef struct room {
    double *before[2], *after[2]; /**< q and p of two shadows */
    double *begin[2], *end[2];    /**< coarse and fine differences */
    double *from, *to;            /**< blocks; NaN where nothing is said */
    hd_record *record;
} room;

enum { ARRAYS = 8 };
static double **array_of(room *r, int k)
{
    double **all[ARRAYS] = {&r->before[0], &r->before[1], &r->after[0], &r->after[1],
                            &r->begin[0],  &r->begin[1],  &r->end[0],   &r->end[1]};
    return all[k];
}

static void room_clear(room *r)
{
    for (int k = 0; k < ARRAYS; k++) hd_memory_free(*array_of(r, k));
    hd_memory_free(r->from);
    hd_memory_free(r->to);
    hd_record_free(r->record);
}

static hd_status room_create(room *r, const hd_trial *t)
{
    *r = (room){.from = hd_memory_alloc(t->rows * SHADOWS, sizeof(double)),
                .to = hd_memory_alloc(t->rows * SHADOWS, sizeof(double))};
    bool good = r->from && r->to;
    for (int k = 0; k < ARRAYS; k++)
        good = (*array_of(r, k) = hd_memory_alloc(t->rows, sizeof(double))) && good;
    return good ? HD_OK : HD_NO_MEMORY;
}

/** The component of a tangent vector that belongs to number k of q and p. */
static size_t component(const hd_trial *t, size_t k)
{
    const size_t half = t->rows / 2, of_one = (size_t)t->of->coordinates, j = k % half;
    return 2 * of_one * (j / of_one) + j % of_one + (k < half ? 0 : of_one);
}

/** A change of number k of q and p, times this, is the component: of q the root of the mass. */
static double weight(const hd_trial *t, size_t k)
{
    const size_t particle = k / (size_t)t->of->coordinates;
    return k < t->rows / 2 ? hd_scene_root_mass(&t->scene, (int)particle) : 1.0;
}

/** Fills differences number `fine` at both ends of the time. */
static hd_status differ(hd_trial *t, room *r, int fine, const hd_image *image, place at,
                        double time)
{
    const double change = fine ? 0.5 * at.change : at.change;
    double x;
    hd_status status = HD_OK;
    memcpy(&x, image->bytes + at.offset, sizeof x);
    for (int k = 0; k < 2 && status == HD_OK; k++) {
        const double moved = k == 0 ? x + change : x - change;
        memcpy(image->bytes + at.offset, &moved, sizeof moved);
        status = hd_trial_go(t, NULL, r->before[k], r->after[k], image, time);
    }
    memcpy(image->bytes + at.offset, &x, sizeof x);
    for (size_t k = 0; k < t->rows && status == HD_OK; k++) {
        const double per = weight(t, k) / (2.0 * change);
        r->begin[fine][component(t, k)] = (r->before[0][k] - r->before[1][k]) * per;
        r->end[fine][component(t, k)] = (r->after[0][k] - r->after[1][k]) * per;
    }
    return status;
}

/** Largest component that is not larger than `most`. */
static double largest(const double *x, size_t count, double most)
{
    double size = 0.0;
    for (size_t k = 0; k < count; k++)
        if (fabs(x[k]) <= most) size = fmax(size, fabs(x[k]));
    return size;
}

/** True if coarse and fine differences agree, and at least half of them have not jumped. */
static bool agree(double *const x[2], size_t count, double most)
{
    const double close = AGREE * largest(x[1], count, most);
    size_t jumped = 0;
    for (size_t k = 0; k < count; k++)
        if (!(fabs(x[1][k]) <= most))
            jumped++;
        else if (!(fabs(x[0][k] - x[1][k]) <= close))
            return false;
    return 2 * jumped <= count && close > 0;
}

/** Fills column `col` from a number of the archive; *told: whether something can be said by it. A
 * shadow that is refused is no fault of the row. */
static hd_status shadow(hd_trial *t, room *r, bool *told, size_t col, const hd_image *image,
                        place at, double time)
{
    char *message = t->message;
    t->message = NULL;
    hd_status status = differ(t, r, 0, image, at, time);
    if (status == HD_OK) status = differ(t, r, 1, image, at, time);
    t->message = message;
    const double most = status == HD_OK ? JUMP * largest(r->begin[1], t->rows, DBL_MAX) : 0.0;
    *told = status == HD_OK && agree(r->begin, t->rows, most) && agree(r->end, t->rows, most);
    for (size_t row = 0; row < t->rows && *told; row++) {
        const double end = r->end[1][row];
        r->from[row * SHADOWS + col] = r->begin[1][row];
        r->to[row * SHADOWS + col] = fabs(end) <= most ? end : NAN;
    }
    return status == HD_NO_MEMORY ? status : HD_OK;
}

/* ---- all directions ------------------------------------------------------------------------ */

/** Fills columns from numbers in random order, and writes how many. */
static hd_status find_shadows(hd_trial *t, room *r, size_t *count, const hd_image *image,
                              place *places, size_t found, double time)
{
    *count = 0;
    memset(r->from, 0, t->rows * SHADOWS * sizeof *r->from);
    for (size_t k = 0; k < found && k < TRIES && *count < SHADOWS; k++) {
        const size_t other = k + (size_t)((double)(found - k) * hd_trial_random(t));
        const place now = places[other];
        bool told;
        places[other] = places[k];
        places[k] = now;
        HD_TRY(shadow(t, r, &told, *count, image, now, time));
        *count += told;
    }
    return HD_OK;
}

static hd_status compare(hd_trial *t, room *r, size_t count, const hd_image *image, double time)
{
    HD_TRY(hd_trial_go(t, &r->record, NULL, NULL, image, time));
    HD_TRY(hd_trial_carry(t, r->from, SHADOWS, r->record, 0.0, hd_record_duration(r->record)));
    for (size_t col = 0; col < count; col++) {
        double size = 0.0, most = 0.0;
        for (size_t row = 0; row < t->rows; row++) {
            const double to = r->to[row * SHADOWS + col];
            if (isnan(to)) continue;
            size = fmax(size, fabs(to));
            most = fmax(most, fabs(to - r->from[row * SHADOWS + col]));
        }
        if (!(most <= CLOSE * size))
            return hd_refuse(t->message, t->size,
                             "carry: differs from trajectories that start nearby by %.3g of a "
                             "vector's largest component after %g time units",
                             most / size, time);
    }
    return HD_OK;
}

static hd_status test(hd_trial *t, room *r, const hd_image *image, place *places, size_t found)
{
    const size_t enough = t->rows < SHADOWS ? t->rows / 2 : SHADOWS / 2;
    double time = hd_trial_time(t, TIME, ENTRIES);
    size_t count = 0;
    for (int k = 0; k <= SHORTER && count < enough; k++, time *= 0.25)
        HD_TRY(find_shadows(t, r, &count, image, places, found, time));
    if (count > 0) return compare(t, r, count, image, 4.0 * time);
    return hd_refuse(t->message, t->size,
                     "archive: no number of it can be changed a little, so that tangent maps "
                     "cannot be held against trajectories that start nearby");
}

hd_status hd_maps_test_shadows(hd_trial *t, const hd_image *start)
{
    const size_t found = find_places(NULL, start);
    place *places = hd_memory_alloc(found, sizeof *places);
    room r;
    hd_status status = room_create(&r, t);
    if (!places) status = HD_NO_MEMORY;
    if (status == HD_OK) (void)find_places(places, start);
    if (status == HD_OK) status = test(t, &r, start, places, found);
    room_clear(&r);
    hd_memory_free(places);
    return status;
}
