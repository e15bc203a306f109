/** Scenes of two kinds of disks or spheres. */
#ifndef MIXED_H
#define MIXED_H

#include "testing.h"

/** 100 of them. */
static inline hd_scene_def mixed(hd_particles particles, double density, double fraction,
                                 double diameter, double mass)
{
    hd_scene_def def = hd_scene_def_of(hd_dynamics_of(&(hd_scene_def){.particles = particles}));
    static const char *const names[] = {"second_fraction", "second_diameter", "second_mass"};
    const double values[] = {fraction, diameter, mass};
    const hd_dynamics *of = hd_dynamics_of(&def);
    def.number = 100;
    def.density = density;
    for (int k = 0; k < of->parameters; k++)
        for (int n = 0; n < 3; n++)
            if (strcmp(of->parameter[k].name, names[n]) == 0)
                hd_parameter_assign(&of->parameter[k], &def, values[n]);
    return def;
}

#endif
