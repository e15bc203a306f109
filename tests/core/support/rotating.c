#include "rotating.h"

const hd_phase *phase_of(const rotating *r, int slot, int c)
{
    return hd_phases_phase(r->phases, r->first + slot * r->d + c);
}

/** L fields one after the other, then P fields; T fields in pairs. */
int column_of(const rotating *r, int c, bool second)
{
    const int first = hd_fields_subspace(r->w.fields, r->step->subspace)->column;
    return r->step->kind == HD_MODE_T ? first + 2 * c + second : first + c + (second ? r->d : 0);
}

static void write_vector(rotating *r, int m)
{
    double dq[ROWS_MAX] = {0.0};
    for (int row = 0; row < world_rows(&r->w); row++)
        dq[row] = (1.0 - r->strength[m]) * random_normal(&r->w.random) / sqrt(world_rows(&r->w));
    for (int c = 0; c < r->d; c++) {
        const double cosine = cos(r->angle[m][c]), sine = sin(r->angle[m][c]);
        const double factor = r->sign[m] * r->strength[m];
        world_add_field(&r->w, dq, column_of(r, c, false),
                        factor * (cosine * r->re[m][c] - sine * r->im[m][c]));
        world_add_field(&r->w, dq, column_of(r, c, true),
                        factor * (sine * r->re[m][c] + cosine * r->im[m][c]));
    }
    world_write_mode(&r->w, r->column[m], dq, 1.0);
}

/** Measures the vectors as they are, without adding to the averages. */
static void show(rotating *r)
{
    for (int m = 0; m < 2 * r->d; m++) write_vector(r, m);
    CHECK_OK(hd_modes_measure(r->w.modes, hd_frame_columns(r->w.frame), r->w.q, r->w.p));
    hd_phases_add(r->phases, r->w.steps, r->time);
}

void turn(rotating *r, double omega)
{
    r->time += r->dt;
    for (int m = 0; m < 2 * r->d; m++)
        for (int c = 0; c < r->d; c++) r->angle[m][c] += omega * r->dt;
    show(r);
}

void find(rotating *r, double exponent)
{
    double exponents[2 * VECTORS_MAX];
    exponents_flat(exponents, 0, hd_frame_vectors(r->w.frame), exponent);
    hd_spectrum_clear(r->w.spectrum);
    world_stretch(&r->w, exponents);
    hd_steps_find(r->w.steps, r->w.spectrum);
}

void begin(rotating *r)
{
    double rotation[VECTORS_MAX * VECTORS_MAX];
    random_rotation(&r->w.random, rotation, 2 * r->d);
    for (int m = 0; m < 2 * r->d; m++) {
        r->column[m] = r->step->col + m;
        r->sign[m] = r->strength[m] = 1.0;
        for (int c = 0; c < r->d; c++) {
            r->re[m][c] = rotation[m * 2 * r->d + c];
            r->im[m][c] = rotation[m * 2 * r->d + r->d + c];
            r->angle[m][c] = 0.0;
        }
    }
    r->time = 0.0;
    hd_phases_clear(r->phases);
    show(r);
}

rotating rotating_create(hd_scene_def def, hd_mode_kind kind, int nx, int ny, int vectors,
                         double exponent)
{
    rotating r = {.w = world_create(def, vectors, 1), .dt = 1.0};
    const int s = world_subspace(&r.w, kind, nx, ny);
    r.step = hd_steps_step(r.w.steps, s);
    r.d = r.step->expected / 2;
    CHECK_OK(hd_phases_create(&r.phases, r.w.steps, kind));
    while (hd_phases_phase(r.phases, r.first)->step != s) r.first++;
    world_span(&r.w, vectors - 2 * r.d, &s, 1, 0.0);
    world_look(&r.w);
    find(&r, exponent);
    assert_true(r.step->resolved);
    assert_int_equal(r.step->count, 2 * r.d);
    begin(&r);
    return r;
}

void rotating_free(rotating *r)
{
    hd_phases_free(r->phases);
    world_free(&r->w);
}

rotating pairs_of(int d, int disks)
{
    const double exponent = 2.4;
    hd_scene_def def;
    if (d == 4) {
        def = scene_of(disks, 0.5, 0.8, P, P, 9);
        def.max_mode_number = 1;
        return rotating_create(def, HD_MODE_LP, 1, 1, 8, exponent);
    }
    def = scene_in_box(disks, disks / 0.75, 1.5, d == 1 ? R : P, P, 9);
    def.max_mode_number = 1;
    return rotating_create(def, HD_MODE_LP, 1, 0, 2 * d, exponent);
}

rotating pairs(int d) { return pairs_of(d, d == 4 ? 60 : 30); }

rotating t_pairs(int d)
{
    return rotating_create(
        scene(.number = 60, .density = 0.5, .aspect = 0.8, .seed = 9, .max_mode_number = 1),
        HD_MODE_T, 1, d - 1, 2 * d, 2.4);
}

void exchange(rotating *r, int a, int b, double sign)
{
    const int column = r->column[a];
    r->column[a] = r->column[b];
    r->column[b] = column;
    r->sign[a] *= sign;
}

void check_columns(const rotating *r)
{
    for (int v = 0; v < 2 * r->d; v++)
        for (int c = 0; c < r->d; c++) assert_int_equal(phase_of(r, v, c)->col, r->column[v]);
}

double strength_of(const hd_phase *phase) { return phase->a * phase->a + phase->b * phase->b; }

int check_tracks(const rotating *r, double angle, double time, double tolerance)
{
    int tracked = 0;
    for (int v = 0; v < 2 * r->d; v++)
        for (int c = 0; c < r->d; c++) {
            const hd_phase *phase = phase_of(r, v, c);
            if (phase->state != HD_PHASE_TRACKED || phase->time != time) continue;
            const double start = atan2(r->im[v][c], r->re[v][c]);
            assert_true(strength_of(phase) >= WEAK);
            CHECK_CLOSE(phase->phase, start + angle, tolerance);
            tracked++;
        }
    return tracked;
}
