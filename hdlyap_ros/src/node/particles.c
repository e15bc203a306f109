/** Finds rows of dynamics by their names. */
#include "particles.h"

#include <stdio.h>
#include <string.h>

#include "hdlyap/parameters.h"

static const hd_dynamics *const *brought;
static int brought_count;
static const hd_dynamics *now; /* NULL: none is chosen yet */

bool particles_check(const hd_dynamics *const *rows, int count, char *message, size_t size)
{
    char line[256];
    for (int k = 0; k < count; k++) {
        if (hd_dynamics_check(rows[k], line, sizeof line) == HD_OK) continue;
        snprintf(message, size, "row %d of this program's dynamics: %s", k, line);
        return false;
    }
    return true;
}

void particles_register(const hd_dynamics *const *rows, int count)
{
    brought = rows;
    brought_count = count;
}

const hd_dynamics *const *particles_brought(int *count)
{
    *count = brought_count;
    return brought;
}

static const hd_dynamics *brought_named(const char *name)
{
    for (int k = 0; k < brought_count; k++)
        if (strcmp(brought[k]->particles, name) == 0) return brought[k];
    return NULL;
}

hd_scene_def particles_usual(void)
{
    return brought_count > 0 ? hd_scene_def_of(brought[0]) : hd_scene_def_default();
}

/** The row of the core's own. */
static const hd_parameter *row_of_core(void)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    while (row->offset != offsetof(hd_scene_def, particles)) row++;
    return row;
}

const hd_dynamics *particles_at(int k)
{
    const int core = (int)row_of_core()->max + 1;
    if (k >= core) return k - core < brought_count ? brought[k - core] : NULL;
    const hd_scene_def scene = {.particles = (hd_particles)k};
    return hd_dynamics_of(&scene);
}

bool particles_choose(hd_scene_def *def, const char *name)
{
    const hd_dynamics *before = hd_dynamics_of(def), *of = brought_named(name);
    int core = HD_DISKS;
    if (!of && !hd_parameter_value_of(&core, row_of_core(), name)) return false;
    def->dynamics = of;
    def->particles = (hd_particles)core;
    of = hd_dynamics_of(def);
    if (of != before) def->exponents = hd_scene_def_of(of).exponents;
    for (int k = 0; of != before && k < of->parameters; k++)
        hd_parameter_assign(&of->parameter[k], def, of->parameter[k].default_value);
    return true;
}

void particles_are(const hd_dynamics *of) { now = of; }

const hd_dynamics *particles_now(void)
{
    const hd_scene_def usual = particles_usual();
    return now ? now : hd_dynamics_of(&usual);
}

void particles_names(char *text, size_t size)
{
    int length = snprintf(text, size, "%s", row_of_core()->range);
    for (int k = 0; k < brought_count && (size_t)length < size; k++)
        length += snprintf(text + length, size - (size_t)length, " or %s", brought[k]->particles);
}
