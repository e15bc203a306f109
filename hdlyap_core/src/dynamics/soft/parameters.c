/** Parameters of soft particles -> potential, integrator, what is expected of a run, and the time
 * step with which it keeps its energy to what is asked [T24]. */
#include <math.h>

#include "dynamics/soft/soft.h"
#include "dynamics/trajectory.h"
#include "scene/scene.h"

/** Simulated time of a run without an end, for which its step is chosen [time units]. */
static const double OPEN_END = 1e4;
/** The energy error asked is this many times the accuracy; what may walk is this many standard
 * deviations of the walk at its end. */
static const double ASKED = 10.0, DEVIATIONS = 3.0;
/** Most that the parameter may be [time units]. */
static const double LONGEST = 10.0;

/* ---- parameters ---------------------------------------------------------------------------- */

static const hd_parameter_word potential_words[] = {
    {"power", HD_POWER}, {"wca", HD_WCA}, {"lennard_jones", HD_LENNARD_JONES}, {NULL, 0}};
static const hd_parameter_word integrator_words[] = {
    {"auto", HD_INTEGRATOR_AUTO}, {"verlet", HD_VERLET}, {"pefrl", HD_PEFRL}, {NULL, 0}};

const hd_parameter hd_soft_own[HD_SOFT_OWN] = {
    {.name = "potential",
     .kind = HD_PARAMETER_WORD,
     .words = potential_words,
     .offset = HD_OWN(HD_SOFT_POTENTIAL),
     .default_value = HD_WCA,
     .max = HD_POTENTIALS - 1,
     .range = "power, wca or lennard_jones",
     .unit = "",
     .text = "Energy of a pair at distance r. power: 100 (1 - r^2)^4. wca: 4 (r^-12 - r^-6) + 1 "
             "up to r = 2^(1/6). lennard_jones: 4 (r^-12 - r^-6), cut off smoothly from r = 2 to "
             "2.5."},
    {.name = "energy",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_SOFT_ENERGY),
     .default_value = 1.0,
     .min = -10.0,
     .max = 1e6,
     .range = "from -10 to 1e6",
     .unit = "epsilon",
     .text = "Kinetic and potential energy per particle. It must be above the energy of the start "
             "lattice."},
    {.name = "time_step",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_SOFT_TIME_STEP),
     .max = 10.0,
     .resolve = hd_soft_time_step,
     .range = "from 0 to 10",
     .unit = "time units",
     .text =
         "Time step of the integrator. 0: chosen so that the relative error of the energy stays "
         "below ten times the accuracy, which counts as at least 1e-6, for wca 5e-5, and at most "
         "1e-3, to the end of the duration (0: over 1e4 time units); when resumed, as before."},
    {.name = "integrator",
     .kind = HD_PARAMETER_WORD,
     .words = integrator_words,
     .offset = HD_OWN(HD_SOFT_INTEGRATOR),
     .default_value = HD_INTEGRATOR_AUTO,
     .max = HD_INTEGRATOR_AUTO,
     .resolve = hd_soft_integrator_chosen,
     .range = "auto, verlet or pefrl",
     .unit = "",
     .text = "Method by which particles move. verlet has order 2 and computes forces once a step; "
             "pefrl has order 4 and computes them four times. auto: verlet for wca, which is not "
             "smooth enough for order 4, and pefrl for the others; when resumed, as before."}};

/* ---- what they mean ------------------------------------------------------------------------ */

const hd_potential *hd_soft_potential(const hd_scene_def *scene)
{
    const unsigned k = (unsigned)scene->own[HD_SOFT_POTENTIAL].whole; /* maybe not checked yet */
    return &hd_potentials[k < HD_POTENTIALS ? k : 0];
}

/** Order 4 is not worth its cost where V'' jumps. */
double hd_soft_integrator_chosen(const hd_scene_def *scene)
{
    const int asked = scene->own[HD_SOFT_INTEGRATOR].whole;
    if (asked != HD_INTEGRATOR_AUTO) return asked;
    return hd_soft_potential(scene)->smooth < 2 ? HD_VERLET : HD_PEFRL;
}

const hd_integrator *hd_soft_integrator(const hd_scene_def *scene)
{
    const unsigned k = (unsigned)hd_soft_integrator_chosen(scene);
    return &hd_integrators[k < HD_INTEGRATORS ? k : 0];
}

/** The energy that sets the scale of speeds: that of the scene, but at least the depth of the well,
 * in which particles are fast though their energy is near 0. */
static double usual_energy(const hd_scene_def *scene)
{
    return fmax(fabs(scene->own[HD_SOFT_ENERGY].real), hd_soft_potential(scene)->depth);
}

