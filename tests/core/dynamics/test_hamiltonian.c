/** Rows that hdlyap/hamiltonian.h makes: their trajectories, energies, exponents and checkpoints;
 * the chain of the examples against one by hand. */
#include "hamiltonians.h"

extern const hd_dynamics *const chain_by_hand;

/* ---- trajectories -------------------------------------------------------------------------- */

static void start_by_hand(const hd_scene_def *scene, double *q, double *p)
{
    void *by_hand = state_of(&(hd_scene_def){
        .number = scene->number,
        .seed = scene->seed,
        .dynamics = chain_by_hand,
        .own = {
            [BETA] = scene->own[BETA], [ENERGY] = scene->own[ENERGY], [STEP] = scene->own[STEP]}});
    chain_by_hand->state(by_hand, q, p);
    free(by_hand);
}

/** The chain by forces as it starts by hand, so that both move alike. */
static hd_scene_def pair_of(hd_scene_def *by_hand, int number, double duration)
{
    static hd_hamiltonian starts;
    static hd_dynamics row;
    starts = *of_chain.hamiltonian;
    starts.start = start_by_hand;
    row = of_chain;
    row.hamiltonian = &starts;
    hd_scene_def scene = chain_scene(number, 0, 0.005);
    scene.dynamics = &row;
    scene.duration = duration;
    *by_hand = scene;
    by_hand->dynamics = chain_by_hand;
    return scene;
}

/** To rounding, which grows as exp(0.63 t): after 10 time units by 600. */
TEST(the_chain_moves_as_by_hand)
{
    hd_scene_def by_hand;
    const hd_scene_def scene = pair_of(&by_hand, 8, 100.0);
    double q[2][8], p[2][8];
    for (int k = 0; k < 2; k++) {
        const hd_scene_def *of = k ? &by_hand : &scene;
        void *state = state_of(of);
        CHECK_OK(of->dynamics->advance(state, NULL, 4.9971));
        CHECK_OK(of->dynamics->advance(state, NULL, 10.001));
        CHECK_CLOSE(of->dynamics->time(state), 10.001, 0.0);
        of->dynamics->state(state, q[k], p[k]);
        of->dynamics->free(state);
    }
    for (int i = 0; i < 8; i++) {
        CHECK_CLOSE(q[0][i], q[1][i], 1e-10);
        CHECK_CLOSE(p[0][i], p[1][i], 1e-10);
    }
}

TEST(the_chain_has_the_exponents_of_the_one_by_hand)
{
    hd_scene_def by_hand;
    OWNED(hd_run) *run = finished(pair_of(&by_hand, 8, 4000.0));
    OWNED(hd_run) *twin = finished(by_hand);
    const hd_spectrum *a = hd_run_spectrum(run), *b = hd_run_spectrum(twin);
    assert_int_equal(hd_run_vectors(run), 16);
    for (int col = 0; col < 6; col++)
        CHECK_CLOSE(hd_spectrum_exponent(a, col), hd_spectrum_exponent(b, col),
                    4.0 * hypot(hd_spectrum_std_error(a, col), hd_spectrum_std_error(b, col)));
    for (int col = 6; col < 10; col++) CHECK_CLOSE(hd_spectrum_exponent(a, col), 0.0, 3e-3);
}

/** Whoever stops in between, the steps are the same bits. */
TEST(steps_do_not_depend_on_who_watches)
{
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = kind(k);
        const hd_dynamics *row = scene.dynamics;
        double q[2][60], p[2][60];
        void *once = state_of(&scene), *often = state_of(&scene);
        CHECK_OK(row->advance(once, NULL, 25.0));
        for (double t = 0.0; t < 25.0; t += 0.0371) CHECK_OK(row->advance(often, NULL, t));
        CHECK_OK(row->advance(often, NULL, 25.0));
        assert_int_equal(row->fingerprint(once), row->fingerprint(often));
        row->state(once, q[0], p[0]);
        row->state(often, q[1], p[1]);
        const size_t bytes = (size_t)(scene.number * row->coordinates) * sizeof(double);
        assert_memory_equal(q[0], q[1], bytes);
        assert_memory_equal(p[0], p[1], bytes);
        row->free(once);
        row->free(often);
    }
}

/* ---- energy and the time step -------------------------------------------------------------- */

