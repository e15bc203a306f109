/** Run -> what it publishes with a standard error. */
#include "numbers.h"

#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WAVES_MAX = 63 };

static const uint64_t NO_STEPS = (uint64_t)1 << WAVES_MAX;

static uint64_t bit(int step) { return (uint64_t)1 << step; }

static int positive(const hd_run *run)
{
    const hd_scene_def *scene = hd_run_scene(run);
    const int half = (4 * scene->disks - hd_scene_zero_exponents(scene)) / 2;
    return half < hd_run_vectors(run) ? half : hd_run_vectors(run);
}

/** The waves are those of hd_fields: the zero modes and the conjugate steps come behind. */
static int waves(const hd_run *run)
{
    const int count = hd_fields_subspaces(hd_modes_fields(hd_run_modes(run)));
    return count < WAVES_MAX ? count : WAVES_MAX;
}

static void name_step(const hd_run *run, int index, char *out, size_t size)
{
    const hd_step *step = hd_steps_step(hd_run_steps(run), index);
    snprintf(out, size, "%s(%d;%d)", step->kind == HD_MODE_T ? "T" : "LP", step->wave.n[0],
             step->wave.n[1]);
}

void numbers_name(const hd_run *run, uint64_t of, char *out, size_t size)
{
    out[0] = '\0';
    for (int k = 0; of != NO_STEPS && k < waves(run); k++) {
        char name[16];
        if (!(of & bit(k))) continue;
        name_step(run, k, name, sizeof name);
        const size_t used = strlen(out);
        snprintf(out + used, size - used, "%s%s", used > 0 ? "+" : "", name);
    }
}

/* ---- rows ---------------------------------------------------------------------------------- */

typedef struct rows {
    row_of_numbers *row;
    int count, numbers;
} rows;

static void row_add(rows *r, const char *name, int count)
{
    if (count == 0 || r->count == NUMBER_ROWS_MAX) return;
    row_of_numbers *row = &r->row[r->count++];
    snprintf(row->name, sizeof row->name, "%s", name);
    row->first = r->numbers;
    row->count = count;
    r->numbers += count;
}

/** Phases of a step: as many as tracks, d^2 / 2 of d vectors. */
static void rows_of_steps(const hd_run *run, rows *r)
{
    char name[16], omega[32];
    for (int k = 0; k < waves(run); k++) {
        name_step(run, k, name, sizeof name);
        row_add(r, name, 1);
    }
    for (int k = 0; k < waves(run); k++) {
        const hd_step *step = hd_steps_step(hd_run_steps(run), k);
        name_step(run, k, name, sizeof name);
        snprintf(omega, sizeof omega, "omega %s", name);
        row_add(r, omega, step->kind == HD_MODE_LP ? step->expected * step->expected / 2 : 0);
    }
}

int numbers_rows(const hd_run *run, row_of_numbers *out)
{
    static const char *const singles[] = {"c_T", "c_L", "v"};
    rows r = {.row = out};
    row_add(&r, "exponents", positive(run));
    row_add(&r, "h_KS", 1);
    if (hd_run_steps(run)) {
        for (int k = 0; k < 3; k++) row_add(&r, singles[k], 1);
        rows_of_steps(run, &r);
    }
    if (!hd_run_covariant(run)) return r.count;
    row_add(&r, "covariant exponents", positive(run));
    row_add(&r, "angle", 1);
    return r.count;
}

/* ---- values -------------------------------------------------------------------------------- */

static number *read_exponents(const hd_spectrum *spectrum, int count, bool known, number *out)
{
    for (int col = 0; col < count; col++)
        *out++ = (number){hd_spectrum_exponent(spectrum, col), hd_spectrum_std_error(spectrum, col),
                          known ? NO_STEPS : 0};
    return out;
}

static number *read_dispersion(const hd_run *run, hd_mode_kind kind, number *out)
{
    const hd_dispersion d = hd_steps_dispersion(hd_run_steps(run), hd_run_spectrum(run), kind);
    uint64_t of = 0;
    for (int k = 0; k < waves(run); k++) {
        const hd_step *step = hd_steps_step(hd_run_steps(run), k);
        if (step->resolved && step->kind == kind) of |= bit(k);
    }
    *out++ = (number){d.c.value, d.c_sampling_error, of};
    return out;
}

/** Steps of which a phase is followed. */
static number *read_velocity(const hd_run *run, number *out)
{
    const hd_velocity v = hd_phases_velocity(hd_run_phases(run));
    uint64_t of = 0;
    for (int k = 0; k < hd_phases_count(hd_run_phases(run)); k++) {
        const hd_phase *phase = hd_phases_phase(hd_run_phases(run), k);
        if (phase->state == HD_PHASE_TRACKED && phase->step < waves(run)) of |= bit(phase->step);
    }
    *out++ = (number){v.v, v.v_error, v.phases > 0 ? of : 0};
    return out;
}

static number *read_steps(const hd_run *run, number *out)
{
    for (int k = 0; k < waves(run); k++) {
        const hd_step *step = hd_steps_step(hd_run_steps(run), k);
        uint64_t of = 0;
        for (int other = 0; step->resolved && other < waves(run); other++)
            if (hd_steps_step(hd_run_steps(run), other)->set == step->set) of |= bit(other);
        *out++ = (number){step->exponent, step->std_error, of};
    }
    return out;
}

/** Phases that have been followed, also those that are weak just now. */
static number *read_phases(const hd_run *run, number *out)
{
    for (int k = 0; k < hd_phases_count(hd_run_phases(run)); k++) {
        const hd_phase *phase = hd_phases_phase(hd_run_phases(run), k);
        if (phase->step >= waves(run)) break;
        const bool known = phase->state != HD_PHASE_UNRESOLVED && phase->time > 0;
        *out++ = (number){phase->omega, phase->omega_error, known ? bit(phase->step) : 0};
    }
    return out;
}

/** The angle between unstable and stable space; the centre is exactly perpendicular to both [T18].
 */
static void read_covariant(const hd_run *run, number *out)
{
    const hd_covariant *covariant = hd_run_covariant(run);
    const hd_splitting *splitting = hd_covariant_splitting(covariant);
    const bool known = hd_covariant_windows(covariant) > 0;
    out = read_exponents(hd_covariant_spectrum(covariant), positive(run), known, out);
    *out = (number){.error = -1.0};
    if (!known || !hd_splitting_has_spaces(splitting)) return;
    const hd_angle_of_spaces *angle = hd_splitting_angle(splitting, HD_UNSTABLE_STABLE);
    *out = (number){angle->mean, angle->std_error, NO_STEPS};
}

void numbers_read(const hd_run *run, number *out)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    out = read_exponents(spectrum, positive(run), true, out);
    *out++ = (number){hd_spectrum_ks_entropy(spectrum), hd_spectrum_ks_entropy_error(spectrum),
                      NO_STEPS};
    if (hd_run_steps(run)) {
        out = read_dispersion(run, HD_MODE_T, out);
        out = read_dispersion(run, HD_MODE_LP, out);
        out = read_velocity(run, out);
        out = read_steps(run, out);
        out = read_phases(run, out);
    }
    if (hd_run_covariant(run)) read_covariant(run, out);
}

int numbers_first_of_modes(const hd_run *run)
{
    int first = positive(run);
    for (int k = 0; hd_run_steps(run) && k < waves(run); k++) {
        const hd_step *step = hd_steps_step(hd_run_steps(run), k);
        if (step->resolved && step->col < first) first = step->col;
    }
    return first;
}
