/** Checks of a scene: ranges of parameters, and which of them fit together. */
#include "scene/scene_check.h"

#include <stdbool.h>
#include <stdio.h>

#include "base/check.h"
#include "hdlyap/dynamics.h"
#include "scene/container.h"
#include "scene/ends.h"
#include "scene/fluid.h"
#include "scene/parameters.h"
#include "scene/row_check.h"
#include "scene/scene.h"
#include "scene/wave.h"

enum { SAID = 96, VALUE = 32 }; /* bytes of a container's words, and of a parameter's value */

/** Name of the root of the density that is 1 over the mean distance of two particles. */
static const char *root(const hd_scene_def *def)
{
    return hd_scene_dimension(def) == 2 ? "sqrt" : "cbrt";
}

static hd_status refuse_value(const hd_parameter *row, const hd_scene_def *def, char *message,
                              size_t size)
{
    char value[VALUE];
    return hd_refuse(message, size, "%s = %s: must be %s", row->name,
                     hd_parameter_say(row, def, value, sizeof value), row->range);
}

/** Whether a value is in the range of its own row. The negated comparison refuses NaN, too. */
static bool is_in_range(const hd_parameter *row, double value)
{
    if (row->kind == HD_PARAMETER_SEED || row->kind == HD_PARAMETER_EXPONENTS ||
        row->kind == HD_PARAMETER_TEXT)
        return true;
    if (row->kind == HD_PARAMETER_INTERVAL && hd_parameter_is_word(row, value)) return true;
    return value >= row->min && value <= row->max;
}

static hd_status check_ranges(const hd_scene_def *def, char *message, size_t size)
{
    const hd_parameter *row;
    for (int k = 0; (row = hd_parameter_of(def, k)); k++)
        if (!is_in_range(row, hd_parameter_value(row, def)))
            return refuse_value(row, def, message, size);
    return HD_OK;
}

/** What makes particles others than their name says. */
static const char *second_kind(const hd_dynamics *of)
{
    return of->mixture == of ? " of a second kind" : "";
}

/** Refuses parameters of z for particles in the plane, and a curved wall for those in space. */
static hd_status check_particles(const hd_scene_def *def, char *message, size_t size)
{
    const hd_scene_def usual = hd_scene_def_default();
    const hd_dynamics *of = hd_dynamics_of(def);
    const bool flat = of->dimension == 2;
    const double densest = of->fluid ? of->fluid->density_max : 1.4142135623730951;
    if (of->dimension > 0 && def->density > densest)
        return hd_refuse(message, size,
                         "density = %.15g: must be from 1e-6 to %.5g with particles = %s%s",
                         def->density, densest, of->particles, second_kind(of));
    if (flat && def->aspect_z != usual.aspect_z)
        return hd_refuse(message, size, "aspect_z = %.15g: must not be given with particles = %s",
                         def->aspect_z, of->particles);
    if (flat && def->boundary[2] != usual.boundary[2])
        return hd_refuse(message, size, "boundary_z = %s: must not be given with particles = %s",
                         hd_ends_of(def->boundary[2])->word, of->particles);
    if (!flat && hd_container_of(def)->wall)
        return hd_refuse(message, size,
                         "container = %s: must be rectangle, a box, with particles = %s",
                         hd_container_name(def), of->particles);
    return HD_OK;
}

/** Refuses boundaries and an aspect in a container with a curved wall. */
static hd_status check_curved(const hd_scene_def *def, char *message, size_t size)
{
    const hd_scene_def usual = hd_scene_def_default();
    const char *name = hd_container_name(def);
    for (int d = 0; d < 2; d++)
        if (def->boundary[d] != usual.boundary[d])
            return hd_refuse(message, size,
                             "boundary_%c = %s: must not be given with container = %s, whose wall "
                             "reflects",
                             "xy"[d], hd_ends_of(def->boundary[d]) -> word, name);
    return HD_OK;
}

/** Refuses walls that these particles cannot meet, and walls that drag unless all other directions
 * are periodic. */
static hd_status check_walls(const hd_scene_def *def, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    for (int d = 0; d < of->dimension; d++) {
        const hd_boundary ends = def->boundary[d];
        const char *word = hd_ends_of(ends)->word;
        if (ends > HD_REFLECTING && !(of->ends >> ends & 1u))
            return hd_refuse(message, size,
                             "boundary_%c = %s: must not be given with particles = %s%s", "xyz"[d],
                             word, of -> particles, second_kind(of));
        for (int e = 0; e < of->dimension; e++)
            if (hd_ends_of(ends)->drags && e != d && def->boundary[e] != HD_PERIODIC)
                return hd_refuse(message, size,
                                 "boundary_%c = %s: must be periodic with boundary_%c = %s",
                                 "xyz"[e], hd_ends_of(def->boundary[e]) -> word, "xyz"[d], word);
    }
    return HD_OK;
}

