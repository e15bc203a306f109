/** Fourth powers of momenta and of vectors as an observable. */
#include "base/check.h"
#include "base/memory.h"
#include "observe/observable.h"
#include "scene/scene.h"

/** The result is [HEAD + 2 (N + n)]: number of samples, N, n; means of |p|^4 of each particle, and
 * of the sum over particles of (dq^2 + dp^2)^2 of each vector; both in the last sample. */
enum { SAMPLES, PARTICLES, VECTORS, HEAD };

static size_t count_of(const double *self)
{
    return (size_t)self[PARTICLES] + (size_t)self[VECTORS];
}

static double momenta_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(double) * (HEAD + 2.0 * (scene->number + hd_scene_vectors(scene)));
}

static void *momenta_create(const hd_observing *with, hd_status *status)
{
    const size_t count = (size_t)with->scene->number + (size_t)with->vectors;
    double *self = hd_memory_alloc(HEAD + 2 * count, sizeof *self);
    *status = self ? HD_OK : HD_NO_MEMORY;
    if (!self) return NULL;
    self[PARTICLES] = with->scene->number;
    self[VECTORS] = with->vectors;
    return self;
}

static void momenta_free(void *self) { hd_memory_free(self); }

static void momenta_clear(void *self, const hd_moment *now)
{
    (void)now;
    double *made = self;
    made[SAMPLES] = 0.0;
    for (size_t k = 0; k < 2 * count_of(made); k++) made[HEAD + k] = 0.0;
}

/** The square of the sum of squares of `count` numbers. */
static double fourth(const double *x, int count, size_t stride)
{
    double sum = 0.0;
    for (int d = 0; d < count; d++) sum += x[(size_t)d * stride] * x[(size_t)d * stride];
    return sum * sum;
}

static hd_status momenta_measure(void *self, const hd_moment *now)
{
    double *made = self, *powers = made + HEAD + count_of(made), *of_vectors = powers;
    const int particles = now->with->scene->number, half = hd_scene_coordinates(now->with->scene);
    for (int i = 0; i < particles; i++) *of_vectors++ = fourth(now->p + i * half, half, 1);
    for (int col = 0; col < now->carried.count; col++) {
        double sum = 0.0;
        for (int i = 0; i < particles; i++)
            sum += fourth(now->carried.data + (size_t)(2 * half * i * now->carried.stride + col),
                          2 * half, (size_t)now->carried.stride);
        of_vectors[now->carried.first + col] = sum;
    }
    return HD_OK;
}

static hd_status momenta_share(void *self, const hd_moment *now)
{
    double *made = self, *row = made + HEAD + count_of(made) + (size_t)made[PARTICLES];
    const size_t n = (size_t)now->with->vectors, carried = (size_t)now->with->carried;
    HD_TRY(hd_communicator_share(now->with->communicator, row,
                                 (hd_shared){1, n, (size_t)now->with->width, carried, 0}));
    for (size_t col = carried; col < n; col++) row[col] = row[n - 1 - col];
    return HD_OK;
}

static void momenta_add(void *self, const hd_moment *now)
{
    (void)now;
    double *made = self, *mean = made + HEAD;
    const size_t count = count_of(made);
    made[SAMPLES]++;
    for (size_t k = 0; k < count; k++) mean[k] += (mean[count + k] - mean[k]) / made[SAMPLES];
}

static void momenta_archive(void *self, const hd_moment *now)
{
    const size_t count = HEAD + 2 * count_of(self);
    hd_archive_of_doubles(now->archive, "momenta", count);
    hd_archive_next_doubles(now->archive, self, count);
}

const hd_observable hd_momenta_row = {.needs = HD_NEEDS_FRAME | HD_NEEDS_STATE,
                                      .bytes = momenta_bytes,
                                      .create = momenta_create,
                                      .free = momenta_free,
                                      .clear = momenta_clear,
                                      .measure = momenta_measure,
                                      .share = momenta_share,
                                      .add = momenta_add,
                                      .archive = momenta_archive};
