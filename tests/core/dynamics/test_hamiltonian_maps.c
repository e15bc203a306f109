/** Tangent maps of rows that hdlyap/hamiltonian.h makes. */
#include "hamiltonians.h"

/* ---- maps ---------------------------------------------------------------------------------- */

/** Where a trajectory starts instead, by the coordinate that is moved: q first, then p. */
static struct {
    const hd_hamiltonian *of;
    int energy; /**< number of the parameter `energy` of the row */
    int which;
    double off;
} nudge;

static void nudged_start(const hd_scene_def *scene, double *q, double *p)
{
    const int all = scene->number * scene->dynamics->coordinates;
    if (nudge.of->start)
        nudge.of->start(scene, q, p);
    else
        hd_hamiltonian_momenta(scene, p, scene->own[nudge.energy].real);
    *(nudge.which < all ? &q[nudge.which] : &p[nudge.which - all]) += nudge.off;
}

/** Writes q and p at time 3, started off by so much. */
static void shadow(double *x, const hd_scene_def *scene, int which, double off)
{
    hd_hamiltonian starts = *scene->dynamics->hamiltonian;
    hd_dynamics row = *scene->dynamics;
    hd_scene_def def = *scene;
    nudge.of = scene->dynamics->hamiltonian;
    nudge.energy = strcmp(row.particles, "chain") == 0 ? ENERGY : 0;
    nudge.which = which;
    nudge.off = off;
    starts.start = nudged_start;
    row.hamiltonian = &starts;
    def.dynamics = &row;
    void *state = state_of(&def);
    CHECK_OK(row.advance(state, NULL, 3.0));
    row.state(state, x, x + scene->number * row.coordinates);
    row.free(state);
}

/** The unit vectors, carried from 0 to 3 in parts that end at these times. */
static hd_frame *carried(const hd_scene_def *scene, const double *cut, int cuts)
{
    const hd_dynamics *row = scene->dynamics;
    const int rows = 2 * row->coordinates * scene->number;
    hd_record *record;
    hd_frame *frame;
    void *state = state_of(scene);
    CHECK_OK(hd_record_create(&record, row->entry));
    CHECK_OK(row->advance(state, record, 0.7123));
    CHECK_OK(row->advance(state, record, 3.0));
    CHECK_OK(hd_frame_create(&frame, scene, rows, 1, 1));
    for (int k = 0; k < rows; k++)
        for (int col = 0; col < rows; col++)
            hd_frame_data(frame)[k * hd_frame_stride(frame) + col] = k == col;
    for (int k = 0; k <= cuts; k++)
        CHECK_OK(hd_frame_replay(frame, record, k > 0 ? cut[k - 1] : 0.0, k < cuts ? cut[k] : 3.0));
    assert_null(row->fault(record, scene));
    hd_record_free(record);
    row->free(state);
    return frame;
}

/** Row of a frame for a number among q and p of all, which are q first. */
static int row_of(const hd_scene_def *scene, int which)
{
    const int of_one = scene->dynamics->coordinates, all = of_one * scene->number, k = which % all;
    return 2 * of_one * (k / of_one) + k % of_one + (which < all ? 0 : of_one);
}

static double entry_of(const hd_frame *frame, int row, int col)
{
    return hd_frame_read(frame)[row * hd_frame_stride(frame) + col];
}

/** The time step must not follow the nudge. */
static hd_scene_def of_fixed_step(hd_scene_def scene)
{
    for (int k = 0; k < scene.dynamics->parameters; k++)
        if (strcmp(scene.dynamics->parameter[k].name, "time_step") == 0)
            scene.own[k].real = hd_hamiltonian_time_step(&scene);
    return scene;
}

/** Each entry, against two shadow trajectories: right to off^2 times third derivatives of up to
 * 1e5, and to rounding over off, which is less. */
TEST(maps_are_those_of_shadow_trajectories)
{
    const double off = 3e-6, tolerance = 1e-6;
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = of_fixed_step(kind(k));
        const int all = 2 * scene.number * scene.dynamics->coordinates;
        OWNED(hd_frame) *frame = carried(&scene, NULL, 0);
        for (int which = 0; which < all; which++) {
            double plus[120], minus[120];
            shadow(plus, &scene, which, off);
            shadow(minus, &scene, which, -off);
            for (int other = 0; other < all; other++)
                CHECK_CLOSE(entry_of(frame, row_of(&scene, other), row_of(&scene, which)),
                            (plus[other] - minus[other]) / (2.0 * off), tolerance);
        }
    }
}

