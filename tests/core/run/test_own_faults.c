/** Rows that cannot be right, or whose functions do what they must not: one line that names the
 * member when a run is made, or a status at the advance in which it happens. */
#include "chain.h"

/* ---- members ------------------------------------------------------------------------------- */

/** The line is said by whatever is made of the row. */
static void check_said(const hd_dynamics *row, const char *line)
{
    char message[256] = "";
    hd_trajectory *trajectory;
    assert_int_equal(hd_dynamics_check(row, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, line);
    const hd_scene_def scene = hd_scene_def_of(row);
    check_refused(scene, line);
    assert_int_equal(hd_trajectory_create(&trajectory, &scene), HD_REFUSED);
}

/** A chain with this change. */
#define SAYS(line, ...)                                                                            \
    do {                                                                                           \
        hd_dynamics row = of_chain;                                                                \
        __VA_ARGS__;                                                                               \
        check_said(&row, line);                                                                    \
    } while (0)

static void examine(const void *state, hd_invariants *examined) { (void)state, (void)examined; }
static double one(const hd_scene_def *scene) { return scene ? 1.0 : 0.0; }

TEST(a_member_that_is_missing_is_named)
{
    char message[256];
    CHECK_OK(hd_dynamics_check(&of_chain, NULL, 0));
    assert_int_equal(hd_dynamics_check(NULL, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "dynamics: must not be NULL");
    SAYS("particles: must not be NULL", row.particles = NULL);
    SAYS("record_rate: must not be NULL", row.record_rate = NULL);
    SAYS("collision_rate: must not be NULL", row.collision_rate = NULL);
    SAYS("create: must not be NULL", row.create = NULL);
    SAYS("free: must not be NULL", row.free = NULL);
    SAYS("advance: must not be NULL", row.advance = NULL);
    SAYS("time: must not be NULL", row.time = NULL);
    SAYS("state: must not be NULL", row.state = NULL);
    SAYS("archive: must not be NULL", row.archive = NULL);
    SAYS("carry: must not be NULL", row.carry = NULL);
    SAYS("maps_create: must not be NULL unless maps_free and maps_fill are",
         row.maps_fill = hd_disks_row.maps_fill);
    SAYS("totals: must not be NULL if collides is true", row.collides = true);
    SAYS("null_vectors: must be NULL without zero_exponents",
         row.null_vectors = hd_disks_row.null_vectors;
         row.zero_exponents = NULL);
    SAYS("energy_asked: must be NULL without examine, which tells the error of the energy",
         row.energy_asked = one);
}

TEST(a_member_out_of_its_range_is_named)
{
    SAYS("particles = chains of more than thirty-one l: must have from 1 to 31 characters",
         row.particles = "chains of more than thirty-one letters");
    SAYS("particles = : must have from 1 to 31 characters", row.particles = "");
    SAYS("particles = spheres: must not be those of the core", row.particles = "spheres");
    SAYS("dimension = 1: must be 0, 2 or 3", row.dimension = 1);
    SAYS("coordinates = 1001: must be from 1 to 1000 with dimension = 0", row.coordinates = 1001);
    SAYS("coordinates = 1: must be from 2 to 1000 with dimension = 2", row.dimension = 2);
    SAYS("entry = 12: must be a multiple of 8, because an entry consists of doubles and begins "
         "with its time",
         row.entry = 12);
    SAYS("parameters = -1: must be from 0 to 16", row.parameters = -1);
    SAYS("parameters = 17: must be from 0 to 16", row.parameters = 17);
    SAYS("parameter: must not be NULL with parameters = 3", row.parameter = NULL);
    SAYS("inertia: must be NULL unless dimension is 2 and coordinates are 3", row.inertia = one);
}

/** Parameter 1 with this change. */
#define SAYS_OF_PARAMETER(line, ...)                                                               \
    do {                                                                                           \
        hd_parameter own[PARAMETERS], *p = &own[1];                                                \
        memcpy(own, parameters, sizeof own);                                                       \
        __VA_ARGS__;                                                                               \
        SAYS("parameter[1]." line, row.parameter = own);                                           \
    } while (0)

TEST(a_parameter_that_cannot_be_is_named)
{
    SAYS_OF_PARAMETER("name: must not be NULL", p->name = NULL);
    SAYS_OF_PARAMETER("name: must not be empty", p->name = "");
    SAYS_OF_PARAMETER("range: must not be NULL", p->range = NULL);
    SAYS_OF_PARAMETER("unit: must not be NULL; \"\" is none", p->unit = NULL);
    SAYS_OF_PARAMETER("text: must not be NULL", p->text = NULL);
    SAYS_OF_PARAMETER("words: must not be NULL for HD_PARAMETER_WORD", p->kind = HD_PARAMETER_WORD);
    SAYS_OF_PARAMETER("kind: must be HD_PARAMETER_INT, _REAL, _WORD or _INTERVAL",
                      p->kind = HD_PARAMETER_SEED);
    SAYS_OF_PARAMETER("offset: must be HD_OWN(k), k = 0 .. 15", p->offset = 0);
    SAYS_OF_PARAMETER("offset: must be HD_OWN(k), k = 0 .. 15", p->offset = HD_OWN(0) + 4);
    SAYS_OF_PARAMETER("default_value: must be a number that the parameter can hold",
                      p->default_value = NAN);
    SAYS_OF_PARAMETER("live: must be false", p->live = true);
    SAYS_OF_PARAMETER("name = beta: must not be that of parameter[0]", p->name = "beta");
    SAYS_OF_PARAMETER("name = seed: must not be that of a parameter of all scenes",
                      p->name = "seed");
    SAYS_OF_PARAMETER("offset: must not be that of parameter[0]", p->offset = HD_OWN(BETA));
}

/** Of several rows one that cannot be right is not looked at. */
TEST(a_row_that_cannot_be_is_not_searched_for_by_name)
{
    const hd_dynamics nameless = {.particles = NULL};
    const hd_dynamics *const rows[] = {NULL, &nameless, &of_chain};
    const hd_dynamics *found;
    assert_true(hd_dynamics_named(&found, "chain", (hd_known){rows, 3}));
    assert_ptr_equal(found, &of_chain);
}

/* ---- numbers of a scene -------------------------------------------------------------------- */

static double number;
static double told(const hd_scene_def *scene) { return scene ? number : 0.0; }
static int told_whole(const hd_scene_def *scene) { return scene ? (int)number : 0; }

#define REFUSES(value, line, ...)                                                                  \
    do {                                                                                           \
        hd_dynamics row = of_chain;                                                                \
        hd_scene_def scene = chain_of(N, 10.0, HD_EXPONENTS_ALL);                                  \
        scene.dynamics = &row;                                                                     \
        row.examine = examine;                                                                     \
        number = (value);                                                                          \
        __VA_ARGS__;                                                                               \
        check_refused(scene, line);                                                                \
    } while (0)

TEST(a_number_that_cannot_be_is_named)
{
    const char *even = "zero_exponents = 3: must be even, because exponents of symplectic maps "
                       "come in pairs";
    REFUSES(3, even, row.zero_exponents = told_whole);
    REFUSES(-2, "zero_exponents = -2: must be from 0 to 16, all exponents",
            row.zero_exponents = told_whole);
    REFUSES(1e6, "zero_exponents = 1000000: must be from 0 to 16, all exponents",
            row.zero_exponents = told_whole);
    REFUSES(0, "collision_rate = 0: must be from 8e-09 to 8e+09 with number = 8",
            row.collision_rate = told);
    REFUSES(1e12, "collision_rate = 1000000000000: must be from 8e-09 to 8e+09 with number = 8",
            row.collision_rate = told);
    REFUSES(-1, "record_rate = -1: must be from 8e-09 to 8e+09 with number = 8",
            row.record_rate = told);
    REFUSES(NAN, "record_rate = nan: must be from 8e-09 to 8e+09 with number = 8",
            row.record_rate = told);
    REFUSES(INFINITY, "sound_crossing_time = inf: must be above 0, and finite",
            row.sound_crossing_time = told);
    REFUSES(0, "step = 0: must be above 0, and finite", row.step = told);
    REFUSES(-1, "energy_asked = -1: must be above 0, and finite", row.energy_asked = told);
    REFUSES(NAN, "speed = nan: must be above 0, and finite", row.speed = told);
    REFUSES(-1, "size = -1: must be above 0, and finite", row.size = told);
    REFUSES(NAN, "bytes = nan: must be above 0, and finite", row.bytes = told);
}

static int places(const hd_scene_def *scene, double *site)
{
    (void)scene;
    for (int k = 0; k < HD_SITES_MAX; k++) site[k] = number * k;
    return number < 0 ? 2 : (int)number;
}

TEST(disks_of_a_particle_that_cannot_be_are_named)
{
    REFUSES(9, "sites = 9: must be from 1 to 8", row.sites = places);
    REFUSES(0, "sites = 0: must be from 1 to 8", row.sites = places);
    REFUSES(-1, "sites: site[1] = -1: must be finite, and not below the one before it",
            row.sites = places);
}

static int vectors;
static int so_many(const hd_scene_def *scene, const double *q, const double *p, double *column)
{
    (void)q, (void)p;
    for (int k = 0; k < vectors * ROWS; k++) column[k] = k % 2 == 0;
    return scene ? vectors : 0;
}

TEST(more_null_vectors_than_zeros_are_refused)
{
    vectors = 5;
    REFUSES(0, "null_vectors = 5: must be from 0 to zero_exponents = 4",
            row.null_vectors = so_many);
    vectors = -2;
    REFUSES(0, "null_vectors = -2: must be from 0 to zero_exponents = 4",
            row.null_vectors = so_many);
}

/** Also those that come later. */
TEST(more_null_vectors_end_a_run)
{
    hd_dynamics row = of_chain;
    row.null_vectors = so_many;
    hd_scene_def scene = with_covariant(HD_EXPONENTS_ALL);
    scene.dynamics = &row;
    vectors = 4;
    OWNED(hd_run) *run = created(scene);
    vectors = 5;
    hd_status status = HD_OK;
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
    assert_int_equal(status, HD_DYNAMICS_FAULT);
    assert_string_equal(hd_run_fault(run), "null_vectors: more vectors than zero_exponents");
}

/* ---- advances ------------------------------------------------------------------------------ */

/** What the row does from the simulated time BREAKS on. */
static int wrong;
enum {
    NOTHING_WRONG,
    TIME_STANDS_STILL,
    TIME_IS_HALF,
    ENTRY_BEFORE,
    ENTRY_BEYOND,
    ENTRY_NEGATIVE,
    ENTRY_NAN,
    ENDS_LATE,
    ENDS_EARLY,
    ENDS_NAN,
    STATE_NAN,
    CARRY_NAN
};
static const double BREAKS = 60.0; /* the warm-up has begun */

static void put_time(hd_record *record, double time)
{
    const spring s = {time, 0.0, 0.0};
    if (hd_record_put(record, &s) != HD_OK) return; /* a row that does not look */
}

static hd_status advance_wrongly(void *state, hd_record *record, double t_end)
{
    chain *c = state;
    const double before = c->now;
    if (before > BREAKS && wrong == TIME_STANDS_STILL) return HD_OK;
    if (before > BREAKS && wrong == TIME_IS_HALF)
        return advance(state, record, 0.5 * (before + t_end));
    const hd_status status = advance(state, record, t_end);
    if (!record || before <= BREAKS) return status;
    const double duration = hd_record_duration(record);
    if (wrong == ENTRY_BEFORE) put_time(record, 0.5 * duration);
    if (wrong == ENTRY_BEYOND) put_time(record, 2.0 * duration);
    if (wrong == ENTRY_NEGATIVE) put_time(record, -1.0);
    if (wrong == ENTRY_NAN) put_time(record, NAN);
    if (wrong == STATE_NAN) c->x[3] = NAN;
    hd_record_end(record, wrong == ENDS_LATE    ? duration + 7.0
                          : wrong == ENDS_EARLY ? 0.999 * duration
                          : wrong == ENDS_NAN   ? NAN
                                                : duration);
    return status;
}

static void carry_wrongly(const void *maps, double *block, int width)
{
    of_chain.carry(maps, block, width);
    if (wrong == CARRY_NAN) block[0] = NAN;
}

typedef struct ending {
    hd_status status;
    char fault[HD_FAULT_LINE];
    double time;
} ending;

/** How the run ends, and the simulated time at which it does. */
static ending ending_of(int kind)
{
    hd_dynamics row = of_chain;
    row.advance = advance_wrongly;
    row.carry = carry_wrongly;
    hd_scene_def scene = chain_of(N, 10.0, 3);
    scene.dynamics = &row;
    wrong = NOTHING_WRONG; /* a trial of threads also carries */
    OWNED(hd_run) *run = created(scene);
    wrong = kind;
    ending end = {.status = HD_OK};
    while (end.status == HD_OK && hd_run_stage(run) != HD_FINISHED) {
        end.time = hd_run_time(run);
        end.status = hd_run_advance(run);
    }
    snprintf(end.fault, sizeof end.fault, "%s", hd_run_fault(run));
    assert_int_equal(hd_run_status(run), end.status);
    return end;
}

/** In the advance in which it happens, and not at the end of the interval. */
TEST(an_advance_that_does_what_it_must_not_ends_the_run)
{
    const struct {
        int kind;
        const char *fault;
    } faults[] = {
        {TIME_STANDS_STILL, "time: not what advance was asked for: it is "},
        {TIME_IS_HALF, "time: not what advance was asked for: it is "},
        {ENTRY_BEFORE, "hd_record_put: an entry is earlier than the last one, or not a number: "},
        {ENTRY_NEGATIVE, "hd_record_put: an entry is earlier than the last one, or not a number: "
                         "at -1"},
        {ENTRY_NAN, "hd_record_put: an entry is earlier than the last one, or not a number: "
                    "at nan"},
        {ENTRY_BEYOND, "hd_record_end: the record ends before its last entry: at "},
        {ENDS_LATE, "hd_record_end: another duration than advance was asked for: it is "},
        {ENDS_EARLY, "hd_record_end: "},
        {ENDS_NAN, "hd_record_end: the record ends before its last entry: at nan"}};
    for (size_t k = 0; k < sizeof faults / sizeof *faults; k++) {
        const ending end = ending_of(faults[k].kind);
        assert_int_equal(end.status, HD_DYNAMICS_FAULT);
        assert_true(strncmp(end.fault, faults[k].fault, strlen(faults[k].fault)) == 0);
        CHECK_WITHIN(end.time, BREAKS - 1.0, BREAKS + 20.0);
    }
    assert_int_equal(ending_of(NOTHING_WRONG).status, HD_OK);
    assert_string_equal(ending_of(NOTHING_WRONG).fault, "");
}

TEST(what_is_not_a_number_is_told_as_that)
{
    if (VERIFIES) skip(); /* which looks at the vectors first */
    assert_int_equal(ending_of(STATE_NAN).status, HD_NOT_FINITE);
    assert_int_equal(ending_of(CARRY_NAN).status, HD_NOT_FINITE);
}

/* ---- energy -------------------------------------------------------------------------------- */

static double off; /* error of the energy at BREAKS, and half of it before */

static void examine_energy(const void *state, hd_invariants *examined)
{
    *examined = (hd_invariants){.energy_error = now(state) > BREAKS ? off : 0.5 * off};
}

/** As with soft particles: beyond 2 % the run ends, below it is told. */
TEST(a_lost_energy_ends_a_run_of_ones_own)
{
    if (VERIFIES) skip(); /* which allows for no error of the energy */
    const struct {
        double error;
        hd_status status;
    } cases[] = {{0.019, HD_OK}, {-0.021, HD_ENERGY_LOST}, {NAN, HD_NOT_FINITE}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        hd_dynamics row = of_chain;
        row.examine = examine_energy;
        hd_scene_def scene = chain_of(N, 10.0, 3);
        scene.dynamics = &row;
        scene.duration = 100.0;
        off = cases[k].error;
        OWNED(hd_run) *run = created(scene);
        hd_status status = HD_OK;
        while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
        assert_int_equal(status, cases[k].status);
        const hd_energy energy = hd_trajectory_energy(hd_run_trajectory(run));
        if (!isnan(off)) CHECK_CLOSE(energy.most, fabs(off), 0.0);
        assert_true(isnan(energy.asked));
    }
}

/** Without `examine` it is not known, and is never 0. */
TEST(an_energy_that_is_not_told_is_not_known)
{
    OWNED(hd_run) *run = created(chain_of(N, 10.0, 3));
    until_time(run, BREAKS);
    assert_true(isnan(hd_trajectory_energy(hd_run_trajectory(run)).error));
    assert_true(isnan(hd_trajectory_energy(hd_run_trajectory(run)).most));
}