/** H and kinetic + |potential| energy, with V computed here. */
static void energy_of(double *energy, double *size, const hd_scene_def *scene, const void *state)
{
    double q[60], p[60], f[60], kept[60], kinetic = 0.0;
    scene->dynamics->state(state, q, p);
    for (int k = 0; k < scene->number * scene->dynamics->coordinates; k++)
        kinetic += 0.5 * p[k] * p[k];
    const double v = scene->dynamics->hamiltonian->force(scene, q, f, kept);
    *energy = kinetic + v;
    *size = kinetic + fabs(v);
}

TEST(the_energy_error_is_that_of_the_state)
{
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = kind(k);
        void *state = state_of(&scene);
        double start, now, size;
        hd_invariants seen;
        energy_of(&start, &size, &scene, state);
        CHECK_OK(scene.dynamics->advance(state, NULL, 17.77));
        energy_of(&now, &size, &scene, state);
        scene.dynamics->examine(state, &seen);
        CHECK_CLOSE(seen.energy_error, (now - start) / size, 1e-14);
        CHECK_WITHIN(fabs(seen.energy_error), 1e-12, 1e-3);
        CHECK_CLOSE(seen.momentum[0], 0.0, k == OF_STARS ? 0.0 : 1e-11);
        scene.dynamics->free(state);
    }
}

/** To the end of runs that are much longer than the trial; and not much shorter than needed: of
 * order 2 and 4, tenfold steps would lose hundred and ten thousand times as much. */
TEST(the_step_follows_from_the_accuracy)
{
    const double accuracies[] = {1e-8, 1e-5, 1e-2}; /* which count as 1e-6, 1e-5, 1e-3 */
    for (int k = OF_CHAIN - 2; k < 2 * KINDS; k++) {
        hd_scene_def scene = kind(k % KINDS);
        if (k % KINDS == PEFRL) continue;
        double before = 0.0;
        if (k % KINDS != OF_ROTORS)
            scene.own[k % KINDS == OF_STARS ? 1 : INTEGRATOR].whole = k < KINDS;
        if (k % KINDS == VERLET) scene.own[STEP].real = 0.0;
        for (int a = 0; a < 3; a++) {
            scene.accuracy = accuracies[a];
            const double step = scene.dynamics->step(&scene);
            assert_true(step > before);
            before = step;
            OWNED(hd_run) *run = finished(scene_from(scene, .exponents = HD_EXPONENTS_NONE));
            const hd_energy energy = hd_trajectory_energy(hd_run_trajectory(run));
            CHECK_CLOSE(energy.asked, 10.0 * fmin(fmax(accuracies[a], 1e-6), 1e-3), 1e-18);
            CHECK_WITHIN(energy.most, 1e-3 * energy.asked, energy.asked);
        }
    }
}

/** Verlet's step is stable up to 2 / omega. */
TEST(a_run_that_loses_its_energy_ends)
{
    hd_scene_def scene = chain_scene(8, 0, 1.5);
    OWNED(hd_run) *run = created(scene);
    hd_status status = HD_OK;
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
    assert_int_equal(status, HD_ENERGY_LOST);
    assert_int_equal(hd_run_status(run), HD_ENERGY_LOST);
}

/* ---- zeros, null vectors ------------------------------------------------------------------- */

TEST(rotors_have_four_zeros)
{
    const hd_scene_def scene = scene_from(of_row(&of_rotors, 4), .duration = 4000.0);
    assert_int_equal(hd_scene_counts(&scene).zero, 4);
    OWNED(hd_run) *run = finished(scene);
    CHECK_WITHIN(hd_spectrum_exponent(hd_run_spectrum(run), 1), 0.01, 1.0);
    for (int col = 2; col < 6; col++)
        CHECK_CLOSE(hd_spectrum_exponent(hd_run_spectrum(run), col), 0.0, 4e-3);
    const hd_scene_def stars = kind(OF_STARS),
                       linear = scene_from(kind(VERLET), .own[BETA].real = 0);
    assert_int_equal(hd_scene_counts(&stars).zero, 2);
    for (int number = 1; number <= 2; number++) { /* which are all integrable */
        const hd_scene_def few = of_row(&of_rotors, number);
        assert_int_equal(hd_scene_counts(&few).zero, 2 * number);
    }
    assert_int_equal(hd_scene_counts(&linear).zero, 14);
}

