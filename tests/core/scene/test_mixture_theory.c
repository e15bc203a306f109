/** Kinetic theory of mixtures of disks and of spheres: beside that of one kind, beside closed forms
 * of the equation of state, and beside integrals over Maxwell's distribution in a thin gas. */
#include "mixed.h"

#include "scene/mixture.h"

/** Sums of at most 20 terms, each rounded a few times. */
static const double ROUNDING = 64.0 * DBL_EPSILON;

static const hd_fluid *pure(const hd_scene_def *def)
{
    return def->particles == HD_DISKS ? &hd_fluid_disks : &hd_fluid_spheres;
}

static const hd_fluid *mixture(const hd_scene_def *def)
{
    return def->particles == HD_DISKS ? &hd_fluid_disk_mixture : &hd_fluid_sphere_mixture;
}

static void close(double got, double want) { CHECK_CLOSE(got, want, ROUNDING * fabs(want)); }

/** What all that is said of a fluid has in units of size and mass. */
static void same_in_units(const hd_fluid *of, const hd_scene_def *def, const hd_fluid *like,
                          const hd_scene_def *unit, double size, double mass)
{
    close(of->rate(def), like->rate(unit) / (size * sqrt(mass)));
    close(of->free_path(def), like->free_path(unit) * size);
    close(of->sound(def), like->sound(unit) / sqrt(mass));
    close(of->transverse(def), like->transverse(unit) / sqrt(mass));
}

/** By other parameters: diameter and mass 1 of both kinds, or all of the second kind. */
TEST(one_kind_is_one_kind)
{
    for (hd_particles k = HD_DISKS; k <= HD_SPHERES; k++)
        for (double density = 1e-3; density < 0.85; density += 0.2) {
            const double d = 1.25, m = 3.0, power = k == HD_DISKS ? d * d : d * d * d;
            const hd_scene_def one = mixed(k, density, 0.0, 1.0, 1.0),
                               alike = mixed(k, density, 0.35, 1.0, 1.0),
                               other = mixed(k, density / power, 1.0, d, m);
            assert_ptr_equal(hd_dynamics_of(&one)->fluid, pure(&one));
            assert_ptr_equal(hd_dynamics_of(&other)->fluid, mixture(&other));
            same_in_units(mixture(&one), &one, pure(&one), &one, 1.0, 1.0);
            same_in_units(mixture(&alike), &alike, pure(&one), &one, 1.0, 1.0);
            same_in_units(mixture(&other), &other, pure(&one), &one, d, m);
        }
}

/** A mixture, and moments of its diameters. */
typedef struct moments {
    double first, second, third, density; /**< means of diameter^n */
} moments;

static moments moments_of(double x, double d, double density)
{
    return (moments){1.0 - x + x * d, 1.0 - x + x * d * d, 1.0 - x + x * d * d * d, density};
}

/** Disks: Z = 1 + (eta + xi) / (1 - eta) + 9/8 eta xi / (1 - eta)^2, xi = pi rho <d>^2 / 4, which
 * follows from the virial with the contact values of Jenkins and Mancini. Spheres: the closed form
 * of Mansoori and others, their equation 5, with xi_k = pi rho <d^k> / 6. */
static double closed(hd_particles particles, moments m)
{
    const double c = PI * m.density / (particles == HD_DISKS ? 4.0 : 6.0);
    if (particles == HD_DISKS) {
        const double eta = c * m.second, xi = c * m.first * m.first, f = 1.0 - eta;
        return 1.0 + (eta + xi) / f + 9.0 / 8.0 * eta * xi / (f * f);
    }
    const double x1 = c * m.first, x2 = c * m.second, x3 = c * m.third, f = 1.0 - x3;
    return (1.0 / f + 3.0 * x1 * x2 / (c * f * f) + x2 * x2 * x2 * (3.0 - x3) / (c * f * f * f));
}

TEST(the_equation_of_state_has_its_closed_form)
{
    static const double diameter[] = {0.3, 0.8, 1.4, 2.5};
    for (hd_particles k = HD_DISKS; k <= HD_SPHERES; k++)
        for (int s = 0; s < 4; s++)
            for (double filled = 0.05; filled < 0.6; filled += 0.1) {
                const double x = 0.2 + 0.15 * s, d = diameter[s];
                moments m = moments_of(x, d, 1.0);
                m.density = k == HD_DISKS ? filled * 4.0 / PI / m.second
                                          : filled * 6.0 / PI / m.third;
                const hd_scene_def def = mixed(k, m.density, x, d, 2.0);
                close(hd_scene_packing(&def), filled);
                close(hd_mixture_compressibility(&def), closed(k, m));
            }
}