double hd_soft_speed(const hd_scene_def *scene) { return sqrt(usual_energy(scene)); }

double hd_soft_rate(const hd_scene_def *scene)
{
    return 0.5 * scene->number * hd_soft_speed(scene) * (1.0 + 3.0 * scene->density);
}

/** The highest frequency with which a pair swings at distances where V is below four times
 * usual_energy, but at least four times the root of that energy, for particles that fly past each
 * other. */
static double fastest(const hd_scene_def *scene)
{
    enum { HALVINGS = 60, LOOKS = 64 };
    const hd_potential *potential = hd_soft_potential(scene);
    const double cut = potential->cut * potential->cut;
    double near = 0.0, far = cut, most = 16.0 * usual_energy(scene);
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (near + far);
        *(potential->at(middle).v > 4.0 * usual_energy(scene) ? &near : &far) = middle;
    }
    for (int k = 0; k < LOOKS; k++) {
        const double u = far + (cut - far) * k / LOOKS;
        const hd_pull pull = potential->at(u);
        most = fmax(most, pull.b + pull.c * u);
    }
    return sqrt(most);
}

/** At most what leaves a run twice as far from its end by HD_ENERGY_LOST_FROM as from what is
 * asked. */
static double accuracy(const hd_scene_def *scene)
{
    return fmin(fmax(scene->accuracy, hd_soft_potential(scene)->least),
                0.5 * HD_ENERGY_LOST_FROM / ASKED);
}

double hd_soft_energy_asked(const hd_scene_def *scene) { return ASKED * accuracy(scene); }

/** The step that keeps the energy over any time, where the potential has no jump. */
static double step_of_swing(const hd_scene_def *scene)
{
    const hd_integrator *by = hd_soft_integrator(scene);
    const double aim = accuracy(scene);
    return by->angle * (by->order == 2 ? sqrt(aim) : sqrt(sqrt(aim))) / fastest(scene);
}

/** Root of order n of x > 0 by Newton's method: + - * / only, so that all machines agree. */
static double root(double x, int n)
{
    enum { STEPS = 200 };
    double y = fmax(x, 1.0);
    for (int k = 0; k < STEPS; k++) {
        double power = 1.0;
        for (int m = 1; m < n; m++) power *= y;
        y -= (y - x / power) / n;
    }
    return y;
}

/** The step with which the walk of the energy is small enough at the end of the run. */
static double step_of_walk(const hd_scene_def *scene)
{
    const hd_potential *potential = hd_soft_potential(scene);
    const double averaged = scene->duration > 0 ? scene->duration : OPEN_END,
                 time = scene->equilibration + hd_scene_parting(scene) + averaged,
                 crossings = 2.0 * hd_soft_rate(scene) * time / scene->number;
    double walk = hd_soft_integrator(scene)->walk * potential->jump *
                  sqrt(crossings / scene->number);
    for (int k = 1; k < potential->smooth; k++) walk *= hd_soft_speed(scene);
    for (int k = 2; k <= potential->smooth + 1; k++) walk /= k;
    return root(hd_soft_energy_asked(scene) / (DEVIATIONS * walk), potential->smooth + 1);
}

double hd_soft_time_step(const hd_scene_def *scene)
{
    const double asked = scene->own[HD_SOFT_TIME_STEP].real;
    return asked > 0 ? asked : fmin(fmin(step_of_swing(scene), step_of_walk(scene)), LONGEST);
}

/* ---- what is expected ---------------------------------------------------------------------- */

/** The power of the time step by which zero exponents split: from the jump at the cut [T24], or the
 * order of the integrator if that is less. */
double hd_soft_split(const hd_scene_def *scene)
{
    return fmin(2.0 / 3.0 * hd_soft_potential(scene)->smooth, hd_soft_integrator(scene)->order);
}

double hd_soft_entries(const hd_scene_def *scene)
{
    const double kicks = hd_soft_integrator(scene)->kicks,
                 pairs = scene->number *
                         hd_neighbours_expected(scene, hd_soft_potential(scene)->cut);
    return (1.0 + 1.2 * kicks * pairs) / hd_soft_time_step(scene);
}

/** Time that sound takes through the box; its velocity is some times the usual speed. */
double hd_soft_crossing(const hd_scene_def *scene)
{
    double box[HD_DIMENSION_MAX], longest = 0.0;
    hd_scene_box(scene, box);
    for (int d = 0; d < hd_scene_dimension(scene); d++) longest = fmax(longest, box[d]);
    return longest / (hd_soft_speed(scene) * (1.5 + 8.0 * scene->density));
}
