/** Row of dynamics -> one line that names the member which cannot be right. */
#include "scene/row_check.h"

#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "scene/dynamics.h"
#include "scene/scene.h"

/** Most collisions of a particle, and entries of its, per time unit, and least ones: simulated time
 * moves by 1e-12 or more, so that a rate far beyond them is an unending run. */
static const double RATE_MOST = 1e9, RATE_LEAST = 1e-9;

/* ---- members ------------------------------------------------------------------------------- */

/** Refuses a row that lacks a member. */
static hd_status check_there(const hd_dynamics *row, char *message, size_t size)
{
#define THERE(member)                                                                              \
    {                                                                                              \
#member, row->member                                                                       \
    }
    const struct {
        const char *member;
        bool there;
    } needed[] = {THERE(record_rate), THERE(collision_rate), THERE(create),
                  THERE(free),        THERE(advance),        THERE(time),
                  THERE(state),       THERE(archive),        THERE(carry)};
#undef THERE
    for (size_t k = 0; k < sizeof needed / sizeof *needed; k++)
        if (!needed[k].there)
            return hd_refuse(message, size, "%s: must not be NULL", needed[k].member);
    return HD_OK;
}

/** Refuses a row with a member that needs another one. */
static hd_status check_together(const hd_dynamics *row, char *message, size_t size)
{
    const bool maps = row->maps_create || row->maps_free || row->maps_fill;
    const struct {
        const char *line;
        bool wrong;
    } together[] = {
        {"maps_create: must not be NULL unless maps_free and maps_fill are", !row->maps_create},
        {"maps_free: must not be NULL unless maps_create and maps_fill are", !row->maps_free},
        {"maps_fill: must not be NULL unless maps_create and maps_free are", !row->maps_fill},
        {"totals: must not be NULL if collides is true", row->collides && !row->totals},
        {"inertia: must be NULL unless dimension is 2 and coordinates are 3",
         row->inertia && (row->dimension != 2 || row->coordinates != 3)},
        {"energy_asked: must be NULL without examine, which tells the error of the energy",
         row->energy_asked && !row->examine},
        {"measure: must not be NULL with averages", row->averages != 0 && !row->measure},
        {"measure: must be NULL without averages", row->averages == 0 && row->measure},
        {"kinds: must not be NULL with mixture", row->mixture && !row->kinds},
        {"null_vectors: must be NULL without zero_exponents",
         row->null_vectors && !row->zero_exponents}};
    for (size_t k = maps ? 0 : 3; k < sizeof together / sizeof *together; k++)
        if (together[k].wrong) return hd_refuse(message, size, "%s", together[k].line);
    return HD_OK;
}

static hd_status check_name(const hd_dynamics *row, char *message, size_t size)
{
    const char *name = row->particles;
    if (!name) return hd_refuse(message, size, "particles: must not be NULL");
    const void *end = memchr(name, 0, HD_PARTICLES); /* it may have none */
    if (!end || !*name)
        return hd_refuse(message, size, "particles = %.*s: must have from 1 to %d characters",
                         HD_PARTICLES, name, HD_PARTICLES - 1);
    for (int k = HD_DISKS; k < HD_PARTICLES_END; k++) {
        const hd_scene_def scene = {.particles = (hd_particles)k};
        const hd_dynamics *core = hd_dynamics_of(&scene);
        if (row != core && row != core->mixture && strcmp(core->particles, name) == 0)
            return hd_refuse(message, size, "particles = %s: must not be those of the core", name);
    }
    return HD_OK;
}

static hd_status check_sizes(const hd_dynamics *row, char *message, size_t size)
{
    if (row->dimension != 0 && row->dimension != 2 && row->dimension != 3)
        return hd_refuse(message, size, "dimension = %d: must be 0, 2 or 3", row->dimension);
    const int least = row->dimension > 0 ? row->dimension : 1;
    if (row->coordinates < least || row->coordinates > HD_COORDINATES_MAX)
        return hd_refuse(message, size,
                         "coordinates = %d: must be from %d to %d with dimension = %d",
                         row->coordinates, least, HD_COORDINATES_MAX, row->dimension);
    if (row->entry == 0 || row->entry % sizeof(double) != 0)
        return hd_refuse(message, size,
                         "entry = %zu: must be a multiple of %zu, because an entry consists of "
                         "doubles and begins with its time",
                         row->entry, sizeof(double));
    return HD_OK;
}

/* ---- parameters ---------------------------------------------------------------------------- */

/** Whether the default is a number that the parameter's member can hold. */
static bool holds_default(const hd_parameter *p)
{
    const bool whole = p->kind == HD_PARAMETER_INT || p->kind == HD_PARAMETER_WORD;
    return whole ? p->default_value >= INT_MIN && p->default_value <= INT_MAX
                 : isfinite(p->default_value);
}

