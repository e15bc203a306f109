/** Steps -> dispersion relation lambda = c k + c2 k^2 + c3 k^3, with what long boxes say of c2 / c
 * and c3 / c as two more observations [T12]. Results are sums of factors times exponents; their
 * errors are those of such sums, with what the form of the fit leaves open. */
#include <lapacke.h>
#include <math.h>

#include "base/check.h"
#include "modes/steps.h"

enum { TERMS = 3 };

/** A fit for the unknowns x: lambda = x_0 B(k) + x_1 k^2 + x_2 k^3. B is the relation of long
 * boxes; x_1 and x_2 are in units of their widths there, so that long boxes say 0 +- 1. */
typedef struct fit {
    const hd_relation *prior;
    hd_mode_kind kind;
    double inverse[TERMS * TERMS]; /**< inverse of the normal equations' matrix: the covariance if
                                      steps were independent */
    double unit[TERMS];
    int points; /**< number of different wave numbers */
    double k_min, k_max;
    const hd_steps *steps;
    bool weighted; /**< true if the errors of all steps are known */
} fit;

/** An exponent below this does not count: weights are up to 1e6 over its square. */
static const double SMALLEST = 1e-100;

static bool counts(const hd_step *step, hd_mode_kind kind)
{
    return step->resolved && step->kind == kind && !step->conjugate && step->exponent > SMALLEST;
}

/** Whether no step before has this wave number: square boxes have one twice. */
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

/** How far a step may lie off the relation independently of other steps [1/time unit]. */
static double stray(const fit *f, const hd_step *step)
{
    return hd_steps_scatter(f->steps, step) * step->exponent;
}

static double weight_of(const fit *f, const hd_step *step)
{
    const double error = f->weighted ? step->std_error : 0.0, own = stray(f, step);
    return 1.0 / (error * error + own * own);
}

static double relation_at(const hd_relation *prior, double k)
{
    return k * (1.0 + k * (prior->c2 + k * prior->c3));
}

static void row_of(const fit *f, double k, double out[TERMS])
{
    out[0] = relation_at(f->prior, k);
    out[1] = f->unit[1] * k * k;
    out[2] = f->unit[2] * k * k * k;
}

/** Collects the steps, and finds c with the curvature of long boxes, which is the unit of errors.
 * The fit has no points if steps follow no relation. */
static fit begin(const hd_steps *steps, hd_mode_kind kind)
{
    fit f = {
        .prior = hd_steps_relation(steps, kind), .kind = kind, .steps = steps, .weighted = true};
    double squares = 0.0, products = 0.0;
    if (isnan(f.prior->c2)) return f;
    for (int i = 0; i < hd_steps_count(steps); i++)
        if (counts(hd_steps_step(steps, i), kind))
            f.weighted &= hd_steps_step(steps, i)->std_error > 0;
    for (int i = 0; i < hd_steps_count(steps); i++) {
        const hd_step *step = hd_steps_step(steps, i);
        if (!counts(step, kind)) continue;
        const double k = step->wave.number, b = relation_at(f.prior, k), w = weight_of(&f, step);
        f.k_min = f.points == 0 ? k : fmin(f.k_min, k);
        f.k_max = fmax(f.k_max, k);
        f.points += is_new(steps, i);
        squares += w * b * b;
        products += w * b * step->exponent;
    }
    const double c = f.points > 0 ? products / squares : 0.0;
    f.unit[0] = 1.0;
    f.unit[1] = f.prior->c2_error * c;
    f.unit[2] = f.prior->c3_error * c;
    return f;
}

/** Solves the normal equations, with the two observations from long boxes; keeps their inverse. */
static void solve(fit *f)
{
    double *n = f->inverse;
    for (int m = 0; m < TERMS; m++) n[m * TERMS + m] = m > 0;
    for (int i = 0; i < hd_steps_count(f->steps); i++) {
        const hd_step *step = hd_steps_step(f->steps, i);
        double row[TERMS];
        if (!counts(step, f->kind)) continue;
        row_of(f, step->wave.number, row);
        for (int a = 0; a < TERMS; a++)
            for (int b = 0; b < TERMS; b++)
                n[a * TERMS + b] += weight_of(f, step) * row[a] * row[b];
    }
    int info = LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', TERMS, n, TERMS);
    if (info == 0) info = LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', TERMS, n, TERMS);
    HD_ASSERT(info == 0); /* positive definite: sums of squares, and 1 on two diagonals */
    for (int a = 0; a < TERMS; a++)
        for (int b = 0; b < a; b++) n[a * TERMS + b] = n[b * TERMS + a];
}

/** A result: the combination of unknowns that is c, c2 or c3. */
typedef struct result {
    const fit *of;
    double factor[TERMS]; /**< factors of the unknowns, times the inverse */
} result;

