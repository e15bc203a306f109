/** Steps -> dispersion relation: weighted least squares for lambda = c k + c2 k^2 [T12]. Both
 * results are sums of factors times exponents, so their errors are those of such sums. */
#include "hdlyap/steps.h"

#include <math.h>

/** Normal equations. */
typedef struct fit {
    double kk, k3, k4; /**< sums of w k^2, w k^3, w k^4 */
    int points;        /**< steps */
    int wave_numbers;  /**< distinct ones */
    double k_min, k_max;
    bool weighted; /**< all errors are known */
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
        f.k_min = f.points == 0 ? k : fmin(f.k_min, k);
        f.k_max = fmax(f.k_max, k);
        f.points++;
        f.wave_numbers += is_new(steps, i);
        f.kk += w * k * k;
        f.k3 += w * k * k * k;
        f.k4 += w * k * k * k * k;
    }
    return f;
}

/** One wave number alone knows no curvature. */
static int terms_of(const fit *f) { return f->wave_numbers < 2 ? f->wave_numbers : 2; }

/** Of which result, c (power 1) or c2 (power 2), and from which steps. */
typedef struct result {
    const fit *of;
    hd_mode_kind kind;
    int power;
} result;

/** Factor of a step's exponent in the result. */
static double share(const hd_step *step, const void *context)
{
    const result *r = context;
    const fit *f = r->of;
    if (!counts(step, r->kind)) return 0.0;
    const double k = step->wave.number, wk = k * weight_of(step, f->weighted);
    const double det = f->kk * f->k4 - f->k3 * f->k3;
    if (terms_of(f) < 2) return wk / f->kk;
    return r->power == 1 ? wk * (f->k4 - k * f->k3) / det : wk * (k * f->kk - f->k3) / det;
}

static double value_of(const hd_steps *steps, const result *r)
{
    double sum = 0.0;
    for (int i = 0; i < hd_steps_count(steps); i++)
        sum += share(hd_steps_step(steps, i), r) * hd_steps_step(steps, i)->exponent;
    return sum;
}

static double misfit_of(const hd_steps *steps, hd_mode_kind kind, const fit *f,
                        const hd_dispersion *d)
{
    const int freedom = f->points - terms_of(f);
    double chi2 = 0.0;
    for (int i = 0; i < hd_steps_count(steps); i++) {
        const hd_step *step = hd_steps_step(steps, i);
        if (!counts(step, kind)) continue;
        const double k = step->wave.number;
        const double off = step->exponent - d->c * k - d->c2 * k * k;
        chi2 += weight_of(step, f->weighted) * off * off;
    }
    return freedom > 0 && f->weighted ? sqrt(chi2 / freedom) : -1.0;
}

hd_dispersion hd_steps_dispersion(const hd_steps *steps, const hd_spectrum *spectrum,
                                  hd_mode_kind kind)
{
    const fit f = sums_of(steps, kind);
    hd_dispersion d = {.points = f.wave_numbers,
                       .terms = terms_of(&f),
                       .k_min = f.k_min,
                       .k_max = f.k_max,
                       .c_error = -1.0,
                       .c2_error = -1.0,
                       .misfit = -1.0};
    if (f.points == 0) return d;
    const result c = {&f, kind, 1}, c2 = {&f, kind, 2};
    d.c = value_of(steps, &c);
    d.c_error = hd_steps_error_of_sum(steps, spectrum, share, &c);
    if (d.terms > 1) {
        d.c2 = value_of(steps, &c2);
        d.c2_error = hd_steps_error_of_sum(steps, spectrum, share, &c2);
    }
    d.misfit = misfit_of(steps, kind, &f, &d);
    return d;
}
