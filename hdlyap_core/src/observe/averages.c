/** Numbers that a row tells of its states -> their means over time, with standard errors from
 * blocks [T8]. What is summed is how far a number is from that of the first look: what is constant
 * then has exactly its value as its mean, and what fluctuates little loses no digits. */
#include "hdlyap/averages.h"

#include <math.h>

#include "averages/blocks.h"
#include "base/check.h"
#include "base/memory.h"
#include "dynamics/trajectory.h"
#include "observe/observable.h"
#include "scene/scene.h"

/** Looks in the time (N / 2) / collision_rate, over which particles forget about 1/e. */
static const double LOOKS = 4.0;

struct hd_averages {
    const hd_scene_def *scene;
    const hd_dynamics *of;
    double apart;                  /**< time from one look to the next */
    double start;                  /**< where the averages began; negative before that */
    double looks;                  /**< number of looks since then */
    double first[HD_AVERAGES_MAX]; /**< numbers of the first look */
    double sum[HD_AVERAGES_MAX];   /**< of what they have changed by, over all looks */
    hd_blocks blocks;
};

int hd_averages_count(const hd_averages *a) { return a->of->averages; }
double hd_averages_time(const hd_averages *a) { return a->looks * a->apart; }

hd_mean hd_averages_read(const hd_averages *a, int k)
{
    HD_ASSERT(k >= 0 && k < a->of->averages);
    return (hd_mean){.name = a->of->average[k].name,
                     .unit = a->of->average[k].unit,
                     .mean = a->looks > 0 ? a->first[k] + a->sum[k] / a->looks : NAN,
                     .std_error = hd_blocks_error(&a->blocks, &(hd_part){k, 1.0}, 1)};
}

static double averages_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(hd_averages) + hd_blocks_bytes(hd_dynamics_of(scene)->averages);
}

static void averages_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    (void)self;
    extent->averages = hd_dynamics_of(scene)->averages;
}

static void *averages_create(const hd_observing *with, hd_status *status)
{
    hd_averages *a = hd_memory_alloc(1, sizeof *a);
    *status = HD_NO_MEMORY;
    if (!a) return NULL;
    a->scene = with->scene;
    a->of = hd_dynamics_of(with->scene);
    a->apart = 0.5 * with->scene->number / a->of->collision_rate(with->scene) / LOOKS;
    if (a->of->step) a->apart = fmax(a->apart, a->of->step(with->scene));
    a->start = -1.0;
    *status = hd_blocks_create(&a->blocks, a->of->averages, with->block);
    if (*status == HD_OK) return a;
    hd_memory_free(a);
    return NULL;
}

static void averages_free(void *self)
{
    hd_averages *a = self;
    hd_blocks_clear(&a->blocks);
    hd_memory_free(a);
}

static void averages_clear(void *self, const hd_moment *now)
{
    hd_averages *a = self;
    a->start = hd_trajectory_time(now->trajectory);
    a->looks = 0.0;
    for (int k = 0; k < a->of->averages; k++) a->first[k] = a->sum[k] = 0.0;
    hd_blocks_restart(&a->blocks);
}

static double averages_next(const void *self)
{
    const hd_averages *a = self;
    return a->start < 0 ? INFINITY : a->start + (a->looks + 1.0) * a->apart;
}

static hd_status averages_glance(void *self, hd_trajectory *trajectory)
{
    hd_averages *a = self;
    double value[HD_AVERAGES_MAX];
    HD_TRY(hd_trajectory_measure(trajectory, value, a->scene));
    for (int k = 0; k < a->of->averages; k++) {
        if (a->looks == 0) a->first[k] = value[k];
        value[k] -= a->first[k];
        a->sum[k] += value[k];
        value[k] *= a->apart;
    }
    a->looks++;
    hd_blocks_add(&a->blocks, value, a->apart);
    return HD_OK;
}

static void averages_archive(void *self, const hd_moment *now)
{
    hd_averages *a = self;
    hd_archive *archive = now->archive;
    const size_t count = (size_t)a->of->averages;
    hd_archive_double(archive, "averages start", &a->start);
    hd_archive_double(archive, "averages looks", &a->looks);
    hd_archive_doubles(archive, "averages first", a->first, count);
    hd_archive_doubles(archive, "averages sum", a->sum, count);
    const double time = hd_trajectory_time(now->trajectory);
    hd_archive_expect(archive, a->looks >= 0 && floor(a->looks) == a->looks, "averages looks",
                      "it is no number of looks");
    hd_archive_expect(archive, a->start <= time && averages_next(a) > time, "averages start",
                      "it does not fit the time of the checkpoint");
    hd_blocks_archive(&a->blocks, archive);
}

static hd_stated read_average(const hd_parts *parts, const hd_aim *goal)
{
    const hd_mean found = hd_averages_read(parts->averages, goal->number[0]);
    return (hd_stated){found.mean, found.std_error, 0.0};
}

static const hd_quantity each[] = {{.name = "average", .of = HD_OF_AVERAGE, .read = read_average},
                                   {.name = NULL}};
static const hd_quantities quantities = {"averages", each};

const hd_observable hd_averages_row = {.needs = HD_NEEDS_AVERAGES,
                                       .quantities = &quantities,
                                       .bytes = averages_bytes,
                                       .extend = averages_extend,
                                       .create = averages_create,
                                       .free = averages_free,
                                       .clear = averages_clear,
                                       .next = averages_next,
                                       .glance = averages_glance,
                                       .archive = averages_archive};