static result result_of(const fit *f, int term)
{
    const double of_c[] = {1.0, f->prior->c2, f->prior->c3};
    result r = {.of = f};
    for (int m = 0; m < TERMS; m++)
        r.factor[m] = of_c[term] * f->inverse[m] +
                      (term > 0 ? f->unit[term] * f->inverse[term * TERMS + m] : 0.0);
    return r;
}

/** Factor of a step's exponent in the result. */
static double share_of_step(const hd_step *step, const void *context)
{
    const result *r = context;
    double row[TERMS], sum = 0.0;
    if (!counts(step, r->of->kind)) return 0.0;
    row_of(r->of, step->wave.number, row);
    for (int m = 0; m < TERMS; m++) sum += r->factor[m] * row[m];
    return sum * weight_of(r->of, step);
}

/** A coefficient; its error without the part that is common to all steps; the part of that error
 * that is sampling, with weights held fixed, and the part of sampling that is mixing. */
typedef struct found {
    double value, error, sampling, mixing;
} found;

static found coefficient(const fit *f, const hd_spectrum *spectrum, int term)
{
    const result r = result_of(f, term);
    found out = {.error = -1.0};
    double mixed = 0.0, square = r.factor[1] * r.factor[1] + r.factor[2] * r.factor[2];
    for (int i = 0; i < hd_steps_count(f->steps); i++) {
        const hd_step *step = hd_steps_step(f->steps, i);
        const double part = share_of_step(step, &r);
        out.value += part * step->exponent;
        if (part != 0) square += pow(part * stray(f, step), 2.0);
        mixed += pow(part * step->mixing, 2.0);
    }
    out.mixing = sqrt(mixed);
    out.sampling = hd_steps_error_of_sum(f->steps, spectrum, share_of_step, &r);
    if (!(out.sampling >= 0)) return out;
    out.sampling = hypot(out.sampling, out.mixing);
    out.error = hypot(out.sampling, sqrt(square));
    return out;
}

/** The misfit of the steps and of the two observations from long boxes. */
static double misfit_of(const fit *f, const hd_dispersion *d)
{
    const double off[] = {(d->c2.value - f->prior->c2 * d->c.value) / f->unit[1],
                          (d->c3.value - f->prior->c3 * d->c.value) / f->unit[2]};
    double chi2 = off[0] * off[0] + off[1] * off[1];
    int steps = 0;
    for (int i = 0; i < hd_steps_count(f->steps); i++) {
        const hd_step *step = hd_steps_step(f->steps, i);
        if (!counts(step, f->kind)) continue;
        const double k = step->wave.number;
        const double fitted = k * (d->c.value + k * (d->c2.value + k * d->c3.value));
        chi2 += weight_of(f, step) * pow(step->exponent - fitted, 2.0);
        steps++;
    }
    return steps > 1 && f->weighted ? sqrt(chi2 / (steps - 1)) : -1.0;
}

/** Multiplies errors by a misfit above 1, except for the part that moves all steps alike, which
 * chi^2 does not see. */
static void widen(const fit *f, double misfit, hd_coefficient *c)
{
    if (c->error >= 0)
        c->error = hypot(fmax(1.0, misfit) * c->error, f->prior->box_error * c->value);
}

hd_dispersion hd_steps_dispersion(const hd_steps *steps, const hd_spectrum *spectrum,
                                  hd_mode_kind kind)
{
    const hd_coefficient none = {0.0, -1.0};
    fit f = begin(steps, kind);
    hd_dispersion d = {.points = f.points,
                       .k_min = f.k_min,
                       .k_max = f.k_max,
                       .prior_share = 1.0,
                       .in_long_boxes = f.prior,
                       .c = none,
                       .c_sampling_error = -1.0,
                       .c2 = none,
                       .c3 = none,
                       .misfit = -1.0};
    if (f.points == 0) return d;
    solve(&f);
    d.prior_share = 0.5 * (f.inverse[TERMS + 1] + f.inverse[2 * TERMS + 2]);
    const found c[TERMS] = {coefficient(&f, spectrum, 0), coefficient(&f, spectrum, 1),
                            coefficient(&f, spectrum, 2)};
    d.c = (hd_coefficient){c[0].value, c[0].error};
    d.c2 = (hd_coefficient){c[1].value, c[1].error};
    d.c3 = (hd_coefficient){c[2].value, c[2].error};
    d.c_sampling_error = c[0].sampling;
    d.c_mixing = c[0].mixing;
    d.misfit = misfit_of(&f, &d);
    widen(&f, d.misfit, &d.c);
    widen(&f, d.misfit, &d.c2);
    widen(&f, d.misfit, &d.c3);
    return d;
}