/** S^T J S = J, to rounding in some hundred kicks of vectors that have grown to about 100. */
TEST(maps_are_symplectic)
{
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = kind(k);
        const int all = scene.number * scene.dynamics->coordinates;
        OWNED(hd_frame) *frame = carried(&scene, NULL, 0);
        for (int a = 0; a < 2 * all; a++)
            for (int b = 0; b < 2 * all; b++) {
                const int col = row_of(&scene, a), other = row_of(&scene, b);
                double sum = 0.0;
                for (int i = 0; i < all; i++) {
                    const int q = row_of(&scene, i), p = row_of(&scene, all + i);
                    sum += entry_of(frame, q, col) * entry_of(frame, p, other) -
                           entry_of(frame, p, col) * entry_of(frame, q, other);
                }
                CHECK_CLOSE(sum, (b == a + all) - (a == b + all), 1e-9);
            }
    }
}

/** To rounding: at a cut a flight is done in two parts. */
TEST(cuts_do_not_change_maps)
{
    const double cut[] = {0.0, 0.0213, 0.7, 0.7000001, 1.25, 2.0, 2.9999};
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = kind(k);
        const int rows = 2 * scene.number * scene.dynamics->coordinates;
        OWNED(hd_frame) *whole = carried(&scene, NULL, 0);
        OWNED(hd_frame) *parts = carried(&scene, cut, 7);
        for (int row = 0; row < rows; row++)
            for (int col = 0; col < rows; col++)
                CHECK_CLOSE(entry_of(parts, row, col), entry_of(whole, row, col), 1e-11);
    }
}

/** Blocks of all widths. */
TEST(each_width_carries_the_same)
{
    const hd_scene_def scene = kind(VERLET);
    OWNED(hd_frame) *all = carried(&scene, NULL, 0);
    const hd_dynamics *row = scene.dynamics;
    hd_record *record;
    void *state = state_of(&scene), *maps;
    CHECK_OK(hd_record_create(&record, row->entry));
    CHECK_OK(row->advance(state, record, 3.0));
    CHECK_OK(row->maps_create(&maps, &scene));
    CHECK_OK(row->maps_fill(maps, record, 0.0, 3.0));
    for (int width = 1; width <= 64; width *= 2) {
        double block[14 * 64];
        for (int k = 0; k < 14 * width; k++) block[k] = k / width == k % width % 14;
        row->carry(maps, block, width);
        for (int k = 0; k < 14 * width; k++)
            CHECK_CLOSE(block[k], entry_of(all, k / width, k % width % 14), 1e-11);
    }
    row->maps_free(maps);
    row->free(state);
    hd_record_free(record);
}

/** Shifts and their momenta to rounding, as dq grows by dp times the time of whole steps; the flow
 * (p, F) to (step * omega)^2 or ^4 of its largest component, with omega up to 20. */
TEST(null_vectors_stay_null_vectors)
{
    for (int k = 0; k < KINDS; k++) {
        const hd_scene_def scene = kind(k);
        const hd_dynamics *row = scene.dynamics;
        const int all = scene.number * row->coordinates, rows = 2 * all;
        const int shifts = k == OF_STARS ? 0 : 2 * row->coordinates;
        double q[60], p[60], start[3 * 120], end[3 * 120];
        void *state = state_of(&scene);
        row->state(state, q, p);
        assert_int_equal(row->null_vectors(&scene, q, p, start), shifts + 1);
        CHECK_OK(row->advance(state, NULL, 3.0));
        row->state(state, q, p);
        assert_int_equal(row->null_vectors(&scene, q, p, end), shifts + 1);
        OWNED(hd_frame) *frame = carried(&scene, NULL, 0);
        const double step = row->step(&scene), last = step * floor(3.0 / step);
        double most = 0.0;
        for (int to = 0; to < rows; to++) most = fmax(most, fabs(end[rows * shifts + to]));
        for (int vector = 0; vector <= shifts; vector++)
            for (int to = 0; to < rows; to++) {
                double moved = 0.0;
                for (int from = 0; from < rows; from++)
                    moved += entry_of(frame, to, from) * start[rows * vector + from];
                const double flown = shifts && vector == 1 ? last * start[to] : 0.0;
                CHECK_CLOSE(moved, end[rows * vector + to] + flown,
                            vector < shifts ? 1e-10 : most * (k == VERLET ? 1e-3 : 1e-4));
            }
        row->free(state);
    }
}
