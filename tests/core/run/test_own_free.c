/** A dynamics of one's own, in a box, of which most exponents vanish: particles that fly freely, as
 * do the tangent vectors of the first FREE of them; those of the others grow and shrink like exp(t)
 * and exp(-t). */
#include "kept.h"
#include "runs.h"
#include "same.h"

enum { COUNT = 40, ALL = 4 * COUNT, FREE = 25, ZEROS = 4 * FREE, POSITIVE = (ALL - ZEROS) / 2 };
#define PATH "free.ckpt"

typedef struct flight {
    double box[2], now, q[2 * COUNT], p[2 * COUNT];
} flight;

static int zeros(const hd_scene_def *scene) { return scene->number == COUNT ? ZEROS : 0; }
static double pace(const hd_scene_def *scene) { return scene->number; }
static double now(const void *state) { return ((const flight *)state)->now; }

static hd_status create(void **state, const hd_scene_def *scene)
{
    flight *f = *state = calloc(1, sizeof *f);
    if (!f) return HD_NO_MEMORY;
    hd_scene_box(scene, f->box);
    for (int k = 0; k < 2 * COUNT; k++) {
        f->q[k] = fmod(0.37 * k * f->box[k % 2], f->box[k % 2]);
        f->p[k] = sin(1.0 + k);
    }
    return HD_OK;
}

static hd_status advance(void *state, hd_record *record, double t_end)
{
    flight *f = state;
    const double time = t_end - f->now;
    for (int k = 0; k < 2 * COUNT; k++) {
        const double edge = f->box[k % 2], q = f->q[k] + time * f->p[k];
        f->q[k] = q - edge * floor(q / edge);
    }
    f->now = t_end;
    if (record) hd_record_end(record, hd_record_duration(record) + time);
    return HD_OK;
}

static void tell(const void *state, double *q, double *p)
{
    const flight *f = state;
    if (q) memcpy(q, f->q, sizeof f->q);
    if (p) memcpy(p, f->p, sizeof f->p);
}

static void archive(void *state, hd_archive *file)
{
    flight *f = state;
    hd_archive_doubles(file, "flight now", &f->now, 1);
    hd_archive_doubles(file, "flight q", f->q, 2 * COUNT);
    hd_archive_doubles(file, "flight p", f->p, 2 * COUNT);
}

static void carry(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    const double time = part->end - part->begin;
    for (int row = 0; row < ALL; row++)
        for (int col = 0; col < width && row % 4 < 2; col++) {
            double *dq = &block[row * width + col], *dp = dq + 2 * width;
            const bool free = row < ZEROS;
            *dq = free ? *dq + time * *dp : exp(time) * *dq;
            if (!free) *dp *= exp(-time);
        }
}

static int null(const hd_scene_def *scene, const double *q, const double *p, double *column)
{
    (void)scene, (void)q, (void)p;
    for (int k = 0; k < ZEROS; k++)
        for (int row = 0; row < ALL; row++) column[k * ALL + row] = row == k;
    return ZEROS;
}

/* clang-format off */
static const hd_dynamics of_free = {
    .particles = "ghosts", .dimension = 2, .coordinates = 2, .entry = sizeof(double), .symplectic = true,
    .zero_exponents = zeros, .record_rate = pace, .collision_rate = pace, .null_vectors = null, .create = create, .free = free,
    .advance = advance, .time = now, .state = tell, .archive = archive, .carry = carry};
/* clang-format on */

static void check_zero_modes(hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const int k = hd_fields_subspaces(hd_modes_fields(hd_run_parts(run).modes));
    const hd_step *zero = hd_steps_step(steps, k);
    double mean = 0.0;
    assert_true(zero->kind == HD_MODE_ZERO && zero->resolved);
    assert_int_equal(zero->col, POSITIVE);
    assert_int_equal(zero->count, ZEROS);
    for (int col = POSITIVE; col < POSITIVE + ZEROS; col++) {
        assert_int_equal(hd_steps_of_vector(steps, col), k);
        mean += hd_spectrum_exponent(hd_run_spectrum(run), col) / ZEROS;
    }
    CHECK_CLOSE(zero->exponent, mean, 1e-12);
    CHECK_CLOSE(zero->multiplicity, ZEROS, 1e-4 * ZEROS); /* vectors are orthonormal to 1e-6 */
}

TEST(the_zero_modes_may_be_more_than_a_set_has_vectors)
{
    const int exponents[] = {POSITIVE + ZEROS, ALL};
    for (int k = 0; k < 2; k++) {
        const hd_scene_def scene = scene_from(
            hd_scene_def_of(&of_free), .number = COUNT, .density = 0.5, .aspect = 1.0,
            .exponents = exponents[k], .equilibration = 1.0, .warmup = 50.0, .duration = 100.0,
            .threads = 1, .observe = HD_OBSERVE_STEPS);
        OWNED(hd_run) *run = until(created(scene), HD_AVERAGING);
        until_time(run, 80.0);
        check_zero_modes(run);
        OWNED(hd_run) *resumed = kept_and_resumed(run, PATH, &scene);
        check_zero_modes(resumed);
        expect_same_state(run, resumed);
        check_zero_modes(finish(resumed));
    }
    (void)remove(PATH);
}