/** Returns what is wrong with a parameter by itself; NULL: nothing. */
static const char *parameter_fault(const hd_parameter *p)
{
    const bool word = p->kind == HD_PARAMETER_WORD;
    const struct {
        const char *fault;
        bool wrong;
    } faults[] = {
        {"name: must not be NULL", !p->name},
        {"name: must not be empty", p->name && !*p->name},
        {"range: must not be NULL", !p->range},
        {"unit: must not be NULL; \"\" is none", !p->unit},
        {"text: must not be NULL", !p->text},
        {"kind: must be HD_PARAMETER_INT, _REAL, _WORD or _INTERVAL",
         !word && p->kind != HD_PARAMETER_INT && p->kind != HD_PARAMETER_REAL &&
             p->kind != HD_PARAMETER_INTERVAL},
        {"words: must not be NULL for HD_PARAMETER_WORD", word && !p->words},
        {"offset: must be HD_OWN(k), k = 0 .. 15",
         p->offset < HD_OWN(0) || p->offset >= HD_OWN(HD_OWN_MAX) ||
             (p->offset - HD_OWN(0)) % sizeof(hd_own) != 0},
        {"default_value: must be a number that the parameter can hold", !holds_default(p)},
        {"live: must be false", p->live}};
    for (size_t k = 0; k < sizeof faults / sizeof *faults; k++)
        if (faults[k].wrong) return faults[k].fault;
    return NULL;
}

/** Refuses parameter k if its name or place has been given before. */
static hd_status check_taken(const hd_dynamics *row, int k, char *message, size_t size)
{
    const hd_parameter *p = row->parameter;
    int count;
    const hd_parameter *core = hd_scene_parameters(&count);
    for (int c = 0; c < count; c++)
        if (strcmp(core[c].name, p[k].name) == 0)
            return hd_refuse(
                message, size,
                "parameter[%d].name = %s: must not be that of a parameter of all scenes", k,
                p[k].name);
    for (int before = 0; before < k; before++) {
        if (strcmp(p[before].name, p[k].name) == 0)
            return hd_refuse(message, size,
                             "parameter[%d].name = %s: must not be that of parameter[%d]", k,
                             p[k].name, before);
        if (p[before].offset == p[k].offset)
            return hd_refuse(message, size,
                             "parameter[%d].offset: must not be that of parameter[%d]", k, before);
    }
    return HD_OK;
}

static hd_status check_parameters(const hd_dynamics *row, char *message, size_t size)
{
    if (row->parameters < 0 || row->parameters > HD_OWN_MAX)
        return hd_refuse(message, size, "parameters = %d: must be from 0 to %d", row->parameters,
                         HD_OWN_MAX);
    if (row->parameters > 0 && !row->parameter)
        return hd_refuse(message, size, "parameter: must not be NULL with parameters = %d",
                         row->parameters);
    for (int k = 0; k < row->parameters; k++) {
        const char *fault = parameter_fault(&row->parameter[k]);
        if (fault) return hd_refuse(message, size, "parameter[%d].%s", k, fault);
        HD_TRY(check_taken(row, k, message, size));
    }
    return HD_OK;
}

/* ---- averages ------------------------------------------------------------------------------ */

/** Whether a name is a letter, and then letters, digits and _, as many as a target can name. */
static bool is_word(const char *name)
{
    const char *const letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    const size_t length = strspn(name, letters);
    return length > 0 && length < HD_AVERAGE_NAME && !name[length] && *name != '_' &&
           !(*name >= '0' && *name <= '9');
}

/** Refuses average k if its name is that of another one, or of a parameter. */
static hd_status check_name_of_average(const hd_dynamics *row, int k, char *message, size_t size)
{
    const char *name = row->average[k].name;
    int count;
    const hd_parameter *core = hd_scene_parameters(&count);
    bool taken = false;
    for (int c = 0; c < count; c++) taken |= strcmp(core[c].name, name) == 0;
    for (int c = 0; c < row->parameters; c++) taken |= strcmp(row->parameter[c].name, name) == 0;
    if (taken)
        return hd_refuse(message, size, "average[%d].name = %s: must not be that of a parameter", k,
                         name);
    for (int before = 0; before < k; before++)
        if (strcmp(row->average[before].name, name) == 0)
            return hd_refuse(message, size,
                             "average[%d].name = %s: must not be that of average[%d]", k, name,
                             before);
    return HD_OK;
}

static hd_status check_averages(const hd_dynamics *row, char *message, size_t size)
{
    const hd_average *average = row->average;
    if (row->averages < 0 || row->averages > HD_AVERAGES_MAX)
        return hd_refuse(message, size, "averages = %d: must be from 0 to %d", row->averages,
                         HD_AVERAGES_MAX);
    if (row->averages > 0 && !average)
        return hd_refuse(message, size, "average: must not be NULL with averages = %d",
                         row->averages);
    for (int k = 0; k < row->averages; k++) {
        if (!average[k].name)
            return hd_refuse(message, size, "average[%d].name: must not be NULL", k);
        if (!is_word(average[k].name))
            return hd_refuse(message, size,
                             "average[%d].name = %.40s: must be a letter, then letters, digits and "
                             "_, at most %d",
                             k, average[k].name, HD_AVERAGE_NAME - 1);
        if (!average[k].unit)
            return hd_refuse(message, size, "average[%d].unit: must not be NULL; \"\" is none", k);
        HD_TRY(check_name_of_average(row, k, message, size));
    }
    return HD_OK;
}

