/** Positions at reports -> whether a tenth of the particles has left its place [T8]. Displacements
 * are to the nearest image: a particle that has gone around the box looks as if it had stayed, but
 * not all do so at every report. */
#include "run/cages.h"

#include <math.h>

#include "base/memory.h"
#include "dynamics/trajectory.h"
#include "scene/scene.h"

/** A particle has left its place if it is farther from its start than this part of the mean
 * distance of neighbours. Vibrations of a crystal reach half of it. */
static const double PLACE = 0.7;
/** One in this many particles has to leave: a few hop in every crystal with gaps. */
enum { FEW = 10 };

hd_status hd_cages_create(hd_cages *cages, const hd_scene_def *scene)
{
    const size_t count = (size_t)hd_scene_dimension(scene) * (size_t)scene->number;
    const size_t room = (size_t)hd_scene_coordinates(scene) * (size_t)scene->number;
    *cages = (hd_cages){.count = count};
    if (count == 0) return HD_OK; /* this dynamics has no positions */
    cages->start = hd_memory_alloc(room, sizeof(double));
    cages->now = hd_memory_alloc(room, sizeof(double));
    return cages->start && cages->now ? HD_OK : HD_NO_MEMORY;
}

void hd_cages_clear(hd_cages *cages)
{
    hd_memory_free(cages->start);
    hd_memory_free(cages->now);
    *cages = (hd_cages){.start = NULL};
}

void hd_cages_begin(hd_cages *cages, const hd_trajectory *trajectory)
{
    if (cages->start) hd_trajectory_places(trajectory, cages->start, NULL);
    cages->begin = cages->end = hd_trajectory_time(trajectory);
    cages->left = !cages->start;
}

static double square_moved(const double *from, const double *to, const double *box,
                           const hd_boundary *boundary, int dimension)
{
    double square = 0.0;
    for (int d = 0; d < dimension; d++) {
        double moved = to[d] - from[d];
        if (boundary[d] == HD_PERIODIC) moved -= box[d] * rint(moved / box[d]);
        square += moved * moved;
    }
    return square;
}

void hd_cages_look(hd_cages *cages, const hd_trajectory *trajectory, const hd_scene_def *scene)
{
    const int dimension = hd_scene_dimension(scene);
    hd_boundary boundary[HD_DIMENSION_MAX];
    double box[HD_DIMENSION_MAX];
    const double place = PLACE * pow(scene->density, -1.0 / dimension);
    int away = 0;
    cages->end = hd_trajectory_time(trajectory);
    if (cages->left) return;
    for (int d = 0; d < dimension; d++) boundary[d] = hd_scene_boundary(scene, d);
    hd_scene_box(scene, box);
    hd_trajectory_places(trajectory, cages->now, NULL);
    for (int i = 0; i < scene->number; i++)
        away += square_moved(cages->start + dimension * i, cages->now + dimension * i, box,
                             boundary, dimension) > place * place;
    cages->left = away * FEW >= scene->number;
}

bool hd_cages_hold(const hd_cages *cages, double least)
{
    return !cages->left && cages->end > cages->begin && cages->end - cages->begin >= least;
}

void hd_cages_archive(hd_cages *cages, const hd_trajectory *trajectory, hd_archive *archive)
{
    const double now = hd_trajectory_time(trajectory);
    int left = cages->left;
    hd_archive_double(archive, "cages begin", &cages->begin);
    hd_archive_double(archive, "cages end", &cages->end);
    hd_archive_int(archive, "cages left", &left, 0, 1);
    hd_archive_doubles(archive, "cages start", cages->start, cages->count);
    hd_archive_expect(archive, cages->begin <= cages->end && cages->end <= now, "cages end",
                      "it does not fit the time of the checkpoint");
    cages->left = left;
}
