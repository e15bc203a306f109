/** Random scenes of all particles, most of them impossible: each is judged within milliseconds, and
 * what is accepted has a start. */
#include <time.h>

#include "draw.h"
#include "dynamics/trajectory.h"
#include "scene/scene.h"
#include "testing.h"

/** Largest processor time of one scene, and of all on average [s]; endless ones took half a minute.
 */
static const double SLOWEST = HD_SANITIZED ? 3.0 : 0.3, MEAN = HD_SANITIZED ? 0.03 : 0.003;

/** Makes an edge hardly longer than `needed`, by changing the density. */
static void make_tight(hd_random *random, hd_scene_def *def, double needed)
{
    double box[HD_DIMENSION_MAX];
    const int dimension = hd_scene_dimension(def);
    hd_scene_box(def, box);
    const double part = (needed + log_uniform(random, 1e-13, 1e-2)) /
                        box[one_of(random, dimension)];
    def->density /= pow(part, dimension);
}

static hd_scene_def drawn(hd_random *random, hd_particles particles)
{
    hd_scene_def def = scene_of_kind(particles, 1, 1.0, 1.0);
    const bool flat = hd_scene_dimension(&def) == 2, bonded = particles == HD_DUMBBELLS;
    def.number = (int)log_uniform(random, 1.0, 1000.0);
    def.density = log_uniform(random, 1e-3, 1.2);
    def.aspect = log_uniform(random, 1e-2, 1e2);
    def.observe = 0;
    def.exponents = HD_EXPONENTS_NONE;
    if (!flat) def.aspect_z = log_uniform(random, 1e-2, 1e2);
    for (int d = 0; d < (flat ? 2 : 3); d++) def.boundary[d] = (hd_boundary)one_of(random, 2);
    if (bonded) def.own[0].real = chance(random, 0.2) ? 2.0 : log_uniform(random, 0.01, 2.0);
    const double bond = bonded && chance(random, 0.5) ? def.own[0].real : 0.0;
    if (chance(random, 0.3)) make_tight(random, &def, 1.0 + bond);
    if (!flat || bonded || !chance(random, 0.2)) return def;
    def.container = HD_CIRCLE;
    def.aspect = 1.0;
    def.boundary[0] = def.boundary[1] = P;
    return def;
}

/** Returns the processor time for it [s]. */
static double check_one(const hd_scene_def *def, int *accepted)
{
    char message[512] = "";
    hd_trajectory *trajectory = NULL;
    const clock_t begin = clock();
    const hd_status status = hd_scene_check(def, message, sizeof message);
    const double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    const char *of = hd_dynamics_of(def)->particles;
    if (status == HD_OK && hd_trajectory_create(&trajectory, def) != HD_OK)
        fail_msg("no start of %d %s, density %.17g, aspect %.17g, boundaries %d %d, bond %.17g",
                 def->number, of, def->density, def->aspect, def->boundary[0], def->boundary[1],
                 def->own[0].real);
    if (seconds > SLOWEST) fail_msg("%g s for %d %s: %s", seconds, def->number, of, message);
    hd_trajectory_free(trajectory);
    *accepted += status == HD_OK;
    return seconds;
}

TEST(scenes_are_judged_at_once_and_what_is_accepted_starts)
{
    const int each = second_tier() ? 20000 : 400;
    for (int particles = HD_DISKS; particles < HD_PARTICLES_END; particles++) {
        const hd_scene_def kind = {.particles = (hd_particles)particles};
        if (hd_scene_dimension(&kind) == 0) continue;
        hd_random random = hd_random_seeded(60, (uint64_t)particles);
        double seconds = 0.0;
        int accepted = 0;
        for (int k = 0; k < each; k++) {
            const hd_scene_def def = drawn(&random, (hd_particles)particles);
            seconds += check_one(&def, &accepted);
        }
        CHECK_WITHIN(seconds / each, 0.0, MEAN);
        CHECK_WITHIN((double)accepted / each, 0.02, 0.9); /* soft ones need larger boxes */
    }
}

/** Of two dumbbells as long as the box is wide, at densities that nothing can have. */
TEST(no_row_is_as_narrow_as_it_is_endless)
{
    hd_scene_def def = hd_scene_def_of(hd_dynamics_of(&(hd_scene_def){.particles = HD_DUMBBELLS}));
    def.number = 2;
    def.density = 0.5;
    def.own[0].real = 1.9;
    def.boundary[0] = def.boundary[1] = R;
    int accepted = 0;
    (void)check_one(&def, &accepted);
    assert_int_equal(accepted, 0);
}

/** Room between walls is 1e-9 for disks, and for dumbbells along their bonds. */
TEST(room_along_the_bonds_is_no_less_than_that_of_disks)
{
    const double room[] = {3e-10, 1e-8};
    for (int k = 0; k < 2; k++) {
        hd_scene_def def = hd_scene_def_of(
            hd_dynamics_of(&(hd_scene_def){.particles = HD_DUMBBELLS}));
        const double width = 1.0 + room[k], length = 1.0 + def.own[0].real + room[k];
        def.number = 1;
        def.aspect = width / length;
        def.density = 1.0 / (width * length);
        def.boundary[0] = def.boundary[1] = R;
        int accepted = 0;
        (void)check_one(&def, &accepted);
        assert_int_equal(accepted, k);
    }
}
