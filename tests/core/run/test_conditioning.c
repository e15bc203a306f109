/** Frames at and beyond what double precision can factor: the exact spectrum, or a fault with a
 * name. Intervals are forced and frames broken, which no caller can. */
#include "exact.h"
#include "runs.h"

enum { VECTORS_MAX = 64 };

/* ---- whole runs ---------------------------------------------------------------------------- */

/** Few vectors: extended precision is slow. */
static hd_scene_def small_scene(int disks, int walls, int exponents, uint64_t seed)
{
    return scene_from(box_of(disks, disks < 5 ? 0.3 : 0.6, 1.0, 1.0, walls, seed),
                      .exponents = exponents, .equilibration = 10.0, .warmup = 50.0,
                      .duration = 50.0, .report_interval = 50.0, .threads = 1);
}

/** Of spheres half as many: they have as many vectors. */
enum { TEN = 10 / (DIM - 1) };

/** Every step goes on in time. */
static hd_status finish_forced(hd_run *run, double forced)
{
    hd_status status = HD_OK;
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) {
        const double before = hd_run_time(run);
        if (forced > 0.0 && hd_run_stage(run) > HD_EQUILIBRATING) force_interval(run, forced);
        status = hd_run_advance(run);
        assert_true(hd_run_time(run) > before);
    }
    return status;
}

static double deviation(const hd_run *run, const double *exact)
{
    double worst = 0.0;
    for (int col = 0; col < run->carrier.vectors; col++) {
        const double off = fabs(hd_spectrum_exponent(run->carrier.spectrum, col) - exact[col]);
        assert_true(isfinite(off));
        worst = fmax(worst, off);
    }
    return worst;
}

/** What double precision leaves of these spectra, where neighbouring vectors change places:
 * Householder reflections every 0.05 are off by 8e-13, four of 480 runs with other seeds by 1e-12
 * to 6e-12; twice that. */
static const double DOUBLE = 1.2e-11;

/** Returns the number of repairs. */
static long check_forced(hd_scene_def scene, const double *exact, double forced)
{
    OWNED(hd_run) *run = created(scene);
    CHECK_OK(finish_forced(run, forced));
    const double off = deviation(run, exact), bound = hd_run_cost(run).error_bound;
    const double tolerance = fmax(scene.accuracy, DOUBLE);
    CHECK_CLOSE(off, 0.0, tolerance);
    CHECK_CLOSE(off, 0.0, bound);
    return run->cost.repairs;
}

/** Forced on the run, each is repaired to the accuracy asked for. */
TEST(any_forced_interval_gives_the_exact_spectrum)
{
    static const struct {
        int disks, walls, exponents;
        uint64_t seed;
    } scenes[] = {{3, 0, HD_EXPONENTS_POSITIVE, 1},
                  {3, ALL_WALLS, HD_EXPONENTS_ALL, 2},
                  {TEN, 0, HD_EXPONENTS_POSITIVE, 2},
                  {TEN, 0, HD_EXPONENTS_ALL, 2},
                  {3, 0, HD_EXPONENTS_ALL_INDEPENDENT, 3}};
    static const double forced[] = {0.0, 0.01, 0.1, 0.3, 1.0, 2.0, 8.0, 25.0, 50.0};
    static const double accuracies[] = {1e-3, 1e-8, 1e-12};
    double exact[VECTORS_MAX];
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        hd_scene_def scene = small_scene(scenes[s].disks, scenes[s].walls, scenes[s].exponents,
                                         scenes[s].seed);
        exact_spectrum(&scene, exact);
        assert_true(exact[0] > 0.1);
        for (int a = 0; a < 3; a++) {
            long repairs = 0;
            scene.accuracy = accuracies[a];
            for (size_t k = 0; k < sizeof forced / sizeof *forced; k++)
                repairs += check_forced(scene, exact, forced[k]);
            assert_true(repairs > 0 || a == 0);
        }
    }
}

TEST(a_circle_has_the_exact_spectrum)
{
    if (DIM == 3) skip();
    static const int exponents[] = {HD_EXPONENTS_POSITIVE, HD_EXPONENTS_ALL};
    double exact[VECTORS_MAX];
    for (int k = 0; k < 2; k++) {
        const hd_scene_def small = small_scene(10, 0, exponents[k], 3);
        const hd_scene_def scene = scene_from(small, .container = HD_CIRCLE,
                                              .aspect = hd_scene_def_default().aspect);
        exact_spectrum(&scene, exact);
        check_forced(scene, exact, 0.0);
        check_forced(scene, exact, 25.0);
    }
}