/** Refuses parameters of a box if the dynamics has no box. */
static hd_status check_without_box(const hd_scene_def *def, char *message, size_t size)
{
    const hd_scene_def usual = hd_scene_def_default();
    const char *particles = hd_dynamics_of(def)->particles;
    char value[VALUE];
    const hd_parameter *row;
    for (int k = 0; (row = hd_parameter_of(def, k)); k++)
        if (hd_parameter_is_of_box(row) && !hd_parameter_same(row, def, &usual))
            return hd_refuse(message, size, HD_WITHOUT_BOX, row->name,
                             hd_parameter_say(row, def, value, sizeof value), particles);
    return HD_OK;
}

hd_status hd_scene_check_box(const hd_scene_def *def, char *message, size_t size)
{
    HD_TRY(check_ranges(def, message, size));
    HD_TRY(hd_row_check_kinds(def, message, size));
    if (hd_scene_dimension(def) == 0) return check_without_box(def, message, size);
    HD_TRY(check_particles(def, message, size));
    if (!hd_container_of(def)->wall) HD_TRY(check_walls(def, message, size));
    HD_TRY(hd_container_of(def)->check(def, message, size));
    return hd_container_of(def)->wall ? check_curved(def, message, size) : HD_OK;
}

/** Refuses waves that are too short to be sampled by the particles. */
static hd_status check_waves(const hd_scene_def *def, char *message, size_t size)
{
    const hd_wave_limits limits = hd_wave_limits_of(def);
    char said[SAID];
    hd_container_of(def)->say(def, said, sizeof said);
    if (def->max_wave_number > 0 && def->max_mode_number > 0)
        return hd_refuse(message, size,
                         "max_mode_number = %d: must be 0 when max_wave_number = %.15g is given",
                         def->max_mode_number, def->max_wave_number);
    if (def->max_mode_number > limits.node)
        return hd_refuse(
            message, size,
            "max_mode_number = %d: must be at most %d with number = %d, density = %.15g, %s: waves "
            "shorter than two mean distances of particles, 2 / %s(density), are not looked for",
            def->max_mode_number, limits.node, def->number, def->density, said, root(def));
    const double k = def->max_wave_number;
    if (k > 0 && !(k >= limits.smallest && k <= limits.largest))
        return hd_refuse(
            message, size,
            "max_wave_number = %.15g: must be 0 or from %.6g, that of the longest wave, to "
            "%.6g: waves shorter than two mean distances of particles, 2 / %s(density), are not "
            "looked for",
            k, limits.smallest, limits.largest, root(def));
    return HD_OK;
}

/** What makes maps not symplectic, in words: particles, or walls. */
static const char *unpaired(const hd_scene_def *def, char said[SAID])
{
    const hd_dynamics *of = hd_dynamics_of(def);
    snprintf(said, SAID, "particles = %s", of->particles);
    for (int d = 0; d < of->dimension && of->symplectic; d++) {
        const hd_ends *ends = hd_ends_of(hd_scene_boundary(def, d));
        if (!ends->symplectic) snprintf(said, SAID, "boundary_%c = %s", "xyz"[d], ends -> word);
    }
    return said;
}

/** Refuses what needs exponents in pairs of opposite sign if the maps are not symplectic. */
static hd_status check_pairs(const hd_scene_def *def, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    if (hd_scene_symplectic(def) || def->exponents != HD_EXPONENTS_POSITIVE) return HD_OK;
    return hd_refuse(message, size,
                     "exponents = positive: must be all, all_independent, none or from 1 to %d "
                     "with %s, whose exponents are not in pairs of opposite sign",
                     2 * of->coordinates * def->number, unpaired(def, (char[SAID]){""}));
}

hd_status hd_scene_check_start(const hd_scene_def *def, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    HD_TRY(hd_dynamics_check(of, message, size));
    const int each = 2 * of->coordinates;
    HD_TRY(hd_scene_check_box(def, message, size));
    if (def->exponents < HD_EXPONENTS_ALL_INDEPENDENT || def->exponents > each * def->number)
        return hd_refuse(
            message, size,
            "exponents = %d: must be positive, all, all_independent, none or from 1 to %d N = %d",
            def->exponents, each, each * def->number);
    if (def->exponents == HD_EXPONENTS_POSITIVE && hd_scene_vectors(def) == 0)
        return hd_refuse(message, size,
                         "exponents = positive: must be all, all_independent, none or from 1 to %d "
                         "with number = %d, where no exponent is positive",
                         each * def->number, def->number);
    HD_TRY(check_pairs(def, message, size));
    if (of->dimension > 0) HD_TRY(check_waves(def, message, size));
    if (of->check) HD_TRY(of->check(def, message, size));
    return hd_row_check_numbers(def, message, size);
}