hd_status hd_dynamics_check(const hd_dynamics *row, char *message, size_t size)
{
    if (!row) return hd_refuse(message, size, "dynamics: must not be NULL");
    HD_TRY(check_name(row, message, size));
    HD_TRY(check_sizes(row, message, size));
    HD_TRY(check_there(row, message, size));
    HD_TRY(check_together(row, message, size));
    HD_TRY(check_parameters(row, message, size));
    return check_averages(row, message, size);
}

/* ---- numbers of a scene -------------------------------------------------------------------- */

static hd_status check_zeros(const hd_scene_def *scene, char *message, size_t size)
{
    const int zeros = hd_scene_zero_exponents(scene),
              all = 2 * hd_scene_coordinates(scene) * scene->number;
    if (zeros < 0 || zeros > all)
        return hd_refuse(message, size, "zero_exponents = %d: must be from 0 to %d, all exponents",
                         zeros, all);
    if (zeros % 2 != 0 && hd_scene_symplectic(scene))
        return hd_refuse(message, size,
                         "zero_exponents = %d: must be even, because exponents of symplectic maps "
                         "come in pairs",
                         zeros);
    return HD_OK;
}

static hd_status check_rates(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    const double least = RATE_LEAST * scene->number, most = RATE_MOST * scene->number;
    const struct {
        const char *name;
        double rate;
    } rates[] = {{"record_rate", of->record_rate(scene)},
                 {"collision_rate", of->collision_rate(scene)}};
    for (size_t k = 0; k < sizeof rates / sizeof *rates; k++)
        if (!(rates[k].rate >= least && rates[k].rate <= most))
            return hd_refuse(message, size, "%s = %.15g: must be from %g to %g with number = %d",
                             rates[k].name, rates[k].rate, least, most, scene->number);
    return HD_OK;
}

/** Refuses what is neither left out nor a positive number. */
static hd_status check_positive(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
#define NUMBER(member)                                                                             \
    {                                                                                              \
#member, of->member ? of->member(scene) : 1.0                                              \
    }
    const struct {
        const char *name;
        double number;
    } numbers[] = {NUMBER(step), NUMBER(energy_asked),        NUMBER(speed),
                   NUMBER(size), NUMBER(sound_crossing_time), NUMBER(inertia),
                   NUMBER(bytes)};
#undef NUMBER
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        if (!(numbers[k].number > 0 && isfinite(numbers[k].number)))
            return hd_refuse(message, size, "%s = %.15g: must be above 0, and finite",
                             numbers[k].name, numbers[k].number);
    return HD_OK;
}

static hd_status check_sites(const hd_scene_def *scene, char *message, size_t size)
{
    double site[HD_SITES_MAX];
    const int count = hd_scene_sites(scene, site);
    if (count < 1 || count > HD_SITES_MAX)
        return hd_refuse(message, size, "sites = %d: must be from 1 to %d", count, HD_SITES_MAX);
    for (int k = 0; k < count; k++)
        if (!isfinite(site[k]) || (k > 0 && !(site[k] >= site[k - 1])))
            return hd_refuse(message, size, "sites: site[%d] = %g: must be %s", k, site[k],
                             "finite, and not below the one before it");
    return HD_OK;
}

hd_status hd_row_check_kinds(const hd_scene_def *scene, char *message, size_t size)
{
    hd_kind kind[HD_KINDS_MAX] = {{0}};
    if (!scene->dynamics) return HD_OK;
    const int count = hd_scene_kinds(scene, kind);
    if (count < 1 || count > HD_KINDS_MAX)
        return hd_refuse(message, size, "kinds = %d: must be from 1 to %d", count, HD_KINDS_MAX);
    for (int k = 0, left = scene->number; k < count; k++) {
        const hd_kind *one = &kind[k];
        const bool all = k == count - 1, some = one->number >= 1 && one->number <= left;
        left -= some ? one->number : 0;
        if (!some || (left == 0) != all || !(one->diameter > 0 && isfinite(one->diameter)) ||
            !(one->mass > 0 && isfinite(one->mass)))
            return hd_refuse(message, size,
                             "kinds: kind[%d] = {%d, %g, %g}: must be above 0 and finite, with "
                             "number = %d particles in all",
                             k, one->number, one->diameter, one->mass, scene->number);
    }
    return HD_OK;
}

hd_status hd_row_check_numbers(const hd_scene_def *scene, char *message, size_t size)
{
    if (!scene->dynamics)
        return HD_OK;              /* those of the core are in order, and have their own limits */
    hd_scene_def settled = *scene; /* a time step that is found by a trial is found once */
    hd_scene_settle(&settled);
    HD_TRY(check_zeros(&settled, message, size));
    HD_TRY(check_rates(&settled, message, size));
    HD_TRY(check_positive(&settled, message, size));
    return check_sites(&settled, message, size);
}
