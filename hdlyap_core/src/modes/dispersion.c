/** Steps -> dispersion relation: weighted least squares for lambda = c k + c2 k^2 [T12]. */
#include "hdlyap/steps.h"

#include <math.h>

/** Normal equations, and what the errors of the fit need. */
typedef struct fit {
    double kk, k3, k4, kl, k2l; /**< sums of w k^2, w k^3, w k^4, w k lambda, w k^2 lambda */
    int points;                 /**< steps */
    int wave_numbers;           /**< distinct ones */
    bool weighted;              /**< all errors are known */
} fit;

static bool counts(const hd_step *step, hd_mode_kind kind)
{
    return step->resolved && step->kind == kind && !step->conjugate;
}

/** Square boxes have one wave number twice. */
static bool is_new(const hd_steps *steps, int index)
{
    const hd_step *step = hd_steps_step(steps, index);
    for (int k = 0; k < index; k++) {
        const hd_step *before = hd_steps_step(steps, k);
        if (counts(before, step->kind) &&
            fabs(before->wave.number - step->wave.number) < 1e-9 * step->wave.number)
            return false;
    }
    return true;
}

static double weight_of(const hd_step *step, bool weighted)
{
    return weighted ? 1.0 / (step->std_error * step->std_error) : 1.0;
}

static fit sums_of(const hd_steps *steps, hd_mode_kind kind)
{
    fit f = {.weighted = true};
    for (int i = 0; i < hd_steps_count(steps); i++)
        if (counts(hd_steps_step(steps, i), kind))
            f.weighted &= hd_steps_step(steps, i)->std_error > 0;
    for (int i = 0; i < hd_steps_count(steps); i++) {
        const hd_step *step = hd_steps_step(steps, i);
        if (!counts(step, kind)) continue;
        const double k = step->wave.number, w = weight_of(step, f.weighted);
        f.points++;
        f.wave_numbers += is_new(steps, i);
        f.kk += w * k * k;
        f.k3 += w * k * k * k;
        f.k4 += w * k * k * k * k;
        f.kl += w * k * step->exponent;
        f.k2l += w * k * k * step->exponent;
    }
    return f;
}

/** Factor on the errors: scatter over what the weights allow, at least 1; negative if unknown. */
static double scatter(const hd_steps *steps, hd_mode_kind kind, const fit *f,
                      const hd_dispersion *d)
{
    const int freedom = f->points - (f->wave_numbers > 1 ? 2 : 1);
    double chi2 = 0.0;
    for (int i = 0; i < hd_steps_count(steps); i++) {
        const hd_step *step = hd_steps_step(steps, i);
        if (!counts(step, kind)) continue;
        const double k = step->wave.number;
        const double off = step->exponent - d->c * k - d->c2 * k * k;
        chi2 += weight_of(step, f->weighted) * off * off;
    }
    if (freedom == 0) return f->weighted ? 1.0 : -1.0;
    const double factor = sqrt(chi2 / freedom);
    return f->weighted ? fmax(factor, 1.0) : factor;
}

hd_dispersion hd_steps_dispersion(const hd_steps *steps, hd_mode_kind kind)
{
    const fit f = sums_of(steps, kind);
    hd_dispersion d = {.points = f.wave_numbers, .c_error = -1.0, .c2_error = -1.0};
    if (f.points == 0) return d;
    const bool curved = f.wave_numbers > 1;
    const double det = f.kk * f.k4 - f.k3 * f.k3;
    d.c = curved ? (f.kl * f.k4 - f.k2l * f.k3) / det : f.kl / f.kk;
    d.c2 = curved ? (f.k2l * f.kk - f.kl * f.k3) / det : 0.0;
    const double factor = scatter(steps, kind, &f, &d);
    if (factor < 0) return d;
    d.c_error = factor * sqrt(curved ? f.k4 / det : 1.0 / f.kk);
    if (curved) d.c2_error = factor * sqrt(f.kk / det);
    return d;
}
