/** hd_dynamics_test: the rows of the core pass it, and so does the chain of the examples; of each
 * mistake that is made in it, the line names the member. */
#include "chain.h"

#include "hdlyap/dynamics_test.h"

static hd_status tested(const hd_scene_def *scene, char *message, size_t size)
{
    message[0] = 0;
    return hd_dynamics_test(hd_dynamics_of(scene), scene, message, size);
}

TEST(rows_of_the_core_pass)
{
    for (int kind = HD_DISKS; kind < HD_PARTICLES_END; kind++) {
        const hd_scene_def of = {.particles = (hd_particles)kind};
        hd_scene_def scene = hd_scene_def_of(hd_dynamics_of(&of));
        char message[256];
        scene.number = kind == HD_SOFT_SPHERES ? 108 : 32;
        scene.density = 0.4;
        scene.aspect = 1.0;
        const hd_status status = tested(&scene, message, sizeof message);
        assert_string_equal(message, "");
        CHECK_OK(status);
    }
}

TEST(the_chain_passes)
{
    char message[256];
    hd_scene_def scene = chain_of(N, 10.0, HD_EXPONENTS_ALL);
    const hd_status status = tested(&scene, message, sizeof message);
    assert_string_equal(message, "");
    CHECK_OK(status);
}

/* ---- mistakes ------------------------------------------------------------------------------ */

/** A chain with a mistake. */
static hd_dynamics wrong;

/** The line names the member, and says this of it. */
static void check_found(const char *line)
{
    hd_scene_def scene = chain_of(N, 10.0, HD_EXPONENTS_ALL);
    char message[256];
    scene.dynamics = &wrong;
    const hd_status status = tested(&scene, message, sizeof message);
    if (strncmp(message, line, strlen(line)) != 0) assert_string_equal(message, line);
    assert_int_equal(status, HD_REFUSED);
}

#define FOUND(line, ...)                                                                           \
    do {                                                                                           \
        wrong = of_chain;                                                                          \
        __VA_ARGS__;                                                                               \
        check_found(line);                                                                         \
    } while (0)

/** The second derivatives are 5 % too large. */
static void carry_too_stiff(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    spring *s = malloc(part->count * sizeof *s + 1);
    memcpy(s, part->entry, part->count * sizeof *s);
    for (size_t k = 0; k < part->count; k++) s[k].stiffness *= 1.05;
    hd_record_slice stiff = *part;
    stiff.entry = s;
    carry(&stiff, block, width);
    free(s);
}

/** A little friction in each step. */
static void carry_with_loss(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    const spring *s = part->entry;
    for (size_t k = 0; k < part->count; k += N) {
        const hd_record_slice one = {s + k, N, part->begin, part->end, N, part->scene};
        carry(&one, block, width);
        for (int j = 0; j < ROWS * width; j++) block[j] *= 1.0 - 1e-6;
    }
}

static void carry_more_often(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    carry(maps, block, width);
    drift(block, part->particles, width, 1e-4 * sqrt(part->end - part->begin));
}

static void carry_alone(const void *maps, double *block, int width)
{
    carry(maps, block, width);
    if (width == 1) block[0] += 1e-3;
}

static void carry_nothing(const void *maps, double *block, int width)
{
    (void)maps, (void)width;
    block[0] = NAN;
}

static void tell_nothing(const void *state, double *q, double *p)
{
    tell(state, q, p);
    if (q) q[0] = NAN;
}

static void examine_nothing(const void *state, hd_invariants *examined)
{
    *examined = (hd_invariants){.kinetic_energy = state ? 1.0 : 0.0};
}

static uint32_t no_fingerprint(const void *state) { return state ? 1 : 0; }

/** Of a row that tells all of itself, so that nobody else looks at its q and p. */
TEST(a_state_that_is_not_a_number_is_found)
{
    FOUND("advance: q and p differ by nan if ", wrong.state = tell_nothing;
          wrong.examine = examine_nothing; wrong.fingerprint = no_fingerprint);
}

TEST(maps_that_are_wrong_are_found)
{
    FOUND("carry: differs from trajectories that start nearby by ", wrong.carry = carry_too_stiff);
    FOUND("symplectic: must be false: S^T J S differs from J by ", wrong.carry = carry_with_loss);
    FOUND("carry: a record of 15 time units that is cut into parts carries vectors otherwise, by ",
          wrong.carry = carry_more_often);
    FOUND("carry: a vector alone is carried otherwise than among 8, by ",
          wrong.carry = carry_alone);
    FOUND("carry: a component of a tangent vector is not finite", wrong.carry = carry_nothing);
}

/** Half of the last step is done, too. */
static hd_status advance_to_the_end(void *state, hd_record *record, double t_end)
{
    chain *c = state;
    const hd_status status = advance(state, record, t_end);
    drift(c->x, c->count, 1, t_end - c->steps * c->step);
    return status;
}

static hd_status advance_not(void *state, hd_record *record, double t_end)
{
    (void)state, (void)t_end;
    if (record) hd_record_end(record, hd_record_duration(record));
    return HD_OK;
}