/** What is not carried changes places with the last vector, too [T6]. Which runs do depends on the
 * last bits, so on the processor: with four of OpenBLAS's kernels 2 to 4 of 100 were seen; of 20,
 * 1 to 2. */
TEST(few_vectors_rarely_exceed_the_bound)
{
    const uint64_t runs = 100;
    int above = 0;
    double exact[VECTORS_MAX];
    if (DIM == 3) skip();
    for (uint64_t seed = 1; seed <= runs; seed++) {
        hd_scene_def scene = small_scene(5, ALL_WALLS, seed % 2 ? 4 : 2, seed);
        scene.density = 0.85;
        exact_spectrum(&scene, exact);
        OWNED(hd_run) *run = created(scene);
        CHECK_OK(finish_forced(run, 0.0));
        const double off = deviation(run, exact), bound = hd_run_cost(run).error_bound;
        above += off > bound;
        assert_true(off <= fmin(scene.accuracy, 10.0 * bound));
    }
    assert_true(above <= (int)runs / 20);
}

/** Grazing collisions shorten an interval, which must not make the next one look too long: ever
 * shorter ones only add up more rounding. Seen: 0.74 to 0.86 collisions of a disk, and 0.08 to 0.13
 * where they went on shrinking. */
TEST(intervals_grow_again_after_grazing_collisions)
{
    for (uint64_t seed = 1; seed <= 5; seed++) {
        hd_scene_def scene = scene_from(small_scene(TEN, 0, HD_EXPONENTS_ALL, seed),
                                        .accuracy = 1e-12);
        OWNED(hd_run) *run = created(scene);
        CHECK_OK(finish_forced(run, 0.0));
        const double per_disk = 2.0 *
                                (double)hd_trajectory_totals(run->advance.trajectory).collisions /
                                scene.number * 100.0 / 110.0;
        const double between = per_disk / (double)run->cost.orthonormalisations;
        assert_true(between > 0.25);
    }
}

/** Halving ends above half of an eighth of the interval, or of a collision of each disk. */
TEST(pieces_are_no_shorter_than_helps)
{
    long most = 0;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        OWNED(hd_run) *run = created(
            scene_from(small_scene(TEN, 0, HD_EXPONENTS_ALL_INDEPENDENT, seed), .accuracy = 1e-12));
        const double collision = run->carrier.collision;
        while (hd_run_stage(run) != HD_FINISHED) {
            const long before = run->cost.orthonormalisations;
            const double begin = hd_run_time(run) - run->carrier.record->duration;
            CHECK_OK(hd_run_advance(run));
            const double length = hd_run_time(run) - begin;
            const long pieces = run->cost.orthonormalisations - before;
            assert_true((double)pieces <= fmax(16.0, 2.0 * length / collision));
            most = pieces > most ? pieces : most;
        }
    }
    assert_true(most > 4);
}

/** Pieces of a repair whose lengths added up to the interval but for rounding left a last piece of
 * 4e-16, and the next interval, twice as long, did not move the time: a run that hung. */
TEST(no_crumb_of_rounding_stops_the_run)
{
    OWNED(hd_run) *run = created(scene(.number = 24, .density = 0.7, .aspect = 1.0,
                                       .exponents = HD_EXPONENTS_ALL_INDEPENDENT,
                                       .equilibration = 10.0, .warmup = 20.0, .duration = 10.0,
                                       .accuracy = 1e-12, .threads = 1));
    CHECK_OK(finish_forced(run, 0.0));
    assert_true(run->cost.repairs > 0);
}

/** Each of these has an interval whose eighth stretches by more than 1e13. */
TEST(several_grazes_in_an_interval_are_divided)
{
    const uint64_t seeds[] = {159, 284};
    if (DIM == 3) skip();
    for (int k = 0; k < 2; k++) {
        hd_scene_def scene = scene_of(3, 0.001, 1.0, P, P, seeds[k]);
        const double time = 300.0 / (3.5 * scene.density);
        scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
        scene.equilibration = scene.warmup = 0.0;
        scene.duration = scene.report_interval = time;
        OWNED(hd_run) *run = finished(scene);
        CHECK_CLOSE(hd_spectrum_sum_up(hd_run_spectrum(run)).pairing_error * time, 0.0, 12.0);
    }
}

/** A frame whose second vector leans into the first to within delta: the spans are the same, so is
 * the spectrum, but for what rounding took, which the bound knows; or no step may factor it.
 * Returns the deviation, -1 for the fault. */
