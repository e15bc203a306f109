/** Scene -> shape of its dumbbells, and what kinetic theory predicts for them. It is that
 * for disks which leave the same free room, corrected for size and speed of dumbbells [T23]. */
#include "dynamics/dumbbells/dumbbells.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static const hd_parameter_word inertias[] = {{"disks", 0}, {"points", -1}, {NULL, 0}};

const hd_parameter hd_dumbbell_own[HD_DUMBBELL_OWN] = {
    {.name = "bond",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(0),
     .default_value = 0.25,
     .min = 0.01,
     .max = 2.0,
     .range = "from 0.01 to 2",
     .unit = "sigma",
     .text = "Distance between the centres of the two disks of a dumbbell.",
     .record = "bond"},
    {.name = "inertia",
     .kind = HD_PARAMETER_INTERVAL,
     .words = inertias,
     .offset = HD_OWN(1),
     .default_value = 0.0,
     .min = 1e-6,
     .max = 1e6,
     .range = "disks, points, or from 1e-6 to 1e6",
     .unit = "sigma^2",
     .text = "Moment of inertia of a dumbbell of mass 1. disks: that of two uniform disks, bond^2 "
             "/ 4 + 1/8. points: all mass in the two centres, bond^2 / 4.",
     .record = "inertia"}};

double hd_dumbbell_bond(const hd_scene_def *scene) { return scene->own[0].real; }

double hd_dumbbell_inertia(const hd_scene_def *scene)
{
    const double given = scene->own[1].real,
                 points = 0.25 * scene->own[0].real * scene->own[0].real;
    return given > 0 ? given : given < 0 ? points : points + 0.125;
}

int hd_dumbbell_sites(const hd_scene_def *scene, double *site)
{
    site[1] = 0.5 * hd_dumbbell_bond(scene);
    site[0] = -site[1];
    return 2;
}

double hd_dumbbell_size(const hd_scene_def *scene)
{
    const double half = fmin(0.5 * hd_dumbbell_bond(scene), 0.5); /* distance of centre and chord */
    const double both = 0.5 * (acos(2.0 * half) - 2.0 * half * sqrt(1.0 - 4.0 * half * half));
    return 0.5 * PI - both;
}

/** The scene with disks that leave the same free room as its dumbbells. Each covers the area of the
 * two disks with the strip between them; for long bonds less, because others reach into the strip.
 * acos is not used, because the length of an epoch, and so all bits, follow from this. */
static hd_scene_def like(const hd_scene_def *scene)
{
    const double most = 2.1;
    hd_scene_def disks = *scene;
    const double each = fmin(0.25 * PI + hd_dumbbell_bond(scene), most);
    disks.density = fmin(scene->density * each * 4.0 / PI, 1.15);
    return disks;
}

/** Momenta over those of disks: they are smaller, because rotation has a share of the energy. */
static const double SPEED = 0.81649658092772603273; /* sqrt(2/3) */

/** round: mean length of the outline around which a partner's centre can go, over that of disks; it
 * is exact but for the dents of long bonds, 0.06 d^4. turns: speed at which gaps close, over that
 * without rotation; its square, w^2 / 2 with w^2 = 2 + c_i^2 + c_j^2, has the exact mean. */
static double rate_of(const hd_scene_def *scene)
{
    const hd_scene_def disks = like(scene);
    const double d = hd_dumbbell_bond(scene), dents = 0.06 * d * d * d * d;
    const double round = 1.0 + 2.0 * d / PI + dents,
                 turns = sqrt(1.0 + 0.125 * d * d / hd_dumbbell_inertia(scene));
    return hd_fluid_disks.rate(&disks) * (scene->density / disks.density) * round * turns * SPEED;
}

static double free_path_of(const hd_scene_def *scene)
{
    return SPEED * sqrt(0.5 * PI) / rate_of(scene);
}

static double sound_of(const hd_scene_def *scene)
{
    const hd_scene_def disks = like(scene);
    return SPEED * hd_fluid_disks.sound(&disks);
}

static double transverse_of(const hd_scene_def *scene)
{
    const hd_scene_def disks = like(scene);
    return SPEED * hd_fluid_disks.transverse(&disks);
}

const hd_fluid hd_fluid_dumbbells = {.density_max = 1.1547005383792517,
                                     .rate = rate_of,
                                     .free_path = free_path_of,
                                     .sound = sound_of,
                                     .transverse = transverse_of,
                                     /* five boxes of 160: densities 0.3 and 0.6, bonds 0.25, 0.5 */
                                     .lp = {0.11, 0.16, 0.02, 0.02, 0.28, 2.0, 0.1, 0.1},
                                     .t = {0.02, 0.0, 0.007, 0.0, 0.06, 1.3, 0.03, 0.1}};