static hd_status advance_too_long(void *state, hd_record *record, double t_end)
{
    const hd_status status = advance(state, record, t_end);
    if (record) hd_record_end(record, hd_record_duration(record) + 7.0);
    return status;
}

static hd_status advance_backwards(void *state, hd_record *record, double t_end)
{
    const hd_status status = advance(state, record, t_end);
    const spring s = {0.0, 0.0, 0.0};
    return record && status == HD_OK ? hd_record_put(record, &s) : status;
}

static void examine_lost(const void *state, hd_invariants *examined)
{
    *examined = (hd_invariants){.energy_error = 1e-3 * now(state)};
}

static double a_step(const hd_scene_def *scene) { return scene->own[STEP].real; }

TEST(motion_that_is_wrong_is_found)
{
    FOUND("advance: q and p differ by ", wrong.advance = advance_to_the_end);
    FOUND("advance: q and p differ by ", wrong.advance = advance_to_the_end; wrong.step = a_step);
    FOUND("advance: time: not what advance was asked for: it is 0, and must be 50",
          wrong.advance = advance_not);
    FOUND("advance: hd_record_end: another duration than advance was asked for: it is 12, and "
          "must be 5",
          wrong.advance = advance_too_long);
    FOUND("advance: hd_record_put: an entry is earlier than the last one, or not a number: at 0",
          wrong.advance = advance_backwards);
    FOUND("advance: the energy is not conserved", wrong.examine = examine_lost);
}

static void archive_without_steps(void *state, hd_archive *file)
{
    chain *c = state;
    hd_archive_doubles(file, "chain time", &c->now, 1);
    hd_archive_doubles(file, "chain q p", c->x, 2 * (size_t)c->count);
}

static void archive_without_last(void *state, hd_archive *file)
{
    chain *c = state;
    hd_archive_doubles(file, "chain time", &c->now, 1);
    hd_archive_doubles(file, "chain steps", &c->steps, 1);
    hd_archive_doubles(file, "chain q p", c->x, 2 * (size_t)c->count - 1);
}

static void archive_nothing_finite(void *state, hd_archive *file)
{
    double none = NAN;
    archive(state, file);
    hd_archive_doubles(file, "chain of nothing", &none, 1);
}

TEST(what_the_archive_forgets_is_found)
{
    FOUND(
        "archive: a state that was written and read into a new one cannot go on: hd_record_put: an "
        "entry is earlier",
        wrong.archive = archive_without_steps);
    FOUND("archive: 0 time units after a state was written and read into a new one, the two differ "
          "in q and p, q and p by ",
          wrong.archive = archive_without_last);
    FOUND("archive: writing, the array chain of nothing: a number is not finite",
          wrong.archive = archive_nothing_finite);
}

static int six_zeros(const hd_scene_def *scene) { return scene ? 6 : 0; }
static int two_zeros(const hd_scene_def *scene) { return scene ? 2 : 0; }

/** A shift of all; and a shift of half of them, which comes apart. */
static int a_wrong_null_vector(const hd_scene_def *scene, const double *q, const double *p,
                               double *column)
{
    (void)q, (void)p;
    for (int row = 0; row < ROWS; row++) {
        column[row] = row % 2 == 0;
        column[ROWS + row] = row % 2 == 0 && row < N;
    }
    return scene ? 2 : 0;
}

static int many_null_vectors(const hd_scene_def *scene, const double *q, const double *p,
                             double *column)
{
    (void)q, (void)p;
    for (int k = 0; k < 5 * ROWS; k++) column[k] = k;
    return scene ? 5 : 0;
}

TEST(zeros_and_null_vectors_that_are_wrong_are_found)
{
    FOUND("zero_exponents = 6: must be less: number 6 by size is 0.1",
          wrong.zero_exponents = six_zeros);
    FOUND("zero_exponents = 2: must be 4: so many are below ", wrong.zero_exponents = two_zeros);
    FOUND("zero_exponents = 0: must be 4: so many are below ", wrong.zero_exponents = NULL);
    FOUND("null_vectors: vector 1 is carried out of the span of the later ones by ",
          wrong.null_vectors = a_wrong_null_vector);
    FOUND("null_vectors = 5: must be from 0 to zero_exponents = 4",
          wrong.null_vectors = many_null_vectors);
}

TEST(members_and_scenes_are_checked_first)
{
    char message[256];
    FOUND("carry: must not be NULL", wrong.carry = NULL);
    assert_int_equal(hd_dynamics_test(NULL, NULL, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "dynamics: must not be NULL");
    const hd_scene_def disks = hd_scene_def_default();
    assert_int_equal(hd_dynamics_test(&of_chain, &disks, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "particles = disks: must be chain, as the row is tested on them");
    hd_scene_def scene = chain_of(2, 10.0, HD_EXPONENTS_ALL);
    assert_int_equal(tested(&scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "number = 2: must be 3 or more with particles = chain");
}