TEST(covariant_vectors_hold_them)
{
    hd_scene_def scene = chain_scene(8, 0, 0.01);
    scene.observe = HD_OBSERVE_COVARIANT;
    scene.warmup = scene.covariant_transient = 100.0;
    OWNED(hd_run) *run = finished(scene);
    const hd_covariant_results found = hd_covariant_read(hd_run_covariant(run));
    CHECK_WITHIN(found.null, 0.0, 0.1);
    for (int col = 0; col < 16; col++)
        CHECK_CLOSE(hd_spectrum_exponent(found.spectrum, col),
                    hd_spectrum_exponent(hd_run_spectrum(run), col), 0.03);
}

/* ---- lambda_1 by a plain loop -------------------------------------------------------------- */

enum { Q = 0, P_ = 4, DQ = 8, DP = 12, ALL = 16 };

/** Time derivative of q, p, dq, dp of four rotors. */
static void rotors_flow(double *out, const double *x)
{
    memcpy(out + Q, x + P_, 4 * sizeof *x);
    memcpy(out + DQ, x + DP, 4 * sizeof *x);
    for (int i = 0; i < 4; i++) {
        const int l = (i + 3) % 4, r = (i + 1) % 4;
        out[P_ + i] = sin(x[r] - x[i]) - sin(x[i] - x[l]);
        out[DP + i] = cos(x[r] - x[i]) * (x[DQ + r] - x[DQ + i]) -
                      cos(x[i] - x[l]) * (x[DQ + i] - x[DQ + l]);
    }
}

static void rotors_runge_kutta(double *x, double h)
{
    const double part[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0, 2.0, 2.0, 1.0};
    double slope[ALL] = {0.0}, sum[ALL] = {0.0}, y[ALL];
    for (int s = 0; s < 4; s++) {
        for (int a = 0; a < ALL; a++) y[a] = x[a] + part[s] * h * slope[a];
        rotors_flow(slope, y);
        for (int a = 0; a < ALL; a++) sum[a] += weight[s] * h / 6.0 * slope[a];
    }
    for (int a = 0; a < ALL; a++) x[a] += sum[a];
}

/** By Runge and Kutta's method, the vector made a unit vector each time unit. */
TEST(the_largest_exponent_of_rotors_is_that_of_a_plain_loop)
{
    enum { TIMES = 20000, STEPS = 50 };
    const hd_scene_def scene = scene_from(of_row(&of_rotors, 4), .duration = TIMES);
    double x[ALL] = {[DQ] = 1.0, [DP + 1] = 1.0}, sum = 0.0;
    hd_hamiltonian_momenta(&scene, x + P_, 1.0); /* as the row does */
    for (int t = 0; t < TIMES; t++) {
        double square = 0.0;
        for (int s = 0; s < STEPS; s++) rotors_runge_kutta(x, 1.0 / STEPS);
        for (int a = DQ; a < ALL; a++) square += x[a] * x[a];
        for (int a = DQ; a < ALL; a++) x[a] /= sqrt(square);
        sum += 0.5 * log(square);
    }
    OWNED(hd_run) *run = finished(scene);
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    CHECK_CLOSE(hd_spectrum_exponent(spectrum, 0), sum / TIMES,
                4.0 * sqrt(2.0) * hd_spectrum_std_error(spectrum, 0));
    CHECK_WITHIN(hd_spectrum_std_error(spectrum, 0), 0.0, 0.05 * sum / TIMES);
}

/* ---- start, checkpoints, what is refused --------------------------------------------------- */

TEST(momenta_have_the_energy_and_no_sum)
{
    const hd_scene_def scene = of_row(&of_rotors, 50);
    double p[50], sum = 0.0, square = 0.0;
    hd_hamiltonian_momenta(&scene, p, 3.0);
    for (int i = 0; i < 50; i++) sum += p[i], square += p[i] * p[i];
    CHECK_CLOSE(sum, 0.0, 1e-12);
    CHECK_CLOSE(0.5 * square, 150.0, 1e-11);
}

/** At most 60 coordinates. */
static void check_same(const hd_run *a, const hd_run *b)
{
    double x[2][2][60] = {{{0.0}}};
    hd_trajectory_state(hd_run_trajectory(a), x[0][0], x[0][1]);
    hd_trajectory_state(hd_run_trajectory(b), x[1][0], x[1][1]);
    assert_memory_equal(x[0], x[1], sizeof x[0]);
    check_same_exponents(a, b, 0.0);
}

