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
    const int half = (4 * scene->number - hd_scene_counts(scene).zero) / 2;
    return half < hd_run_vectors(run) ? half : hd_run_vectors(run);
}

/** The waves are those of hd_fields: the zero modes and the conjugate steps come behind. */
static int waves(const hd_run *run)
{
    const int count = hd_fields_subspaces(hd_modes_fields(hd_run_parts(run).modes));
    return count < WAVES_MAX ? count : WAVES_MAX;
}

static void name_step(const hd_run *run, int index, char *out, size_t size)
{
    const hd_step *step = hd_steps_step(hd_run_parts(run).steps, index);
    snprintf(out, size, "%s(%d;%d)", step->kind == HD_MODE_T ? "T" : "LP", step->wave.n[0],
             step->wave.n[1]);
}

/* ---- one number after the other -------------------------------------------------------------- */

/** Rows and numbers so far; out NULL: only the rows are wanted. */
typedef struct list {
    row_of_numbers row[NUMBER_ROWS_MAX];
    number *out;
    int rows, numbers;
} list;

/** Numbers of one row follow each other. */
static void add(list *l, const char *name, number n)
{
    row_of_numbers *row = &l->row[l->rows - 1];
    if (l->rows == 0 || strcmp(row->name, name) != 0) {
        if (l->rows == NUMBER_ROWS_MAX) return;
        row = &l->row[l->rows++];
        *row = (row_of_numbers){.first = l->numbers};
        snprintf(row->name, sizeof row->name, "%s", name);
    }
    row->count++;
    if (l->out) l->out[l->numbers] = n;
    l->numbers++;
}

static void add_exponents(list *l, const char *name, const hd_spectrum *spectrum, int count,
                          bool known)
{
    for (int col = 0; col < count; col++)
        add(l, name,
            (number){hd_spectrum_exponent(spectrum, col), hd_spectrum_std_error(spectrum, col),
                     known ? NO_STEPS : 0});
}

static void add_dispersion(list *l, const hd_run *run, const char *name, hd_mode_kind kind)
{
    const hd_dispersion d = hd_steps_dispersion(hd_run_parts(run).steps, hd_run_parts(run).spectrum,
                                                kind);
    uint64_t of = 0;
    for (int k = 0; k < waves(run); k++) {
        const hd_step *step = hd_steps_step(hd_run_parts(run).steps, k);
        if (step->resolved && step->kind == kind) of |= bit(k);
    }
    add(l, name, (number){d.c.value, d.c_sampling_error, of});
}

/** Of steps of which a phase is followed. */
static void add_velocity(list *l, const hd_run *run)
{
    const hd_velocity v = hd_phases_velocity(hd_run_parts(run).phases);
    uint64_t of = 0;
    for (int k = 0; k < hd_phases_count(hd_run_parts(run).phases); k++) {
        const hd_phase *phase = hd_phases_phase(hd_run_parts(run).phases, k);
        if (phase->state == HD_PHASE_TRACKED && phase->step < waves(run)) of |= bit(phase->step);
    }
    add(l, "v", (number){v.v, v.v_sampling_error, v.phases > 0 ? of : 0});
}

static void add_steps(list *l, const hd_run *run)
{
    for (int k = 0; k < waves(run); k++) {
        const hd_step *step = hd_steps_step(hd_run_parts(run).steps, k);
        char name[16];
        uint64_t of = 0;
        name_step(run, k, name, sizeof name);
        for (int other = 0; step->resolved && other < waves(run); other++)
            if (hd_steps_step(hd_run_parts(run).steps, other)->set == step->set) of |= bit(other);
        add(l, name, (number){step->exponent, step->std_error, of});
    }
}

/** Phases that have been followed, also those that are weak just now. */
static void add_phases(list *l, const hd_run *run)
{
    for (int k = 0; k < hd_phases_count(hd_run_parts(run).phases); k++) {
        const hd_phase *phase = hd_phases_phase(hd_run_parts(run).phases, k);
        char name[16], omega[32];
        if (phase->step >= waves(run)) break;
        name_step(run, phase->step, name, sizeof name);
        snprintf(omega, sizeof omega, "omega %s", name);
        const bool known = phase->state != HD_PHASE_UNRESOLVED && phase->time > 0;
        add(l, omega, (number){phase->omega, phase->omega_error, known ? bit(phase->step) : 0});
    }
}

/** The angle between unstable and stable space; the centre is exactly perpendicular to both [T17].
 */
static void add_covariant(list *l, const hd_run *run)
{
    const hd_covariant *covariant = hd_run_parts(run).covariant;
    const hd_splitting_results splitting = hd_covariant_read(covariant).splitting;
    const bool known = hd_covariant_read(covariant).windows > 0;
    number angle = {.error = -1.0};
    add_exponents(l, "covariant exponents", hd_covariant_read(covariant).spectrum, positive(run),
                  known);
    if (known && splitting.has_spaces) {
        const hd_angle_of_spaces *spaces = &splitting.angle[HD_UNSTABLE_STABLE];
        angle = (number){spaces->mean, spaces->std_error, NO_STEPS};
    }
    add(l, "angle", angle);
}

static list list_of(const hd_run *run, number *out)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    list l = {.out = out};
    add_exponents(&l, "exponents", spectrum, positive(run), true);
    add(&l, "h_KS",
        (number){hd_spectrum_sum_up(spectrum).ks_entropy,
                 hd_spectrum_sum_up(spectrum).ks_entropy_error, NO_STEPS});
    if (hd_run_parts(run).steps) {
        add_dispersion(&l, run, "c_T", HD_MODE_T);
        add_dispersion(&l, run, "c_L", HD_MODE_LP);
        add_velocity(&l, run);
        add_steps(&l, run);
        add_phases(&l, run);
    }
    if (hd_run_parts(run).covariant) add_covariant(&l, run);
    return l;
}

int numbers_rows(const hd_run *run, row_of_numbers *out)
{
    const list l = list_of(run, NULL);
    memcpy(out, l.row, sizeof l.row);
    return l.rows;
}

void numbers_read(const hd_run *run, number *out) { list_of(run, out); }
