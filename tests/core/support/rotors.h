/** A ring of rotors, H = sum p_i^2 / 2 + 1 - cos(q_(i+1) - q_i), by its forces. */
#ifndef HD_ROTORS_H
#define HD_ROTORS_H

#include <hdlyap/hdlyap.h>
#include <math.h>

static const hd_parameter rotors_own[] = {{"energy", HD_PARAMETER_REAL, NULL, HD_OWN(0), 1, 1e-3,
                                           1e3, "from 0.001 to 1000", "",
                                           .text = "Energy per particle."}};

static double rotors_force(const hd_scene_def *scene, const double *q, double *f, double *kept)
{
    double energy = 0;
    for (int i = 0; i < scene->number; i++) {
        const int next = (i + 1) % scene->number;
        f[i] += sin(q[next] - q[i]);
        f[next] -= sin(q[next] - q[i]);
        energy += 1 - (kept[i] = cos(q[next] - q[i]));
    }
    return energy;
}

static void rotors_bend(const double *kept, double time, const double *restrict dq,
                        double *restrict dp, int n, int width)
{
    for (int i = 0; i < n; i++) {
        const int here = 2 * width * i, next = 2 * width * ((i + 1) % n);
        for (int k = 0; k < width; k++) {
            const double pull = time * kept[i] * (dq[next + k] - dq[here + k]);
            dp[here + k] += pull;
            dp[next + k] -= pull;
        }
    }
}

static double rotors_growth(const hd_scene_def *scene) { return (void)scene, 0.2; }
HD_HAMILTONIAN(of_rotors, rotors_bend,
               (.kept = 1, .shifts = true, .force = rotors_force, .growth = rotors_growth),
               .particles = "rotors", .coordinates = 1, .parameter = rotors_own, .parameters = 1);

#endif
