/** Scenes by what is not usual about them. */
#ifndef HD_SCENES_H
#define HD_SCENES_H

#include <string.h>

#include "hdlyap/parameters.h"
#include "hdlyap/trajectory.h"

#if defined(__SANITIZE_ADDRESS__)
#define HD_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HD_SANITIZED 1
#endif
#endif
#ifndef HD_SANITIZED
#define HD_SANITIZED 0
#endif

/** To a build that verifies, a frame that a test has broken is a bug. */
#ifdef HD_VERIFY_BUILD
enum { VERIFIES = 1 };
#else
enum { VERIFIES = 0 };
#endif

/** A parameter that has one value of disks: what spheres have. */
static inline bool is_of_spheres(const hd_parameter *row)
{
    static const char *const names[] = {"particles", "aspect_z", "boundary_z"};
    for (int k = 0; k < 3; k++)
        if (strcmp(row->name, names[k]) == 0) return true;
    return false;
}

/** Disks or spheres: what the test is compiled for, here alone. */
enum { DIM = HD_DIM, ROWS_OF_ONE = 2 * DIM, WALL_SETS = 1 << DIM, ALL_WALLS = WALL_SETS - 1 };
/** Directions of the null space: of the momenta, and all of them. */
enum { NULL_P = DIM, NULLS };

static inline hd_scene_def usual_scene(void)
{
    hd_scene_def def = hd_scene_def_default();
    def.particles = DIM == 2 ? HD_DISKS : HD_SPHERES;
    return def;
}

/** Particles of a kind of the core, which may have no box. */
static inline hd_scene_def scene_of_kind(hd_particles kind, int count, double density,
                                         double aspect)
{
    const hd_scene_def core = {.particles = kind};
    hd_scene_def def = hd_scene_def_of(hd_dynamics_of(&core));
    def.number = count;
    if (hd_scene_dimension(&def) > 0) def.density = density, def.aspect = aspect;
    return def;
}

/** The default scene but for the fields given: scene(.number = 12, .boundary[1] = HD_REFLECTING).
 */
#define scene(...) scene_from(usual_scene(), __VA_ARGS__)

/** As another scene but for the fields given, 16 at most. */
#define scene_from(base, ...)                                                                      \
    __extension__({                                                                                \
        hd_scene_def scene_ = (base);                                                              \
        SCENE_FIELDS(__VA_ARGS__, SCENE_16, SCENE_15, SCENE_14, SCENE_13, SCENE_12, SCENE_11,      \
                     SCENE_10, SCENE_9, SCENE_8, SCENE_7, SCENE_6, SCENE_5, SCENE_4, SCENE_3,      \
                     SCENE_2, SCENE_1, 0)                                                          \
        (__VA_ARGS__) scene_;                                                                      \
    })
#define SCENE_FIELDS(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, name,  \
                     ...)                                                                          \
    name
#define SCENE_1(field) scene_ field;
#define SCENE_2(field, ...) SCENE_1(field) SCENE_1(__VA_ARGS__)
#define SCENE_3(field, ...) SCENE_1(field) SCENE_2(__VA_ARGS__)
#define SCENE_4(field, ...) SCENE_1(field) SCENE_3(__VA_ARGS__)
#define SCENE_5(field, ...) SCENE_1(field) SCENE_4(__VA_ARGS__)
#define SCENE_6(field, ...) SCENE_1(field) SCENE_5(__VA_ARGS__)
#define SCENE_7(field, ...) SCENE_1(field) SCENE_6(__VA_ARGS__)
#define SCENE_8(field, ...) SCENE_1(field) SCENE_7(__VA_ARGS__)
#define SCENE_9(field, ...) SCENE_1(field) SCENE_8(__VA_ARGS__)
#define SCENE_10(field, ...) SCENE_1(field) SCENE_9(__VA_ARGS__)
#define SCENE_11(field, ...) SCENE_1(field) SCENE_10(__VA_ARGS__)
#define SCENE_12(field, ...) SCENE_1(field) SCENE_11(__VA_ARGS__)
#define SCENE_13(field, ...) SCENE_1(field) SCENE_12(__VA_ARGS__)
#define SCENE_14(field, ...) SCENE_1(field) SCENE_13(__VA_ARGS__)
#define SCENE_15(field, ...) SCENE_1(field) SCENE_14(__VA_ARGS__)
#define SCENE_16(field, ...) SCENE_1(field) SCENE_15(__VA_ARGS__)

/** The same scene with particles of a second kind. */
static inline hd_scene_def with_second(hd_scene_def def, double fraction, double diameter,
                                       double mass)
{
    const double value[] = {fraction, diameter, mass};
    for (int k = 0; k < 3; k++)
        hd_parameter_assign(&hd_dynamics_of(&def)->parameter[k], &def, value[k]);
    return def;
}

/** A density at which these particles fill such a part of their container. */
static inline hd_scene_def packed(hd_scene_def def, double packing)
{
    def.density *= packing / hd_scene_packing(&def);
    return def;
}

/** The box and its disks in one line, for who needs no more. */
static inline hd_scene_def scene_of(int disks, double density, double aspect, hd_boundary x,
                                    hd_boundary y, uint64_t seed)
{
    return scene(.number = disks, .density = density, .aspect = aspect, .boundary[0] = x,
                 .boundary[1] = y, .seed = seed);
}

/** The same by the edges of the box. */
static inline hd_scene_def scene_in_box(int disks, double lx, double ly, hd_boundary x,
                                        hd_boundary y, uint64_t seed)
{
    return scene_of(disks, disks / (lx * ly), ly / lx, x, y, seed);
}

/** A box of disks or of spheres; walls: 1 of x, 2 of y, 4 of z. Disks know no z. */
static inline hd_scene_def box_of(int disks, double density, double aspect, double aspect_z,
                                  int walls, uint64_t seed)
{
    hd_scene_def def = scene_of(disks, density, aspect, (hd_boundary)(walls & 1),
                                (hd_boundary)(walls >> 1 & 1), seed);
    if (DIM == 2) return def;
    def.aspect_z = aspect_z;
    def.boundary[2] = (hd_boundary)(walls >> 2 & 1);
    return def;
}

/** The same by the edges of the box. */
static inline hd_scene_def box_with(int disks, double lx, double ly, double lz, int walls,
                                    uint64_t seed)
{
    return box_of(disks, disks / (DIM == 2 ? lx * ly : lx * ly * lz), ly / lx, lz / lx, walls,
                  seed);
}

#endif