static double leaning_start(const hd_scene_def *scene, const double *exact, double delta)
{
    OWNED(hd_run) *run = created(*scene);
    double *v = hd_frame_data(run->carrier.frame);
    for (int row = 0; row < hd_frame_rows(run->carrier.frame);
         row++, v += hd_frame_stride(run->carrier.frame))
        v[1] = v[0] + delta * v[1];
    const hd_status status = finish_forced(run, 0.0);
    double off = -1.0;
    if (status == HD_OK) {
        off = deviation(run, exact);
        CHECK_CLOSE(off, 0.0, hd_run_cost(run).error_bound);
    } else {
        assert_int_equal(status, HD_ILL_CONDITIONED);
        CHECK_CLOSE(hd_spectrum_time(run->carrier.spectrum), 0.0, 0.0);
    }
    return off;
}

TEST(nearly_dependent_start_vectors_are_separated_or_refused)
{
    double exact[VECTORS_MAX];
    const int frames = VERIFIES ? 1 : 2; /* all vectors together have a volume */
    for (int all = 0; all < frames; all++) {
        const hd_scene_def scene = small_scene(TEN, 0,
                                               all ? HD_EXPONENTS_ALL : HD_EXPONENTS_POSITIVE, 4);
        exact_spectrum(&scene, exact);
        for (int k = 1; k <= 16; k++) {
            const double off = leaning_start(&scene, exact, k < 16 ? pow(10.0, -k) : 0.0);
            if (k <= 11) assert_true(off >= 0);
            if (k >= 15) assert_true(off < 0);
        }
    }
}

/* ---- a frame that breaks in mid-run -------------------------------------------------------- */

typedef enum breakage {
    ZERO_COLUMN,
    TWINS,
    COMBINATION,
    ALL_ZERO,
    NOT_A_NUMBER,
    INFINITE,
    HUGE_ENTRY,
    HUGE_COLUMN,
    BREAKAGES
} breakage;

static void break_row(double *v, int row, int n, breakage how)
{
    switch (how) {
    case ZERO_COLUMN: v[n / 2] = 0.0; break;
    case TWINS: v[n - 1] = v[0]; break;
    case COMBINATION: v[n - 1] = 0.3 * v[0] - 2.0 * v[1] + v[n / 2]; break;
    case ALL_ZERO: memset(v, 0, (size_t)n * sizeof *v); break;
    case NOT_A_NUMBER:
        if (row == 5) v[n / 2] = NAN;
        break;
    case INFINITE:
        if (row == 5) v[0] = -INFINITY;
        break;
    case HUGE_ENTRY:
        if (row == 5) v[1] = 1e300;
        break;
    default: v[n - 1] *= 1e200; break;
    }
}

static void break_frame(hd_frame *frame, breakage how)
{
    for (int row = 0; row < hd_frame_rows(frame); row++)
        break_row(hd_frame_data(frame) + row * hd_frame_stride(frame), row, hd_frame_vectors(frame),
                  how);
}

/** The fault has its name, and nothing of the broken vectors reaches an exponent. */
TEST(a_broken_frame_is_a_named_fault)
{
    if (VERIFIES) skip();
    for (int all = 0; all < 2; all++)
        for (breakage how = 0; how < BREAKAGES; how++) {
            hd_scene_def scene = small_scene(TEN, 0, all ? HD_EXPONENTS_ALL : HD_EXPONENTS_POSITIVE,
                                             1);
            scene.report_interval = 1.0;
            OWNED(hd_run) *run = created(scene);
            double before[VECTORS_MAX];
            while (!run->carrier.spectrum || hd_spectrum_time(run->carrier.spectrum) < 5.0)
                CHECK_OK(hd_run_advance(run));
            for (int col = 0; col < run->carrier.vectors; col++)
                before[col] = hd_spectrum_exponent(run->carrier.spectrum, col);
            const double time = hd_spectrum_time(run->carrier.spectrum);
            break_frame(run->carrier.frame, how);
            assert_int_equal(finish_forced(run, 0.0), how == NOT_A_NUMBER || how == INFINITE
                                                          ? HD_NOT_FINITE
                                                          : HD_ILL_CONDITIONED);
            CHECK_CLOSE(hd_spectrum_time(run->carrier.spectrum), time, 0.0);
            for (int col = 0; col < run->carrier.vectors; col++)
                CHECK_CLOSE(hd_spectrum_exponent(run->carrier.spectrum, col), before[col], 0.0);
            assert_true(isfinite(hd_run_cost(run).error_bound));
        }
}

/* ---- single factorisations ----------------------------------------------------------------- */