/** c^2 = (d p / d rho at constant entropy) / mass, by differences of the closed form: along an
 * adiabat kT changes by 2 Z / d for each part of rho. */
TEST(sound_is_that_of_the_equation_of_state)
{
    for (hd_particles k = HD_DISKS; k <= HD_SPHERES; k++)
        for (double filled = 0.1; filled < 0.6; filled += 0.2) {
            const double x = 0.35, d = 1.4, mass = 5.0, step = 1e-5,
                         kt = k == HD_DISKS ? 1.0 : 2.0 / 3.0, degrees = k == HD_DISKS ? 2.0 : 3.0;
            const moments unit = moments_of(x, d, 1.0);
            const double density = k == HD_DISKS ? filled * 4.0 / PI / unit.second
                                                 : filled * 6.0 / PI / unit.third;
            const hd_scene_def def = mixed(k, density, x, d, mass);
            double z[3];
            for (int n = 0; n < 3; n++)
                z[n] = closed(k, moments_of(x, d, density * (1.0 + (n - 1) * step)));
            const double slope = z[1] + (z[2] - z[0]) / (2.0 * step) + 2.0 / degrees * z[1] * z[1];
            const double want = sqrt(kt * slope / (1.0 - x + x * mass));
            /* differences round by eps / step, and leave step^2 */
            CHECK_CLOSE(mixture(&def)->sound(&def), want, 1e-8 * want);
        }
}

/** Mean distance per time of two particles whose relative momenta have the reduced mass: an
 * integral over Maxwell's distribution by the trapezoidal rule, exact for such a function. */
static double mean_speed(double kt, double reduced, int dimension)
{
    const double s = sqrt(kt / reduced), step = 1e-3;
    double above = 0.0, below = 0.0;
    for (double v = 0.0; v < 12.0; v += step) {
        const double weight = pow(v, dimension - 1) * exp(-0.5 * v * v);
        above += v * weight;
        below += weight;
    }
    return s * above / below;
}

/** In a thin gas particle a sweeps what is excluded, once for each b: of width d_a + d_b, or of the
 * area pi (d_a + d_b)^2 / 4. Rates of a pair fit each other: as many of a with b as of b with a. */
TEST(a_thin_gas_collides_as_its_cross_sections)
{
    for (hd_particles k = HD_DISKS; k <= HD_SPHERES; k++) {
        const double density = 1e-9, x = 0.25, kt = k == HD_DISKS ? 1.0 : 2.0 / 3.0;
        const double d[] = {1.0, 0.4}, m[] = {1.0, 7.0}, part[] = {1.0 - x, x};
        const hd_scene_def def = mixed(k, density, x, d[1], m[1]);
        double all = 0.0;
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++) {
                const double both = d[a] + d[b], reduced = m[a] * m[b] / (m[a] + m[b]);
                const double swept = k == HD_DISKS ? both : PI * both * both / 4.0;
                const double want = density * part[b] * swept *
                                    mean_speed(kt, reduced, k == HD_DISKS ? 2 : 3);
                /* the density has contact values of 1 + 1e-9 */
                CHECK_CLOSE(hd_mixture_rate(&def, a, b), want, 1e-7 * want);
                all += part[a] * want;
            }
        CHECK_CLOSE(mixture(&def)->rate(&def), all, 1e-7 * all);
        close(part[0] * hd_mixture_rate(&def, 0, 1), part[1] * hd_mixture_rate(&def, 1, 0));
        const double speed = part[0] * mean_speed(kt, m[0], k == HD_DISKS ? 2 : 3) +
                             part[1] * mean_speed(kt, m[1], k == HD_DISKS ? 2 : 3);
        CHECK_CLOSE(mixture(&def)->free_path(&def), speed / all, 1e-7 * speed / all);
    }
}

/** Points among disks or spheres meet these as in the room that is left, g = 1 / (1 - eta), which
 * is exact. */
TEST(points_see_the_room_that_is_left)
{
    for (hd_particles k = HD_DISKS; k <= HD_SPHERES; k++)
        for (double density = 0.1; density < 0.8; density += 0.3) {
            const double point = 1e-12; /* its part of what is known is as small */
            const hd_scene_def def = mixed(k, density, 0.5, point, 1.0);
            const double thin = 1e-9 * density; /* without others */
            const hd_scene_def alone = mixed(k, thin, 0.5, point, 1.0);
            const double g = hd_mixture_rate(&def, 1, 0) / hd_mixture_rate(&alone, 1, 0) * 1e-9;
            CHECK_CLOSE(g, 1.0 / (1.0 - hd_scene_packing(&def)), 1e-8);
        }
}
