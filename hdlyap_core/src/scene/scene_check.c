/** What can be asked for: ranges, and what fits together. */
#include "scene/scene_check.h"

#include <math.h>
#include <stdbool.h>

#include "base/check.h"
#include "hdlyap/wave.h"
#include "scene/lattice.h"

/** Room between walls beyond a diameter: less is crossed more often than there are times to tell
 * apart. It is 1e-9 but for the rounding of an edge that density and aspect give. */
static const double ROOM_MIN = 0.999e-9;

typedef struct range {
    const char *name, *allowed;
    double value, min, max;
} range;

/** The negated comparisons refuse NaN too. */
static hd_status check_table(const range *table, size_t count, char *message, size_t size)
{
    for (size_t k = 0; k < count; k++) {
        const range *r = &table[k];
        if (r->value >= r->min && r->value <= r->max) continue;
        return hd_refuse(message, size, "%s = %.15g: must be %s", r->name, r->value, r->allowed);
    }
    return HD_OK;
}

static const double huge = 1e12;

static hd_status check_ranges(const hd_scene_def *def, char *message, size_t size)
{
    const range table[] = {
        {"disks", "an integer from 2 to 1000000", def->disks, HD_DISKS_MIN, HD_DISKS_MAX},
        {"density", "from 1e-6 to 2/sqrt(3) = 1.1547", def->density, 1e-6, 2.0 / sqrt(3.0)},
        {"aspect", "from 1e-6 to 1e6", def->aspect, 1e-6, 1e6},
        {"boundary_x", "periodic or reflecting", def->boundary[0], HD_PERIODIC, HD_REFLECTING},
        {"boundary_y", "periodic or reflecting", def->boundary[1], HD_PERIODIC, HD_REFLECTING},
        {"equilibration", "from 0 to 1e12", def->equilibration, 0, huge},
        {"warmup", "from 0 to 1e12", def->warmup, 0, huge},
        {"duration", "from 0 (until stopped) to 1e12", def->duration, 0, huge},
        {"target_std_error", "from 0 (off) to 1e12", def->target_std_error, 0, huge},
        {"interval", "auto, or from 1e-6 to 1e12", def->interval, def->interval == 0 ? 0 : 1e-6,
         huge},
        {"accuracy", "from 1e-12 to 1e-2", def->accuracy, 1e-12, 1e-2},
        {"report_interval", "from 1e-6 to 1e12", def->report_interval, 1e-6, huge},
        {"max_wave_number", "0 (by max_mode_number) or above", def->max_wave_number, 0, huge},
        {"max_mode_number", "from 0 (automatic) to 1000000", def->max_mode_number, 0, HD_DISKS_MAX},
        {"observe", "a set of HD_OBSERVE_*", def->observe, 0, HD_OBSERVE_ALL},
        {"threads", "from 0 (all cores) to 1024", def->threads, 0, HD_THREADS_MAX},
    };
    return check_table(table, sizeof table / sizeof *table, message, size);
}

static bool is_wide_enough(const hd_scene_def *def, int d, double edge)
{
    return def->boundary[d] == HD_REFLECTING ? edge - 1.0 >= ROOM_MIN : edge > 1.0;
}

hd_status hd_scene_check_box(const hd_scene_def *def, char *message, size_t size)
{
    double box[2];
    HD_TRY(check_ranges(def, message, size));
    hd_scene_box(def, box);
    for (int d = 0; d < 2; d++)
        if (!is_wide_enough(def, d, box[d]))
            return hd_refuse(
                message, size,
                "density = %.15g with disks = %d, aspect = %.15g: the box edge L%c = %.15g "
                "must be above the disk diameter 1%s",
                def->density, def->disks, def->aspect, "xy"[d], box[d],
                def -> boundary[d] == HD_REFLECTING ? " by 1e-9" : "");
    return HD_OK;
}

/** Waves that the disks do not sample have no fields. */
static hd_status check_waves(const hd_scene_def *def, char *message, size_t size)
{
    const hd_wave_limits limits = hd_wave_limits_of(def);
    if (def->max_wave_number > 0 && def->max_mode_number > 0)
        return hd_refuse(message, size,
                         "max_mode_number = %d: must be 0 when max_wave_number = %.15g is given",
                         def->max_mode_number, def->max_wave_number);
    if (def->max_mode_number > limits.node)
        return hd_refuse(
            message, size,
            "max_mode_number = %d: must be at most %d with disks = %d, density = %.15g, aspect = "
            "%.15g and these boundaries: a shorter wave than two mean distances, "
            "2 / sqrt(density), is not sampled",
            def->max_mode_number, limits.node, def->disks, def->density, def->aspect);
    const double k = def->max_wave_number;
    if (k > 0 && !(k >= limits.smallest && k <= limits.largest))
        return hd_refuse(
            message, size,
            "max_wave_number = %.15g: must be from %.6g, the longest wave of this box, to %.6g: "
            "a shorter one than two mean distances, 2 / sqrt(density), is not sampled",
            k, limits.smallest, limits.largest);
    return HD_OK;
}

/** What covariant vectors need, where they are asked for. */
static hd_status check_covariant(const hd_scene_def *def, char *message, size_t size)
{
    const double window = def->covariant_window, transient = def->covariant_transient;
    const range table[] = {
        {"covariant_window", "from 1e-6 to 1e12", window, 1e-6, huge},
        {"covariant_transient", "from 1e-6 to 1e12", transient, 1e-6, huge},
        {"covariant_sampling", "from 1e-6 to covariant_window", def->covariant_sampling, 1e-6,
         window},
        {"covariant_memory", "from 1e6 to 1e15 bytes", def->covariant_memory, 1e6, 1e15},
        {"covariant_storage", "one of HD_STORAGE_*", def->covariant_storage, HD_STORAGE_MEMORY,
         HD_STORAGE_RECOMPUTE},
    };
    if (!(def->observe & HD_OBSERVE_COVARIANT)) return HD_OK;
    HD_TRY(check_table(table, sizeof table / sizeof *table, message, size));
    if (!(def->warmup >= transient))
        return hd_refuse(message, size,
                         "warmup = %.15g: must be at least covariant_transient = %.15g: vectors "
                         "converge forwards no "
                         "faster than backwards",
                         def->warmup, transient);
    if (def->duration > 0 && !(def->duration >= window + transient))
        return hd_refuse(message, size,
                         "duration = %.15g: must be 0 or at least covariant_window + "
                         "covariant_transient = %.15g",
                         def->duration, window + transient);
    return HD_OK;
}

hd_status hd_scene_check(const hd_scene_def *def, char *message, size_t size)
{
    double box[2];
    HD_TRY(hd_scene_check_box(def, message, size));
    hd_scene_box(def, box);
    if (def->exponents < HD_EXPONENTS_ALL || def->exponents > 4 * def->disks)
        return hd_refuse(message, size,
                         "exponents = %d: must be positive, all, none or from 1 to 4 disks = %d",
                         def->exponents, 4 * def->disks);
    HD_TRY(check_waves(def, message, size));
    HD_TRY(check_covariant(def, message, size));
    if (hd_lattice_best(def->disks, box, def->boundary).distance < HD_LATTICE_DISTANCE_MIN)
        return hd_refuse(
            message, size,
            "density = %.15g: must be at most %.6g with disks = %d, aspect = %.15g and "
            "these boundaries (densest start lattice)",
            def->density, hd_lattice_density_max(def), def->disks, def->aspect);
    return HD_OK;
}
