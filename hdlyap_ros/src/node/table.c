/** Run -> lines of the log: averages, a row for each step, results of the fits. */
#include "table.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "common/numbers.h"
#include "clock.h"
#include "hdlyap_ros/messages.h"
#include "topics/progress.h"

enum { TEXT = 64 };

/** Share of long boxes in the curvature from which on it counts as assumed, as in hdlyap plot. */
static const double ASSUMED = 0.995;

/** True for steps of the positive half, without the zero modes. */
static bool in_table(const hd_step *step)
{
    return step->resolved && step->kind != HD_MODE_ZERO && !step->conjugate;
}

static void print_step(const hd_step *step, const hd_scene_def *def)
{
    char name[2 * TEXT], nodes[NODES_SIZE], indices[TEXT], exponent[TEXT];
    const bool alone = step->sharing == HD_SHARING_ALONE;
    snprintf(name, sizeof name, "%s%s", hdr_step_kind_text(step->kind),
             settings_write_nodes(nodes, def, &step->wave));
    const int printed = snprintf(indices, sizeof indices, "%d", step->col + 1);
    if (step->count > 1)
        snprintf(indices + printed, sizeof indices - (size_t)printed, "-%d",
                 step->col + step->count);
    number_with_error(exponent, sizeof exponent, step->exponent, step->std_error);
    hdr_log(HDR_INFO, "  %-10s %-11s %8.2f %3d %12.5f %13s%s%s", name, indices, step->multiplicity,
            step->expected, step->wave.number, exponent, alone ? "" : "  ",
            alone ? "" : hdr_step_sharing_text(step->sharing));
}

/** Prints a result of a fit over `count` wave numbers or phases, and what of it is assumed. */
static void print_fit(const char *name, const char *number, int count, const char *of, double from,
                      double to, bool assumed)
{
    char range[TEXT];
    if (count == 0) return;
    const int printed = snprintf(range, sizeof range, from < to ? "k from %.4g" : "k = %.4g", from);
    if (from < to) snprintf(range + printed, sizeof range - (size_t)printed, " to %.4g", to);
    hdr_log(HDR_INFO, "  %-4s %s over %d %s%s, %s%s", name, number, count, of, count > 1 ? "s" : "",
            range, assumed ? ", curvature assumed" : "");
}

static void print_fits(const hd_run *run, const hd_steps *steps)
{
    static const struct {
        const char *name;
        hd_mode_kind kind;
    } fits[] = {{"c_T", HD_MODE_T}, {"c_L", HD_MODE_LP}};
    char number[TEXT];
    for (int k = 0; k < 2; k++) {
        const hd_dispersion fit = hd_steps_dispersion(steps, hd_run_parts(run).spectrum,
                                                      fits[k].kind);
        number_of_fit(number, sizeof number, fit.c.value, fit.c.error, fit.misfit);
        print_fit(fits[k].name, number, fit.points, "wave number", fit.k_min, fit.k_max,
                  fit.prior_share >= ASSUMED);
    }
    const hd_phases *phases = hd_run_parts(run).phases;
    if (!phases) return;
    const hd_velocity v = hd_phases_velocity(phases);
    number_of_fit(number, sizeof number, v.v, v.v_error, v.misfit);
    print_fit("v", number, v.phases, "LP phase", v.k_min, v.k_max, false);
}

/** Prints the steps, the smallest exponent first. */
static void print_steps(const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    const int count = steps ? hd_steps_count(steps) : 0;
    int missing = 0, found = 0;
    for (int k = 0; k < count; k++) {
        const hd_step *step = hd_steps_step(steps, k);
        missing += !step->resolved && step->kind != HD_MODE_ZERO && !step->conjugate;
        found += in_table(step);
    }
    if (found == 0) return;
    hdr_log(HDR_INFO, "  %-10s %-11s %8s %3s %12s %13s", "step", "indices", "found", "of",
            "k [1/sigma]", "exponent");
    for (int col = hd_run_vectors(run) - 1; col >= 0; col--)
        for (int k = 0; k < count; k++)
            if (in_table(hd_steps_step(steps, k)) && hd_steps_step(steps, k)->col == col)
                print_step(hd_steps_step(steps, k), hd_run_scene(run));
    print_fits(run, steps);
    if (missing > 0)
        hdr_log(HDR_INFO, "  %d step%s not resolved", missing, missing > 1 ? "s are" : " is");
}

/** Writes how far the run is from its target, with ", " before it; nothing without a target. */
static void write_target(char text[2 * TEXT], const hd_target_progress *at, bool ended)
{
    const bool missed = ended && !(at->error >= 0.0 && at->error <= at->wanted);
    const char *before = missed ? ", target not reached: " : ", ";
    if (at->error >= 0.0)
        snprintf(text, 2 * TEXT, "%serror of %s %.2g, wanted %.2g", before, at->name, at->error,
                 at->wanted);
    else if (*at->name)
        snprintf(text, 2 * TEXT, "%serror of %s not yet known", before, at->name);
}

static void print(const char *what, const settings *set, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    char of[TEXT] = "", lambda[TEXT], left[TEXT] = "", target[2 * TEXT] = "";
    const progress now = progress_of(run, set->pace);
    number_with_error(lambda, sizeof lambda, hd_spectrum_exponent(spectrum, 0),
                      hd_spectrum_std_error(spectrum, 0));
    if (set->def.duration > 0.0) snprintf(of, sizeof of, " of %.6g", set->def.duration);
    const double remaining = now.cost.remaining;
    write_target(target, &now.cost.target, now.stage == HD_FINISHED);
    if (remaining > 0.0)
        snprintf(left, sizeof left, ", %.0f:%02.0f left", floor(remaining / 60.0),
                 floor(fmod(remaining, 60.0)));
    const char *why = hd_spectrum_std_error(spectrum, 0) < 0.0 ? ", too short for standard errors"
                                                               : "";
    hdr_log(HDR_INFO, "%s: averaged %.6g%s time units, lambda_max %s%s%s%s", what,
            hd_spectrum_time(spectrum), of, lambda, why, target, left);
    print_steps(run);
    if (hd_run_is_caged(run))
        hdr_log(HDR_WARN,
                "  %s have kept their places since the averaging began: errors hold for this "
                "arrangement only, other seeds may differ by more",
                set->particles);
}

static bool is_averaged(const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    return spectrum && hd_spectrum_time(spectrum) > 0.0;
}

static int known_steps(const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    int known = 0;
    for (int k = 0; steps && k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (in_table(step)) known += step->std_error > 0.0 ? 2 : 1;
    }
    return known;
}

void table_tell(table *t, const settings *set, const hd_run *run)
{
    const double now = clock_seconds();
    if (!(set->table > 0.0) || now < t->wall + set->table || !is_averaged(run)) return;
    const double averaged = hd_spectrum_time(hd_run_parts(run).spectrum);
    const int known = known_steps(run);
    if (averaged < t->averaged) *t = (table){.wall = t->wall}; /* the averages were reset */
    if (averaged < 2.0 * t->averaged && known <= t->known) return;
    if (known == 0 && hd_run_parts(run).steps) return;
    *t = (table){now, averaged, known};
    print("so far", set, run);
}

void table_result(const settings *set, const hd_run *run)
{
    if (set->table > 0.0 && is_averaged(run)) print("result", set, run);
}