TEST(a_resumed_run_is_the_same)
{
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = scene_from(kind(k), .duration = 60.0, .warmup = 20.0);
        OWNED(hd_run) *alone = created(scene);
        OWNED(hd_run) *whole = finished(scene);
        for (double time = 7.0; time < 100.0; time += 23.7) {
            until_time(alone, time);
            CHECK_OK(hd_run_save(alone, "hamiltonian.ckpt", "", NULL, 0));
            OWNED(hd_run) *resumed = NULL;
            CHECK_OK(hd_run_resume(&resumed, "hamiltonian.ckpt", &scene, NULL, 0));
            check_same(finish(resumed), whole);
        }
        (void)remove("hamiltonian.ckpt");
    }
}

TEST(a_record_that_cannot_be_carried_is_refused)
{
    const hd_scene_def scene = kind(PEFRL); /* three entries a kick */
    void *state = state_of(&scene);
    hd_record *record;
    CHECK_OK(hd_record_create(&record, scene.dynamics->entry));
    CHECK_OK(scene.dynamics->advance(state, record, 0.1));
    double *entry = record->entry;
    assert_null(hd_record_fault(record, &scene));
    entry[HD_HAMILTONIAN_ENTRY + 4] = 1e9;
    assert_string_equal(hd_record_fault(record, &scene), "an entry has a wrong place in its kick");
    entry[HD_HAMILTONIAN_ENTRY + 4] = 60 - 27;
    entry[HD_HAMILTONIAN_ENTRY] -= 1e-3;
    entry[0] -= 1e-2;
    assert_string_equal(hd_record_fault(record, &scene),
                        "the entries of a kick have different times");
    entry[0] = entry[HD_HAMILTONIAN_ENTRY] = entry[2 * HD_HAMILTONIAN_ENTRY];
    record->count--;
    assert_string_equal(hd_record_fault(record, &scene), "the last kick is not complete");
    hd_record_free(record);
    scene.dynamics->free(state);
}

static hd_status refuse_odd(const hd_scene_def *scene, char *message, size_t size)
{
    if (scene->number % 2 == 0) return HD_OK;
    snprintf(message, size, "number = %d: must be even", scene->number);
    return HD_REFUSED;
}

TEST(what_does_not_fit_is_refused)
{
    char message[256];
    hd_run *run;
    hd_scene_def scene = chain_scene(2, 0, 0.01);
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "number = 2: must be 3 or more with particles = chain");
    scene = chain_scene(8, 2, 0.01);
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "integrator = 2: must be verlet or pefrl");
    hd_hamiltonian choosy = *of_rotors.hamiltonian;
    hd_dynamics row = of_rotors;
    choosy.check = refuse_odd;
    row.hamiltonian = &choosy;
    scene = of_row(&row, 5);
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "number = 5: must be even");
}

/* ---- in a box ------------------------------------------------------------------------------ */

static void in_box_start(const hd_scene_def *scene, double *q, double *p)
{
    (void)q;
    hd_hamiltonian_momenta(scene, p, 0.5);
}

/** No forces: particles fly through a periodic box. */
static double in_box_force(const hd_scene_def *scene, const double *q, double *f, double *kept)
{
    (void)scene, (void)q, (void)f, (void)kept;
    return 0.0;
}

static void in_box_bend(const double *kept, double time, const double *restrict dq,
                        double *restrict dp, int n, int width)
{
    (void)kept, (void)time, (void)dq, (void)dp, (void)n, (void)width;
}

HD_HAMILTONIAN(of_box, in_box_bend,
               (.start = in_box_start, .force = in_box_force, .growth = rotors_growth),
               .particles = "motes", .dimension = 2, .coordinates = 2);

/** They start at 0; all is exact but for rounding. */
TEST(positions_are_in_the_box)
{
    const hd_scene_def scene = scene_from(of_row(&of_box, 3), .density = 0.1, .aspect = 0.8);
    const double step = of_box.step(&scene), time = step * floor(50.0 / step);
    double box[HD_DIMENSION_MAX], q[6], p[6];
    void *state = state_of(&scene);
    hd_scene_box(&scene, box);
    CHECK_OK(of_box.advance(state, NULL, 50.0));
    of_box.state(state, q, p);
    for (int k = 0; k < 6; k++) {
        const double turns = (time * p[k] - q[k]) / box[k % 2];
        CHECK_WITHIN(q[k], 0.0, box[k % 2]);
        CHECK_CLOSE(turns, round(turns), 1e-12);
    }
    of_box.free(state);
}