enum { DISKS = 12, ROWS = ROWS_OF_ONE * DISKS, COLUMNS = 20 }; /* panels of 8 */

typedef struct factors {
    hd_frame *frame;
    hd_ortho *ortho;
} factors;

static factors factors_create(void)
{
    factors f;
    CHECK_OK(hd_frame_create(&f.frame, PARTICLES(DISKS), COLUMNS, 11, 1));
    CHECK_OK(hd_ortho_create(&f.ortho, ROWS, COLUMNS));
    return f;
}

static void factors_free(factors *f)
{
    hd_ortho_free(f->ortho);
    hd_frame_free(f->frame);
}

/** By Cholesky or by reflections, with the limits that a run gives them at most. */
static hd_status factor(factors *f, bool stable)
{
    const hd_ortho_limits limits = {1e12, 1e-4, HD_NORM_FULL};
    return stable ? hd_ortho_step_stable(f->ortho, f->frame, HD_CONDITION_STABLE)
                  : hd_ortho_step(f->ortho, f->frame, limits);
}

/** Logarithms off by eps condition, up to 32 times for the sums over rows, as in test_ortho; and by
 * their own rounding. */
static void check_logarithms(factors *f, hd_exact *v)
{
    const double rounding = 32 * DBL_EPSILON * hd_ortho_condition(f->ortho);
    hd_exact want[COLUMNS] = {0.0L};
    exact_orthonormalise(v, ROWS, COLUMNS, want);
    for (int col = 0; col < COLUMNS; col++) {
        const double got = hd_ortho_log_stretch(f->ortho)[col];
        const double tolerance = rounding + 2 * DBL_EPSILON * fabs(got);
        CHECK_CLOSE(got, (double)want[col], tolerance);
    }
}

/** Column `to` leans into column `from`; false if refused. */
static bool lean(int from, int to, double delta, bool stable)
{
    HELD(factors) f = factors_create();
    double *v = hd_frame_data(f.frame);
    for (int row = 0; row < ROWS; row++, v += hd_frame_stride(f.frame))
        v[to] = v[from] + delta * v[to];
    HEAP hd_exact *copy = exact_copy(f.frame);
    const hd_status status = factor(&f, stable);
    if (status == HD_OK) {
        check_logarithms(&f, copy);
        assert_true(hd_ortho_condition(f.ortho) >= 0.1 / delta);
        assert_true(hd_ortho_defect_measured(f.ortho, f.frame, HD_NORM_FULL) <=
                    hd_ortho_defect(f.ortho) + 16 * DBL_EPSILON);
    } else {
        assert_int_equal(status, HD_ILL_CONDITIONED);
    }
    return status == HD_OK;
}

/** Two vectors of one panel, or of two: Cholesky alone refuses the first from 1e7 on, what has been
 * projected out of an earlier panel is as good as reflections. Refused or right, at every distance.
 */
TEST(nearly_dependent_vectors_are_right_or_refused)
{
    static const int pairs[][2] = {{0, 1}, {2, 6}, {3, 12}, {1, 19}, {17, 18}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++)
        for (int stable = 0; stable < 2; stable++)
            for (int digits = 0; digits <= 16; digits++) {
                const double delta = digits < 16 ? pow(10.0, -digits) : 0.0;
                const bool right = lean(pairs[k][0], pairs[k][1], delta, stable);
                if (digits <= 6 || (stable && digits <= 11)) assert_true(right);
                if (digits >= 15) assert_false(right);
            }
}

/** The whole frame times 10^digits: logarithms move by as much, up to where squares leave the
 * numbers. */
static bool scaled_is_right(int digits, bool stable)
{
    HELD(factors) f = factors_create();
    double *v = hd_frame_data(f.frame);
    for (int k = 0; k < ROWS * hd_frame_stride(f.frame); k++) v[k] *= pow(10.0, digits);
    HEAP hd_exact *copy = exact_copy(f.frame);
    const hd_status status = factor(&f, stable);
    if (status == HD_OK)
        check_logarithms(&f, copy);
    else
        assert_int_equal(status, HD_ILL_CONDITIONED);
    return status == HD_OK;
}

TEST(any_scale_is_right_or_refused)
{
    for (int digits = -320; digits <= 308; digits += 4)
        for (int stable = 0; stable < 2; stable++) {
            const bool ok = scaled_is_right(digits, stable);
            if (abs(digits) <= 130) assert_true(ok);
            if (abs(digits) >= 156) assert_false(ok);
        }
}

int main(int argc, char **argv)
{
    hd_blas_use_threads(1);
    return tests_run(argc > 1 ? argv[1] : NULL);
}
