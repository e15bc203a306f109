/** An example of a user's dynamics: the beta chain of Fermi, Pasta, Ulam and Tsingou, closed to a
 * ring: H = sum p_i^2 / 2 + d_i^2 / 2 + beta d_i^4 / 4, d_i = q_(i+1) - q_i. Prints all exponents.
 * They come in pairs, and four vanish (energy and time, momentum and translation); all if beta = 0.
 * cc -O3 chain.c $(pkg-config --cflags --libs hdlyap_core) \
 *    -Wl,-rpath,$(pkg-config --variable=libdir hdlyap_core) -o chain && ./chain 16 1.0 */
#include <hdlyap/hdlyap.h>
#include <stdio.h>
#include <stdlib.h>

enum { BETA, ENERGY, STEP, INTEGRATOR, OWN };
static const hd_parameter own[OWN] = {
    {"beta", HD_PARAMETER_REAL, NULL, HD_OWN(BETA), 1, 0, 1e3, "from 0 to 1000", "",
     .text = "Strength of the quartic part."},
    {"energy", HD_PARAMETER_REAL, NULL, HD_OWN(ENERGY), 1, 1e-3, 1e3, "from 0.001 to 1000", "",
     .text = "Energy per particle."},
    HD_OWN_TIME_STEP(STEP),
    HD_OWN_INTEGRATOR(INTEGRATOR)};

static int zeros(const hd_scene_def *s) { return s->own[BETA].real == 0 ? 2 * s->number : 4; }
static double growth(const hd_scene_def *s) { return (void)s, 0.2; }

static double force(const hd_scene_def *scene, const double *q, double *f, double *stiffness)
{
    double energy = 0;
    for (int n = scene->number, i = 0; i < n; i++) {
        const int next = i + 1 < n ? i + 1 : 0;
        const double d = q[next] - q[i], bent = scene->own[BETA].real * d * d;
        energy += d * d * (0.5 + 0.25 * bent);
        f[i] += d + bent * d;
        f[next] -= d + bent * d;
        stiffness[i] = 1 + 3 * bent;
    }
    return energy;
}

static void bend(const double *stiffness, double time, const double *restrict dq,
                 double *restrict dp, int n, int width)
{
    for (int i = 0; i < n; i++) {
        const int here = 2 * width * i, next = i + 1 < n ? here + 2 * width : 0;
        for (int k = 0; k < width; k++) {
            const double pull = time * stiffness[i] * (dq[next + k] - dq[here + k]);
            dp[here + k] += pull;
            dp[next + k] -= pull;
        }
    }
}

HD_HAMILTONIAN(of_chain, bend,
               (.kept = 1, .shifts = true, .force = force, .growth = growth,
                .zero_exponents = zeros, .least = 3),
               .particles = "chain", .coordinates = 1, .parameter = own, .parameters = OWN);

int main(int argc, char **argv)
{
    hd_scene_def scene = hd_scene_def_of(&of_chain);
    scene.number = argc > 1 ? atoi(argv[1]) : 16;
    scene.own[BETA].real = argc > 2 ? atof(argv[2]) : 1;
    scene.exponents = HD_EXPONENTS_ALL;
    scene.duration = 2000;
    hd_run *run;
    char message[256] = "out of memory";
    if (hd_run_create(&run, &scene, message, sizeof message) != HD_OK) return puts(message), 2;
    while (hd_run_stage(run) != HD_FINISHED)
        if (hd_run_advance(run) != HD_OK) return puts(hd_status_text(hd_run_status(run))), 3;
    for (int k = 0; k < hd_run_vectors(run); k++)
        printf("%d %.5f\n", k + 1, hd_spectrum_exponent(hd_run_parts(run).spectrum, k));
    hd_run_free(run);
    return 0;
}
